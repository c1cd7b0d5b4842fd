//! How a regression's linear predictor turns into the likelihood of a response.

use std::fmt::Debug;

use crate::Response;
use crate::exponential::with_widest_vectors;

/// Particles whose predictors are computed together, the last group of a batch filled up.
pub const PARTICLES_PER_GROUP: usize = 64;

/// The part ℓ(t) of a row's log likelihood that is not linear in its predictor t = b(y) xᵀβ (see [`Response`]), concave,
/// with ℓ′ and −ℓ″ finite for every finite t.
///
/// A link of one's own needs the three scalar functions; the other two may be overridden by forms that vectorise.
pub trait Link: Copy + Debug + Send + Sync + 'static {
    /// The responses that the likelihood is for.
    type Response: Response;

    /// ℓ(t).
    fn log_likelihood(t: f64) -> f64;

    /// ℓ′(t).
    fn slope(t: f64) -> f64;

    /// −ℓ″(t) ≥ 0, without cancellation in either tail.
    fn curvature(t: f64) -> f64;

    /// ℓ′(t) as it is taken of many predictors side by side; by default [`slope`](Self::slope). Best inlined.
    #[inline(always)]
    fn slope_among_many(t: f64) -> f64 {
        Self::slope(t)
    }

    /// `sums[p]` += Σ_r ℓ(`predictors[r][p]`) over rows r, for each particle p of a group.
    ///
    /// A particle's sum must depend on its own predictors only, not on its place.
    fn add_log_likelihoods(predictors: &[[f64; PARTICLES_PER_GROUP]], sums: &mut [f64; PARTICLES_PER_GROUP]) {
        for row in predictors {
            for (sum, t) in sums.iter_mut().zip(row) {
                *sum += Self::log_likelihood(*t);
            }
        }
    }
}

/// t ↦ ℓ′(t) in place.
pub(crate) fn slopes<L: Link>(predictors: &mut [f64]) {
    with_widest_vectors(
        #[inline(always)]
        || {
            for t in predictors {
                *t = L::slope_among_many(*t);
            }
        },
    );
}
