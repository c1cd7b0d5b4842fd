//! What `simulate` and the study of scenes share: how they watch a simulation, and how its errors end the command.

use std::ops::ControlFlow;

use mpm_scenes::{Observer, Progress, SceneError, SimulationError};

use crate::CommandError;
use crate::progress::{Bar, CaseObserver, unless_interrupted};

impl From<SceneError> for CommandError {
    fn from(error: SceneError) -> Self {
        Self::Library(error.into())
    }
}

impl From<SimulationError> for CommandError {
    fn from(error: SimulationError) -> Self {
        Self::Library(error.into())
    }
}

/// The bar of a simulation: time simulated.
pub struct SimulationProgress(Bar);

/// Units of its bar from begin to end.
const SIMULATION_UNITS: f64 = 1e6;

impl SimulationProgress {
    /// A bar up to the time `end`.
    pub fn new(end: f64) -> Self {
        Self(Bar::new(&format!("{{bar:30}} {{msg}} of {end}, {{eta}} left")))
    }

    /// Takes the bar off the screen.
    pub fn clear(&self) {
        self.0.clear();
    }
}

impl Observer for SimulationProgress {
    fn after_step(&mut self, progress: Progress) -> ControlFlow<()> {
        let share = progress.time / progress.end * SIMULATION_UNITS;
        self.0.set(share as u64, SIMULATION_UNITS as u64);
        self.0
            .say(|| format!("step {}, t = {:.4}", progress.step, progress.time));
        unless_interrupted()
    }
}

impl Observer for CaseObserver {
    fn after_step(&mut self, progress: Progress) -> ControlFlow<()> {
        self.advance(progress.time / progress.end)
    }
}
