use crate::encoder::EncoderError;
use crate::manifold::NetworkError;
use crate::tensor_file::TensorFileError;

/// Why there is no trained model.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TrainingError {
    /// A value of the configuration is outside its range.
    #[error("{field} = {value}: must be {expected}")]
    Value {
        /// The field.
        field: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed.
        expected: &'static str,
    },
    /// The loss is NaN or infinite; a smaller `initial_rate` may help.
    #[error("epoch {epoch}, step {step}: loss {loss}")]
    NotFinite {
        /// The epoch, counted from 0.
        epoch: u64,
        /// The step, counted from 0 over all epochs.
        step: u64,
        /// The loss.
        loss: f64,
    },
    /// A checkpoint of another configuration or of other snapshots.
    #[error("{}: {what} differs; remove it to begin again", .file.display())]
    OtherCheckpoint {
        /// The checkpoint's file.
        file: std::path::PathBuf,
        /// What differs.
        what: &'static str,
    },
    /// A checkpoint cannot be written or read.
    #[error(transparent)]
    File(#[from] TensorFileError),
    /// The network cannot be made.
    #[error(transparent)]
    Network(#[from] NetworkError),
    /// The encoder cannot be made.
    #[error(transparent)]
    Encoder(#[from] EncoderError),
}
