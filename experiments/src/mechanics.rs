//! What `simulate` and the study of scenes share: how they watch a simulation, and how its errors end the command.

use std::ops::ControlFlow;

use mpm_scenes::{Observer, Progress, SceneError, SimulationError};

use crate::CommandError;
use crate::progress::{Bar, unless_interrupted};

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

/// Shows the time simulated, and stops the simulation on Ctrl-C.
impl Observer for Bar {
    fn after_step(&mut self, progress: Progress) -> ControlFlow<()> {
        self.set_share(progress.time / progress.end);
        self.say(|| format!("step {}, t = {:.4}", progress.step, progress.time));
        unless_interrupted()
    }
}
