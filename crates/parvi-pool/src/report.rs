//! What is told of a pool that grows.

use std::ops::ControlFlow;

use crate::options::Round;

/// What is told after every round, and now and then while evaluations take long.
#[derive(Clone, Copy, Debug)]
pub struct Report<'a> {
    /// The round, where one has just ended.
    pub round: Option<&'a Round>,
    /// Evaluations so far, of all kinds.
    pub evaluations: u64,
    /// How many there may be, as far as is known now.
    pub limit: u64,
    /// Every value of the target so far, in the order of evaluation.
    pub tape: &'a [f64],
}

/// Who is told; a `Break` ends the exploration with [`PoolError::Interrupted`](crate::PoolError::Interrupted).
pub type Observer<'a> = dyn FnMut(&Report<'_>) -> ControlFlow<()> + 'a;
