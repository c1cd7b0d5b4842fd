//! How spacing and time step vary over a run.

use super::with_defaults::with_defaults;
use crate::start::check;
use crate::{SampleError, defaults};

with_defaults! {
    /// The spacing of step n of N around the central spacing h: h c^{(1 − (n−1)/(N s))₊} r^{u_n − ½}, u_n ∈ [0, 1) the last coordinate
    /// of the Kronecker sequence whose others are the origin.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct SpacingSchedule {
        /// r ≥ 1: largest over smallest spacing of the draws; 1 draws nothing.
        pub range: f64 = defaults::SPACING_RANGE,
        /// c ≥ 1: factor of the spacing in the first step; 1 begins as fine as it ends.
        pub coarse_start: f64 = defaults::COARSE_START,
        /// s ∈ (0, 1]: share of the steps over which c falls to 1.
        pub coarse_share: f64 = defaults::COARSE_SHARE,
    }
}

impl SpacingSchedule {
    pub(crate) fn check(&self) -> Result<(), SampleError> {
        let at_least_one = |value: f64| value >= 1.0 && value.is_finite();
        check(
            "spacing range",
            self.range,
            at_least_one(self.range),
            "at least 1 and finite",
        )?;
        let (start, share) = (self.coarse_start, self.coarse_share);
        check("coarse start", start, at_least_one(start), "at least 1 and finite")?;
        check("coarse share", share, share > 0.0 && share <= 1.0, "in (0, 1]")
    }

    /// Factor of h in step `step` of `steps` (from 1), for the draw `u`.
    pub(crate) fn factor(&self, step: usize, steps: usize, u: f64) -> f64 {
        let coarse = (1.0 - (step - 1) as f64 / (self.coarse_share * steps as f64)).max(0.0);
        self.coarse_start.powf(coarse) * self.range.powf(u - 0.5)
    }
}

with_defaults! {
    /// The end of a run: over the last share of the steps Δt falls linearly from the full one to a fraction of it.
    ///
    /// Gradients of hat functions jump, so particles at rest keep trembling by an amount that grows with Δt.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Settling {
        /// Share of the steps, in [0, 1).
        pub share: f64 = defaults::SETTLING_SHARE,
        /// Δt of the last step over the full one, in (0, 1].
        pub time_step: f64 = defaults::SETTLING_TIME_STEP,
        /// Whether the basis goes on varying meanwhile; else it comes to rest at origin 0 and the central spacing.
        pub shifts: bool = true,
    }
}

impl Settling {
    pub(crate) fn check(&self) -> Result<(), SampleError> {
        let (share, factor) = (self.share, self.time_step);
        check("settling share", share, (0.0..1.0).contains(&share), "in [0, 1)")?;
        check("settling time step", factor, factor > 0.0 && factor <= 1.0, "in (0, 1]")
    }

    /// How much of the way is left in step `step` of `steps` (from 1): 1 before settling begins, 0 at the end.
    fn left(&self, step: usize, steps: usize) -> f64 {
        let left = (steps - step.min(steps)) as f64;
        if self.share > 0.0 {
            (left / (self.share * steps as f64)).min(1.0)
        } else {
            1.0
        }
    }

    /// The last step before settling begins, at least 1.
    pub(crate) fn last_full_step(&self, steps: usize) -> usize {
        (((1.0 - self.share) * steps as f64) as usize).max(1)
    }

    /// Factor of Δt.
    pub(crate) fn factor(&self, step: usize, steps: usize) -> f64 {
        self.time_step + (1.0 - self.time_step) * self.left(step, steps)
    }

    /// Whether the basis varies in this step.
    pub(crate) fn varies(&self, step: usize, steps: usize) -> bool {
        self.shifts || self.left(step, steps) >= 1.0
    }
}
