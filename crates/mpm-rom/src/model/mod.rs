//! A trained model: manifold, encoder and where they come from.

mod file;
mod reconstruction;

use serde::{Deserialize, Serialize};

use crate::encoder::Encoder;
use crate::manifold::Network;
use crate::training::{EpochReport, Training};

/// A network, the encoder that was trained with it, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct Model<const D: usize> {
    network: Network<D>,
    encoder: Encoder<D>,
    summary: Summary,
}

/// Where a model comes from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Summary {
    /// The scene of the snapshots.
    pub scene: String,
    /// Epochs taken.
    pub epochs: u64,
    /// The epoch whose parameters were kept.
    pub best: Option<EpochReport>,
    /// The configuration.
    pub training: Training,
}

impl<const D: usize> Model<D> {
    pub(crate) fn new(network: Network<D>, encoder: Encoder<D>, summary: Summary) -> Self {
        Self {
            network,
            encoder,
            summary,
        }
    }

    /// g̃.
    pub fn network(&self) -> &Network<D> {
        &self.network
    }

    /// The map from positions of all points to x̂.
    pub fn encoder(&self) -> &Encoder<D> {
        &self.encoder
    }

    /// Where it comes from.
    pub fn summary(&self) -> &Summary {
        &self.summary
    }
}

#[cfg(test)]
mod tests;
