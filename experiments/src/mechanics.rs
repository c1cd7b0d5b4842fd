//! What `simulate` and the study of scenes share: how they watch a simulation, and how its errors end the command.

use std::ops::ControlFlow;

use indicatif::ProgressBar;
use mpm_scenes::{Observer, Progress, SceneError, SimulationError};

use crate::CommandError;
use crate::progress::{CaseObserver, style, unless_interrupted};

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
pub struct SimulationProgress {
    bar: ProgressBar,
    /// Whether the bar has moved; a run that goes on from a checkpoint does not begin at 0.
    begun: bool,
}

/// Units of its bar from begin to end.
const SIMULATION_UNITS: f64 = 1e6;

impl SimulationProgress {
    /// A bar up to the time `end`.
    pub fn new(end: f64) -> Self {
        let style = style(&format!("{{bar:30}} {{msg}} of {end}, {{eta}} left"));
        let bar = ProgressBar::new(SIMULATION_UNITS as u64).with_style(style);
        Self { bar, begun: false }
    }

    /// Takes the bar off the screen.
    pub fn clear(&self) {
        self.bar.finish_and_clear();
    }
}

impl Observer for SimulationProgress {
    fn after_step(&mut self, progress: Progress) -> ControlFlow<()> {
        let share = progress.time / progress.end * SIMULATION_UNITS;
        self.bar.set_position(share as u64);
        if !self.begun {
            self.bar.reset_eta();
            self.begun = true;
        }
        if !self.bar.is_hidden() {
            self.bar
                .set_message(format!("step {}, t = {:.4}", progress.step, progress.time));
        }
        unless_interrupted()
    }
}

impl Observer for CaseObserver {
    fn after_step(&mut self, progress: Progress) -> ControlFlow<()> {
        self.advance(progress.time / progress.end)
    }
}
