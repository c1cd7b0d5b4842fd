//! Families of deformation maps X → g̃(X, x̂) with a few coordinates x̂.

mod evaluation;
pub mod network;
#[cfg(test)]
mod polynomial;

pub use evaluation::{Evaluation, Wanted};
pub use network::{Network, NetworkError, NetworkShape, Scaling};
#[cfg(test)]
pub(crate) use polynomial::Fields;

/// A family of maps g̃(X, x̂) from reference positions X to deformed positions, with r generalised coordinates x̂.
pub trait Manifold<const D: usize>: Send + Sync {
    /// r, the number of generalised coordinates.
    fn coordinates(&self) -> usize;

    /// g̃(X_p, x̂) at every point, and what else is wanted there; `out` is resized and overwritten.
    ///
    /// `reference` holds X_p (m, relative to the body's centroid at rest), `latent` the r coordinates x̂. The result of a point does not depend on the
    /// others, nor on the number of threads.
    fn evaluate(&self, reference: &[[f64; D]], latent: &[f64], wanted: Wanted, out: &mut Evaluation<D>);
}
