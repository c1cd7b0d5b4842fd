//! What takes long to compile, and the functions that call it: compiled in this crate for the dimensions whose features are on, once for all crates that call it.

use parvi_targets::Target;

use crate::beginning::Beginning;
use crate::measure::Measure;
use crate::options::{PoolError, PoolOptions};
use crate::pool::Pool;
use crate::report::Observer;

/// [`explore`](crate::explore).
type Explore<const D: usize> =
    fn(&dyn Target<D>, Beginning<'_, D>, usize, &PoolOptions, &mut Observer<'_>) -> Result<Pool<D>, PoolError>;

/// What is compiled for a dimension.
pub(crate) struct Compiled<const D: usize> {
    pub explore: Explore<D>,
    pub condense: fn(&Measure<D>, usize, f64) -> Vec<[f64; D]>,
}

impl<const D: usize> Compiled<D> {
    /// Generated where it is named.
    const HERE: Self = Self {
        explore: crate::explore::explore,
        condense: crate::condense::condense,
    };
}

mpm_parallel::compiled_ahead!(Compiled);

/// Explore a target until the effective size suffices for so many particles, or the evaluations are used up.
///
/// # Errors
/// [`PoolError`]: an option out of range, a target that is nowhere finite, a tape of another target, or the observer's stop.
pub fn explore<const D: usize>(
    target: &dyn Target<D>,
    start: Beginning<'_, D>,
    particles: usize,
    options: &PoolOptions,
    observer: &mut Observer<'_>,
) -> Result<Pool<D>, PoolError> {
    (Compiled::of().explore)(target, start, particles, options, observer)
}

/// M points of least energy distance from a measure, in the coordinates of its [`frame`](Measure::frame).
///
/// The convex–concave procedure of S. Mak, V. R. Joseph, *Support points*, Ann. Stat. 46, 2018, Eq. (22): the energy is Σ_m c_m |x − y_m| of the points of
/// positive weight, which is convex, and −|x − ·| of all others, particles and points of negative weight, which is concave and taken by its slope:
/// x ← (Σ₊ c_m/|x − y_m|)⁻¹ (Σ₊ c_m y_m/|x − y_m| − Σ₋ c_m (x − y_m)/|x − y_m| + 1/M Σ_j (x − x_j)/|x − x_j|). It starts from a resample in the order of a tree of
/// bisected boxes, so that every part of space gets its share of the particles. Empty where nothing has weight. `offset` in [0, 1) shifts
/// that resample.
///
/// Of n points distances below 1/n, in standard deviations, hardly count as smaller: there are to be many more points than particles. A coordinate that
/// all points have alike is the particles', too; from any other line or plane that holds all points they may lie 1/n off.
pub fn condense<const D: usize>(measure: &Measure<D>, count: usize, offset: f64) -> Vec<[f64; D]> {
    (Compiled::of().condense)(measure, count, offset)
}

impl<const D: usize> Measure<D> {
    /// M particles of equal mass: support points.
    pub fn condense(&self, count: usize) -> Vec<[f64; D]> {
        condense(self, count, 0.5)
    }
}

impl<const D: usize> Pool<D> {
    /// M particles of equal mass: support points of the weighted pool.
    pub fn condense(&self, count: usize) -> Vec<[f64; D]> {
        self.measure.condense(count)
    }
}
