//! Manufactured solutions: motions prescribed beforehand, with the body force that makes them solve the equations.

/// A motion x = X + u(X, t) and the body force per unit mass that produces it in the scene's material.
///
/// All points and vectors have as many entries as the scene has dimensions.
#[allow(non_snake_case)]
pub trait ManufacturedSolution: Send + Sync {
    /// The displacement u(X, t), written to `displacement`.
    fn displacement(&self, X: &[f64], time: f64, displacement: &mut [f64]);

    /// The velocity ∂u/∂t (X, t), written to `velocity`.
    fn velocity(&self, X: &[f64], time: f64, velocity: &mut [f64]);

    /// The body force per unit mass b = ∂²u/∂t² − (Div P) / ρ₀ at X, written to `acceleration`.
    fn body_force(&self, X: &[f64], time: f64, acceleration: &mut [f64]);
}
