//! What takes long to compile, compiled in this crate for the dimensions whose features are on, once for all crates that call it.

use parvi_targets::{Frame, Target};

use crate::measure::Measure;
use crate::mixture::Mixture;
use crate::{Observer, Pool, PoolError, PoolOptions};

/// [`explore`](crate::explore).
type Explore<const D: usize> = fn(
    &dyn Target<D>,
    &Frame<D>,
    &[Mixture<D>],
    Vec<f64>,
    usize,
    u64,
    &PoolOptions,
    &mut Observer<'_>,
) -> Result<Pool<D>, PoolError>;

/// What is compiled for a dimension.
pub(crate) struct Compiled<const D: usize> {
    pub explore: Explore<D>,
    pub condense: fn(&Measure<D>, usize, f64) -> Vec<[f64; D]>,
}

impl<const D: usize> Compiled<D> {
    /// Generated where it is named.
    const HERE: Self = Self {
        explore: crate::explore_here,
        condense: crate::condense::condense_here,
    };
}

mpm_parallel::compiled_ahead!(Compiled);
