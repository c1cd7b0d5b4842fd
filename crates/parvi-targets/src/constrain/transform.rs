//! What a map from unconstrained to constrained coordinates must offer.

use std::fmt::Debug;

/// A smooth map x = f(y) from ℝᵈ onto the support of a block of n ≥ d constrained coordinates.
///
/// Where n > d, d of the x are independent and the others follow from them (the last probability of a simplex); the density of
/// x is one with respect to the Lebesgue measure of the [independent](Self::independent_coordinates) ones x_v, and
/// J = ∂x_v/∂y is square. The density of y is then log p(f(y)) + log |det J|.
///
/// [`Constraints`](crate::Constraints) hands out slices of the lengths n and d that the transform states; no other
/// lengths need to be handled.
pub trait Transform: Debug + Send + Sync {
    /// What error messages call the block, e.g. `positive`.
    fn name(&self) -> &str;

    /// n, the number of constrained coordinates; the same at every call.
    fn constrained_dimension(&self) -> usize;

    /// d ≤ n, the number of unconstrained coordinates; the same at every call. By default n.
    fn unconstrained_dimension(&self) -> usize {
        self.constrained_dimension()
    }

    /// Indices of the d constrained coordinates x_v that the density is one in, counted from 0 within the block.
    fn independent_coordinates(&self) -> Vec<usize> {
        (0..self.constrained_dimension()).collect()
    }

    /// `x` = f(`y`), inside the open support also where the exact value rounds to its boundary.
    fn constrain(&self, y: &[f64], x: &mut [f64]);

    /// log |det ∂x_v/∂y| at `y`, where `x` = f(`y`).
    fn log_jacobian(&self, y: &[f64], x: &[f64]) -> f64;

    /// `out` = (∂x/∂y)ᵀ `score` + ∇ log |det ∂x_v/∂y| at `y`, where `x` = f(`y`) and `score` has a derivative for each
    /// of the n coordinates of x.
    fn pull_back(&self, y: &[f64], x: &[f64], score: &[f64], out: &mut [f64]);

    /// `y` = f⁻¹(`x`).
    ///
    /// # Errors
    /// [`OutsideSupport`] where `x` is not in the open support.
    fn unconstrain(&self, x: &[f64], y: &mut [f64]) -> Result<(), OutsideSupport>;
}

/// A constrained coordinate breaks its constraint.
#[derive(Clone, Debug, PartialEq)]
pub struct OutsideSupport {
    /// The coordinate, counted from 0 within the block.
    pub coordinate: usize,
    /// Its value.
    pub value: f64,
    /// What is allowed there, in words.
    pub allowed: &'static str,
}

/// The first coordinate for which `inside` is false, as an error.
pub(crate) fn check_each(
    x: &[f64],
    allowed: &'static str,
    inside: impl Fn(usize, f64) -> bool,
) -> Result<(), OutsideSupport> {
    match x.iter().enumerate().find(|&(index, &value)| !inside(index, value)) {
        None => Ok(()),
        Some((coordinate, &value)) => Err(OutsideSupport {
            coordinate,
            value,
            allowed,
        }),
    }
}
