//! Adaptive importance sampling alone: the survey of the calibrated sampler, condensed, and no material.

use crate::checkpoint::Journal;
use crate::task::{Task, sampler};
use crate::{AisOptions, MpmOptions, SampleError, Samples, surveyed};

sampler! {
    /// M support points of the weighted pool, which is in [`Samples::pool`]; or its points themselves, with their weights.
    ///
    /// # Errors
    /// [`SampleError`]: an option out of range, a target that is nowhere finite or where nothing could be weighed, or the observer's stop.
    AisOptions => Self::run
}

impl AisOptions {
    fn run<const D: usize>(&self, task: Task<'_, D>) -> Result<Samples<D>, SampleError> {
        task.run.given.check_taken("ais", true)?;
        task.run.checked_particles()?;
        task.run.checked_start()?;
        task.needs_log_density("method `ais`")?;
        let options = MpmOptions {
            evaluations: self.evaluations,
            search_effort: self.search_effort,
            rounds: Some(0),
            ..MpmOptions::default()
        };
        surveyed::sample_as_it_is(&options, self.condense, &mut { task }, &mut Journal::default())
    }
}
