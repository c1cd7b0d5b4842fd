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
