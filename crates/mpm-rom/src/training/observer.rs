use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};

use super::Terms;

/// What an epoch reached.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct EpochReport {
    /// The epoch, counted from 0; a step of the second phase counts as one.
    pub epoch: u64,
    /// Epochs in all.
    pub epochs: u64,
    /// Means over the epoch's samples, each sample with the parameters of its step; in the second phase the loss after the step.
    pub terms: Terms,
    /// Adam's rate at the last step; in the second phase the length of the step, 0 where none made the loss less.
    pub rate: f64,
}

/// Watches a training and may stop it.
pub trait Observer {
    /// After every epoch. A break leaves a checkpoint, if one was asked for, and ends the training.
    fn after_epoch(&mut self, report: &EpochReport) -> ControlFlow<()>;
}

/// Watches nothing.
impl Observer for () {
    fn after_epoch(&mut self, _: &EpochReport) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

impl<F: FnMut(&EpochReport) -> ControlFlow<()>> Observer for F {
    fn after_epoch(&mut self, report: &EpochReport) -> ControlFlow<()> {
        self(report)
    }
}
