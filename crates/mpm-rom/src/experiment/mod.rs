//! An experiment from one file: full-order data, training, reduced runs beside full-order ones.

mod beside;
mod case;
mod comparison;
mod config;
mod error;
mod files;
mod frame_files;
mod reduced;
mod results;
mod sampling;
mod super_resolution;
#[cfg(test)]
mod tests;
mod trained;

pub use config::{
    Cases, ChoiceName, Experiment, Key, ManifoldName, QuadratureName, ReducedRuns, SampleCount, UpdateName,
};
pub use error::ExperimentError;
pub use files::names;
pub use reduced::run;
pub use results::{FrameRow, ReducedRow};
pub use super_resolution::SuperResolved;
pub use trained::{Trained, Watch, train};
