use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};

use super::Terms;

/// What an epoch reached.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct EpochReport {
    /// The epoch, counted from 0.
    pub epoch: u64,
    /// Epochs in all.
    pub epochs: u64,
    /// Means over the epoch's samples, each sample with the parameters of its step.
    pub terms: Terms,
    /// The rate at the last step.
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
