//! An experiment from one file: full-order data, training, reduced runs beside full-order ones.

mod beside;
mod case;
mod chosen;
mod comparison;
mod config;
mod dispatch;
mod error;
mod exchanges;
mod files;
mod frame_files;
mod more_runs;
mod options;
mod read;
mod reduced;
mod results;
mod sample_counts;
mod sampling;
mod spread;
mod starts;
mod super_resolution;
#[cfg(test)]
mod tests;
mod train;
mod trained;
mod training_states;
mod trial_runs;
mod trials;
mod variants;

pub use config::{Cases, Experiment, Key, ReducedRuns};
pub use dispatch::{run_experiment, train_experiment};
pub use error::ExperimentError;
pub use files::names;
pub use options::{All, ChoiceName, ManifoldName, QuadratureName, SampleCount};
pub use reduced::run;
pub use results::{FrameRow, ReducedRow};
pub use super_resolution::SuperResolved;
pub use train::train;
pub use trained::{Start, Trained, Watch};
pub use variants::Variant;
