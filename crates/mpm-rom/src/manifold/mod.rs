//! Families of deformation maps X → g̃(X, x̂) with a few coordinates x̂.

mod evaluation;
#[cfg(test)]
#[path = "../../tests/support/fields.rs"]
mod fields;
pub mod network;
mod pod;

pub(crate) use evaluation::velocities;
pub use evaluation::{Evaluation, Wanted};
#[cfg(test)]
pub(crate) use fields::Fields;
pub use network::{Network, NetworkError, NetworkShape, Scaling};
pub use pod::{LinearError, Pod};

/// A family of maps g̃(X, x̂) from reference positions X to deformed positions, with r generalised coordinates x̂.
pub trait Manifold<const D: usize>: Send + Sync {
    /// r, the number of generalised coordinates.
    fn coordinates(&self) -> usize;

    /// g̃(X_p, x̂) at every point, and what else is wanted there; `out` is resized and overwritten.
    ///
    /// `reference` holds X_p (m, relative to the body's centroid at rest), `latent` the r coordinates x̂. The result of a point does not depend on the
    /// others, nor on the number of threads.
    fn evaluate(&self, reference: &[[f64; D]], latent: &[f64], wanted: Wanted, out: &mut Evaluation<D>);

    /// g̃(X_p, x̂), ∇_X g̃(X_p, x̂) and the velocities ∂g̃/∂x̂ (X_p, x̂) v̂ at every point, `rates` being v̂ (r entries); Jacobians are left empty or as they may be.
    ///
    /// The velocity is one tangent, whatever r is; families that cannot carry it alone contract the Jacobians, as this default does.
    fn evaluate_moving(&self, reference: &[[f64; D]], latent: &[f64], rates: &[f64], out: &mut Evaluation<D>) {
        self.evaluate(reference, latent, Wanted::ALL, out);
        out.velocities.clear();
        out.velocities.extend(velocities(&out.jacobians, rates));
        out.velocities.resize(reference.len(), [0.0; D]);
    }
}
