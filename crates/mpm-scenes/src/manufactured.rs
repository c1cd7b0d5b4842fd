//! Manufactured solutions: motions prescribed beforehand, with the body force that makes them solve the equations.

/// A motion x = X + u(X, t) of a plane body and the body force per unit mass that produces it in the scene's material.
#[allow(non_snake_case)]
pub trait ManufacturedSolution: Send + Sync {
    /// The position x(X, t).
    fn position(&self, X: &[f64; 2], time: f64) -> [f64; 2];

    /// The velocity ∂u/∂t (X, t).
    fn velocity(&self, X: &[f64; 2], time: f64) -> [f64; 2];

    /// The body force per unit mass b = ∂²u/∂t² − (Div P) / ρ₀ at X.
    fn body_force(&self, X: &[f64; 2], time: f64) -> [f64; 2];
}

/// f(X) of a place of the plane; zeros in other dimensions, where there are no such solutions.
#[allow(non_snake_case)]
pub(crate) fn in_the_plane<const D: usize>(X: &[f64; D], f: impl Fn(&[f64; 2]) -> [f64; 2]) -> [f64; D] {
    let plane = <&[f64; 2]>::try_from(X.as_slice()).map(f).unwrap_or_default();
    std::array::from_fn(|a| plane.get(a).copied().unwrap_or(0.0))
}
