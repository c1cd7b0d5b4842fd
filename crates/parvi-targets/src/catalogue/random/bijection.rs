//! Invertible maps of ℝᴰ, with what a density needs to be carried along.

use std::fmt::Debug;

/// An invertible map x = T(y) of ℝᴰ, differentiable almost everywhere, with J(y) = ∂x/∂y.
///
/// A density p of y becomes q(x) = p(y) / |det J(y)| at y = T⁻¹(x), and its score
/// ∇_x log q = J⁻ᵀ (∇_y log p − ∇_y log|det J|).
pub trait Bijection<const D: usize>: Debug + Send + Sync {
    /// T(y).
    fn forward(&self, y: &[f64; D]) -> [f64; D];

    /// T⁻¹(x).
    fn inverse(&self, x: &[f64; D]) -> [f64; D];

    /// log |det J(y)|; 0 where volumes are kept.
    fn log_determinant(&self, _y: &[f64; D]) -> f64 {
        0.0
    }

    /// ∇_y log |det J(y)|.
    fn log_determinant_gradient(&self, _y: &[f64; D]) -> [f64; D] {
        [0.0; D]
    }

    /// J(y)⁻ᵀ g: the gradient in x of a function whose gradient in y is g.
    fn push_gradient(&self, y: &[f64; D], gradient: &[f64; D]) -> [f64; D];
}

/// A map whichever it is.
pub type BoxedBijection<const D: usize> = Box<dyn Bijection<D>>;
