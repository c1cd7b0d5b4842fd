//! What looks at the particles of a run on their way: progress, frames and pictures.

use std::ops::ControlFlow;

use parvi::{Observer, ParticleView, Progress};
use parvi_files::FrameWriter;
use parvi_files::pictures::History;

use crate::CommandError;
use crate::progress::Bar;

/// Several observers as one.
pub struct Watch {
    /// The bar, and Ctrl-C.
    pub progress: Bar,
    /// Where frames are asked for.
    pub frames: Option<FrameWriter>,
    /// Where pictures are asked for.
    pub history: Option<History>,
}

impl Watch {
    /// The error of a run, or what stopped it here.
    pub fn reason(&mut self, error: CommandError) -> CommandError {
        let failure = self.frames.as_mut().and_then(FrameWriter::failure);
        failure.map_or(error, CommandError::from)
    }
}

impl Observer for Watch {
    fn after_step(&mut self, progress: Progress) -> ControlFlow<()> {
        self.progress.after_step(progress)
    }

    fn evaluated(&mut self, evaluations: u64, limit: u64) -> ControlFlow<()> {
        self.progress.evaluated(evaluations, limit)
    }

    fn see(&mut self, view: &ParticleView<'_>) -> ControlFlow<()> {
        if let Some(history) = &mut self.history {
            history.see(view)?;
        }
        let frames = self.frames.as_mut();
        frames.map_or(ControlFlow::Continue(()), |frames| frames.see(view))
    }
}
