use std::path::Path;

use serde::{Deserialize, Serialize};

use super::adam::Adam;
use super::finish::{InverseHessian, QuasiNewton};
use super::trainer::{Best, Trainer};
use super::{EpochReport, Terms, Training, TrainingError};
use crate::manifold::Scaling;
use crate::snapshots::Snapshots;
use crate::tensor_file::{TensorReader, TensorWriter};

const KIND: &str = "training-checkpoint";
const VERSION: u32 = 3;

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Header {
    dimension: usize,
    scene: String,
    training: Training,
    /// Fitted to all positions, hence different for other snapshots.
    scaling: Scaling,
    steps: u64,
    best: Option<EpochReport>,
    /// Loss of the second phase, where it has begun.
    finish: Option<Terms>,
    history: Vec<EpochReport>,
}

impl<'a, const D: usize> Trainer<'a, D> {
    /// Writes the whole state: parameters, moments and steps of Adam, best parameters, reports. Random numbers need no state, every epoch has a
    /// stream of its own. Tensors: `network`, `encoder`, `first`, `second`, `best_network`, `best_encoder` if there is a best epoch,
    /// and `finish_gradient`, `finish_product`, `finish_inverse` (its rows on and below the diagonal) in the second phase.
    ///
    /// # Errors
    /// [`TrainingError::File`].
    pub fn write_checkpoint(&self, path: &Path) -> Result<(), TrainingError> {
        let header = Header {
            dimension: D,
            scene: self.snapshots.body().scene.clone(),
            training: self.config.clone(),
            scaling: self.network.scaling().clone(),
            steps: self.adam.steps,
            best: self.best.as_ref().map(|best| best.report),
            finish: self.finish.as_ref().map(|state| state.terms),
            history: self.history.clone(),
        };
        let mut file = TensorWriter::default();
        let mut add = |name: &str, values: &[f64]| file.add(name, &[values.len()], values.iter().copied());
        add("network", self.network.parameters());
        add("encoder", self.encoder.parameters());
        add("first", &self.adam.first);
        add("second", &self.adam.second);
        if let Some(best) = &self.best {
            add("best_network", &best.network);
            add("best_encoder", &best.encoder);
        }
        if let Some(state) = &self.finish {
            add("finish_gradient", &state.gradient);
            add("finish_product", &state.product);
            add("finish_inverse", &state.inverse.lower());
        }
        Ok(file.write(path, KIND, VERSION, &header)?)
    }

    /// The training as [`Self::write_checkpoint`] left it. `epochs` sets the schedule of rates, so it has to be the same as before.
    ///
    /// # Errors
    /// [`TrainingError::File`]; [`TrainingError::OtherCheckpoint`] for another configuration or other snapshots; those of [`Self::new`].
    pub fn resume(snapshots: &'a Snapshots<D>, config: Training, path: &Path) -> Result<Self, TrainingError> {
        let mut trainer = Self::new(snapshots, config)?;
        let file = TensorReader::open(path, KIND, VERSION)?;
        let header: Header = file.header()?;
        file.expect_dimension(header.dimension, D)?;
        let refuse = |what| Err(TrainingError::OtherCheckpoint { what });
        // How often checkpoints are written has no part in the result.
        let same = Training {
            checkpoint_interval: trainer.config.checkpoint_interval,
            ..header.training
        };
        if same != trainer.config {
            return refuse("configuration");
        }
        if header.scene != snapshots.body().scene || header.scaling != *trainer.network.scaling() {
            return refuse("snapshots");
        }
        let (network, encoder) = (trainer.network.parameters().len(), trainer.encoder.parameters().len());
        trainer
            .network
            .parameters_mut()
            .copy_from_slice(&file.tensor("network", &[network])?);
        trainer
            .encoder
            .parameters_mut()
            .copy_from_slice(&file.tensor("encoder", &[encoder])?);
        trainer.adam = Adam {
            first: file.tensor("first", &[network + encoder])?,
            second: file.tensor("second", &[network + encoder])?,
            steps: header.steps,
        };
        if let Some(report) = header.best {
            trainer.best = Some(Best {
                report,
                network: file.tensor("best_network", &[network])?,
                encoder: file.tensor("best_encoder", &[encoder])?,
            });
        }
        if let Some(terms) = header.finish {
            let lower = file.tensor("finish_inverse", &[network * (network + 1) / 2])?;
            trainer.finish = Some(QuasiNewton {
                inverse: InverseHessian::from_lower(network, &lower),
                gradient: file.tensor("finish_gradient", &[network])?,
                product: file.tensor("finish_product", &[network])?,
                terms,
            });
        }
        trainer.history = header.history;
        Ok(trainer)
    }
}
