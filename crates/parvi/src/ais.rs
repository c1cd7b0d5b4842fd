//! Adaptive importance sampling alone: the survey of the calibrated sampler, condensed, and no material.

use parvi_targets::{Frame, Target};

use crate::checkpoint::Journal;
use crate::{AisOptions, MpmOptions, Observer, Run, SampleError, Samples, surveyed};

impl AisOptions {
    /// M support points of the weighted pool, which is in [`Samples::pool`].
    ///
    /// # Errors
    /// [`SampleError`]: an option out of range, a target that is nowhere finite or where nothing could be weighed, or the observer's stop.
    pub fn sample<const D: usize>(
        &self,
        target: &dyn Target<D>,
        frame: &Frame<D>,
        run: &Run,
        observer: &mut dyn Observer,
    ) -> Result<Samples<D>, SampleError> {
        run.particles_of("ais")?;
        if !target.has_log_density() {
            return Err(SampleError::ScoreOnly { method: "method `ais`" });
        }
        let options = MpmOptions {
            evaluations: self.evaluations,
            rounds: Some(0),
            ..MpmOptions::default()
        };
        let samples = surveyed::sample(&options, target, frame, run, &mut Journal::none(), observer)?;
        samples.ok_or(SampleError::Pool(parvi_pool::PoolError::NowhereFinite))
    }
}
