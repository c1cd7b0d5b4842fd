//! What a sampler needs from a density, and what a study may ask beyond that.

use mpm_tensor::Matrix;
use rand::{Rng, RngExt};
use rand_distr::Open01;

use crate::{Frame, TargetError};

/// [`Target::points_per_call`], where a target does not say.
pub(crate) const POINTS_PER_CALL: usize = 256;

/// An unnormalised density `p` on ℝᴰ: the two functions a user writes to sample an own target.
pub trait Target<const D: usize>: Sync {
    /// log p(x), up to an additive constant that does not depend on `x`.
    fn log_density(&self, x: &[f64; D]) -> f64;

    /// The score s(x) = ∇ log p(x).
    fn score(&self, x: &[f64; D]) -> [f64; D];

    /// Whether log p is known. Without ([`ScoreOnly`](crate::ScoreOnly)), [`log_density`](Self::log_density) is not a number and nothing can be weighed: samplers that only follow
    /// the score say so, and others refuse.
    fn has_log_density(&self) -> bool {
        true
    }

    /// Points that [`scores`](Self::scores) and [`log_densities`](Self::log_densities) are given in one call, at most; calls run side by side.
    ///
    /// Override it with 1 where a point takes a millisecond or longer (a simulation): every thread then has its share of few points, and the observer of a survey is heard between any two. Where batches are cheaper
    /// than their parts, the default is enough.
    fn points_per_call(&self) -> usize {
        POINTS_PER_CALL
    }

    /// Whether a score depends on how many calls were made before ([`MinibatchScore`](crate::MinibatchScore)). Points that belong together are then asked for in one call, by one thread,
    /// so that calls follow each other alike on any number of threads.
    fn scores_depend_on_calls(&self) -> bool {
        false
    }

    /// Scores of many points at once: `out[p] = score(xs[p])`.
    ///
    /// Override it where a batch is cheaper than its parts (a regression is one matrix product).
    /// `xs` and `out` have the same length; an implementation must not depend on the batch's composition,
    /// i.e. it returns the same bits for a point wherever it stands. A score that is estimated
    /// ([`MinibatchScore`](crate::MinibatchScore)) may differ from call to call, but all points of one call share one
    /// estimate, which depends on a seed and the number of calls before alone: within a call the promise holds.
    fn scores(&self, xs: &[[f64; D]], out: &mut [[f64; D]]) {
        for (x, score) in xs.iter().zip(out) {
            *score = self.score(x);
        }
    }

    /// Log densities of many points at once: `out[p] = log_density(xs[p])`, with the same promises as
    /// [`scores`](Self::scores).
    fn log_densities(&self, xs: &[[f64; D]], out: &mut [f64]) {
        for (x, log_density) in xs.iter().zip(out) {
            *log_density = self.log_density(x);
        }
    }
}

/// A target may be lent to what takes one.
impl<T: Target<D> + ?Sized, const D: usize> Target<D> for &T {
    fn log_density(&self, x: &[f64; D]) -> f64 {
        (**self).log_density(x)
    }

    fn score(&self, x: &[f64; D]) -> [f64; D] {
        (**self).score(x)
    }

    fn has_log_density(&self) -> bool {
        (**self).has_log_density()
    }

    fn points_per_call(&self) -> usize {
        (**self).points_per_call()
    }

    fn scores_depend_on_calls(&self) -> bool {
        (**self).scores_depend_on_calls()
    }

    fn scores(&self, xs: &[[f64; D]], out: &mut [[f64; D]]) {
        (**self).scores(xs, out);
    }

    fn log_densities(&self, xs: &[[f64; D]], out: &mut [f64]) {
        (**self).log_densities(xs, out);
    }
}

/// Independent exact draws from the normalised density.
pub trait ExactDraws<const D: usize>: Sync {
    /// One draw.
    fn draw(&self, rng: &mut dyn Rng) -> [f64; D];
}

/// A map T with T(U) ~ p for U uniform on the unit cube; quasi-random points through it are the strong baseline.
pub trait UnitCubeTransport<const D: usize>: Sync {
    /// The dimension of the cube, by default `D` (it may exceed that, e.g. a mixture spends one coordinate on the mode).
    fn cube_dimension(&self) -> usize {
        D
    }

    /// The image of `u`, whose length is [`cube_dimension`](Self::cube_dimension) and whose entries lie in (0, 1).
    fn transport(&self, u: &[f64]) -> [f64; D];

    /// The image of a point that is uniform on the cube: an independent draw.
    fn drawn(&self, rng: &mut dyn Rng) -> [f64; D] {
        let u: Vec<f64> = (0..self.cube_dimension()).map(|_| rng.sample(Open01)).collect();
        self.transport(&u)
    }
}

/// Mean and covariance of a density.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moments<const D: usize> {
    /// The mean m = E(x).
    pub mean: [f64; D],
    /// The covariance E((x − m)(x − m)ᵀ).
    pub covariance: Matrix<D>,
}

impl<const D: usize> Moments<D> {
    /// Of a density about the origin whose coordinates are not correlated.
    pub(crate) fn centred(variances: [f64; D]) -> Self {
        Self {
            mean: [0.0; D],
            covariance: Matrix::diagonal(&variances),
        }
    }
}

/// A named mode of a multimodal density: points are assigned to the nearest centre in units of `width`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mode<const D: usize> {
    /// Centre of the mode.
    pub centre: [f64; D],
    /// Standard deviation of the mode (isotropic).
    pub width: f64,
    /// Probability mass of the mode; the masses of a target sum to one.
    pub mass: f64,
}

/// A target of the catalogue: a density together with what is known about it.
pub trait CatalogueTarget<const D: usize>: Target<D> {
    /// The name used on the command line.
    fn name(&self) -> &str;

    /// The frame x = μ + L z in which the target has unit scale.
    fn frame(&self) -> Frame<D>;

    /// A box that holds nearly all of the mass (for plots and dense grids): `[lower, upper]` per axis, infinite where none is known.
    fn domain(&self) -> [[f64; 2]; D];

    /// Exact draws, where the target has them.
    fn exact_draws(&self) -> Option<&dyn ExactDraws<D>> {
        None
    }

    /// The map from the unit cube, where the target has one.
    fn unit_cube_transport(&self) -> Option<&dyn UnitCubeTransport<D>> {
        None
    }

    /// Exact mean and covariance, where they are known in closed form.
    fn moments(&self) -> Option<Moments<D>> {
        None
    }

    /// The modes and their masses; empty for a unimodal target.
    fn modes(&self) -> &[Mode<D>] {
        &[]
    }

    /// log ∫ p of the density as [`log_density`](Target::log_density) gives it, where it is known exactly; 0 for a normalised one.
    fn log_evidence(&self) -> Option<f64> {
        None
    }

    /// What has gone wrong while the target was evaluated, since when its values are none; of a target that can fail.
    fn fault(&self) -> Option<TargetError> {
        None
    }
}

/// A target of the catalogue, whichever it is.
pub type BoxedTarget<const D: usize> = Box<dyn CatalogueTarget<D> + Send + Sync>;

/// What a catalogue target says that has exact draws and a map from the unit cube of its own.
macro_rules! its_own_source {
    ($dimension:tt) => {
        fn exact_draws(&self) -> Option<&dyn $crate::ExactDraws<$dimension>> {
            Some(self)
        }

        fn unit_cube_transport(&self) -> Option<&dyn $crate::UnitCubeTransport<$dimension>> {
            Some(self)
        }
    };
}
pub(crate) use its_own_source;
