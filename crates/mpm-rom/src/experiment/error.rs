use std::path::Path;

use mpm_document::DocumentError;
use mpm_scenes::{SceneError, SimulationError};

use super::Experiment;
use crate::deformation_map::DeformationMapError;
use crate::encoder::EncoderError;
use crate::full_order::{FullOrderError, named};
use crate::online::OnlineError;
use crate::tensor_file::TensorFileError;
use crate::training::TrainingError;

/// Why an experiment cannot begin or go on.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ExperimentError {
    /// A file cannot be read or written.
    #[error("cannot {operation} {file}: {source}")]
    File {
        /// What was tried.
        operation: &'static str,
        /// The file.
        file: String,
        /// What the system says.
        source: std::io::Error,
    },
    /// The file is no TOML, or not that of an experiment.
    #[error(transparent)]
    Syntax(#[from] DocumentError),
    /// A field of the experiment's file.
    #[error("{file}, {field}: {message}")]
    Field {
        /// The file.
        file: String,
        /// The field.
        field: String,
        /// What is wrong.
        message: String,
    },
    /// A full-order run of a test case.
    #[error("the full-order run of test case {case} ({values}): {source}")]
    TestCase {
        /// Its number, counted from 0.
        case: usize,
        /// Its parameters and their values.
        values: String,
        /// What went wrong.
        source: Box<FullOrderError>,
    },
    /// A file of the training is not there.
    #[error("{file} is missing: `parvi rom train` with this experiment and directory makes it")]
    Untrained {
        /// The file.
        file: String,
    },
    /// The directory holds another experiment.
    #[error(
        "{directory} holds another experiment, left untouched: choose another directory, or remove this one to begin again"
    )]
    Occupied {
        /// The directory.
        directory: String,
    },
    /// The model has been trained for another scene or another number of points.
    #[error("{file}: trained on `{found}`, the scene is `{expected}`")]
    OtherScene {
        /// The model's file.
        file: String,
        /// The model's scene and number of points.
        found: String,
        /// The experiment's.
        expected: String,
    },
    /// The scene's file says something else than when its runs were made.
    #[error("{scene}: changed since it was trained on, as {copy} has it: undo the change or choose another directory")]
    ChangedScene {
        /// The scene's file.
        scene: String,
        /// What it was.
        copy: String,
    },
    /// The training data are those of another experiment.
    #[error("{file}: {found}, where the experiment has {expected}: data of another one, choose another directory")]
    OtherData {
        /// The data's file.
        file: String,
        /// What they have.
        found: String,
        /// What the experiment has.
        expected: String,
    },
    /// A dimension that nothing is built for.
    #[error("a scene of dimension {dimension}: reduced models have 2 or 3")]
    Dimension {
        /// D.
        dimension: usize,
    },
    /// A stop was asked for.
    #[error(
        "stopped: the same line started again goes on with a training, and begins full-order and reduced runs anew; `parvi report` draws the runs that are done"
    )]
    Stopped,
    /// The scene cannot be read.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A file cannot be written.
    #[error(transparent)]
    Simulation(#[from] SimulationError),
    /// The full-order runs.
    #[error(transparent)]
    FullOrder(#[from] FullOrderError),
    /// A training that cannot begin or go on.
    #[error(transparent)]
    Training(#[from] TrainingError),
    /// A training that ended before its last epoch.
    #[error("the network of {directory}: {source}")]
    Network {
        /// Its directory.
        directory: String,
        /// Why.
        source: Box<TrainingError>,
    },
    /// The encoder.
    #[error(transparent)]
    Encoder(#[from] EncoderError),
    /// The map at rest.
    #[error(transparent)]
    Map(#[from] DeformationMapError),
    /// A reduced run that cannot begin.
    #[error(transparent)]
    Online(#[from] OnlineError),
    /// A file of snapshots or a model.
    #[error(transparent)]
    TensorFile(#[from] TensorFileError),
}

impl ExperimentError {
    /// A full-order run of a test case went wrong.
    pub(super) fn of_test_case(experiment: &Experiment, case: usize, source: FullOrderError) -> Self {
        Self::TestCase {
            case,
            values: named(&experiment.parameters, &experiment.cases.test[case]),
            source: Box::new(source),
        }
    }

    /// A field of an experiment's file is wrong.
    pub(super) fn field(file: &Path, field: &str, message: impl ToString) -> Self {
        Self::Field {
            file: file.display().to_string(),
            field: field.to_owned(),
            message: message.to_string(),
        }
    }

    pub(super) fn file(operation: &'static str, file: &Path, source: std::io::Error) -> Self {
        Self::File {
            operation,
            file: file.display().to_string(),
            source,
        }
    }
}

/// A map without a state at rest, or one from which there is no step, is a result; other errors are none.
pub(super) fn unless_impossible<T>(made: Result<T, ExperimentError>) -> Result<Result<T, String>, ExperimentError> {
    match made {
        Err(error @ (ExperimentError::Map(_) | ExperimentError::Online(_))) => Ok(Err(error.to_string())),
        made => made.map(Ok),
    }
}
