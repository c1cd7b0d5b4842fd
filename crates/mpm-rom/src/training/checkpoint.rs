use std::path::Path;

use serde::{Deserialize, Serialize};

use super::trainer::{Best, Trainer};
use super::{EpochReport, Training, TrainingError};
use crate::manifold::Scaling;
use crate::snapshots::Snapshots;
use crate::tensor_file::{FileLayout, TensorReader, TensorWriter};

const LAYOUT: FileLayout = ("training-checkpoint", 4);

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
    history: Vec<EpochReport>,
}

impl<'a, const D: usize> Trainer<'a, D> {
    /// Writes the whole state: parameters, numbers and steps of the optimizer, best parameters, reports. Random numbers need no state, every epoch has a
    /// stream of its own. Tensors: `network`, `encoder`, `descent`, and `best_network`, `best_encoder` if there is a best epoch.
    ///
    /// # Errors
    /// [`TrainingError::File`].
    pub fn write_checkpoint(&self, path: &Path) -> Result<(), TrainingError> {
        let header = Header {
            dimension: D,
            scene: self.snapshots.body().scene.clone(),
            training: self.config.clone(),
            scaling: self.network.scaling().clone(),
            steps: self.descent.steps,
            best: self.best.as_ref().map(|best| best.report),
            history: self.history.clone(),
        };
        let mut file = TensorWriter::default();
        file.add_list("network", self.network.parameters());
        file.add_list("encoder", self.encoder.parameters());
        file.add_list("descent", &self.descent.state());
        if let Some(best) = &self.best {
            file.add_list("best_network", &best.network);
            file.add_list("best_encoder", &best.encoder);
        }
        Ok(file.write(path, LAYOUT, &header)?)
    }

    /// The training as [`Self::write_checkpoint`] left it. `epochs` sets the schedule of rates, so it has to be the same as before.
    ///
    /// # Errors
    /// [`TrainingError::File`]; [`TrainingError::OtherCheckpoint`] for another configuration or other snapshots; those of [`Self::new`].
    pub fn resume(snapshots: &'a Snapshots<D>, config: Training, path: &Path) -> Result<Self, TrainingError> {
        let mut trainer = Self::new(snapshots, config)?;
        let file = TensorReader::open(path, LAYOUT)?;
        let header: Header = file.header()?;
        file.expect_dimension(header.dimension, D)?;
        let refuse = |what| {
            let file = path.to_owned();
            Err(TrainingError::OtherCheckpoint { file, what })
        };
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
        let state = trainer.descent.state().len();
        trainer
            .descent
            .restore(header.steps, &file.tensor("descent", &[state])?);
        if let Some(report) = header.best {
            trainer.best = Some(Best {
                report,
                network: file.tensor("best_network", &[network])?,
                encoder: file.tensor("best_encoder", &[encoder])?,
            });
        }
        trainer.history = header.history;
        Ok(trainer)
    }
}
