use std::ops::ControlFlow;

/// How far a run is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Steps taken, with those of an earlier process that it goes on from.
    pub step: u64,
    /// Time reached.
    pub time: f64,
    /// Time at which the run ends.
    pub end: f64,
}

/// Watches a run and may stop it.
pub trait Observer {
    /// After every step. A break leaves a checkpoint and ends the run.
    fn after_step(&mut self, progress: Progress) -> ControlFlow<()>;
}

/// Watches nothing.
impl Observer for () {
    fn after_step(&mut self, _: Progress) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

impl<F: FnMut(Progress) -> ControlFlow<()>> Observer for F {
    fn after_step(&mut self, progress: Progress) -> ControlFlow<()> {
        self(progress)
    }
}
