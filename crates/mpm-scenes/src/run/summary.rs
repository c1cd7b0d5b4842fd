use crate::ValidationRow;

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// At its end time.
    Finished,
    /// Stopped by its observer; the checkpoint holds the state.
    Interrupted,
}

impl Outcome {
    /// `finished` or `interrupted`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Finished => "finished",
            Self::Interrupted => "interrupted",
        }
    }
}

/// What a run did.
#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    /// How it ended.
    pub outcome: Outcome,
    /// Steps since t = 0, with those of earlier processes.
    pub steps: u64,
    /// Steps that this process took.
    pub steps_here: u64,
    /// Time reached.
    pub time: f64,
    /// Number of particles.
    pub particles: usize,
    /// Time of the checkpoint that the run went on from, if it did.
    pub resumed_at: Option<f64>,
    /// The comparison with the reference; empty where the scene has none, or the run did not finish.
    pub validation: Vec<ValidationRow>,
}
