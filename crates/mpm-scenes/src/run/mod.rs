//! From a scene to its files: dispatch, the loop over steps, measurements, checkpoints.

mod basis;
mod body;
mod boundary;
mod budget;
mod checkpoint;
mod dispatch;
mod driver;
mod energies;
mod error;
mod filled;
mod frames;
mod held_facets;
mod measure;
mod motion;
mod nonlocal;
mod observer;
mod probe;
mod schedule;
mod simulate;
mod snapshot;
mod summary;
mod tagged;
mod tractions;
mod virtual_stress;

pub use error::SimulationError;
pub use frames::{Effort, frames};
pub use observer::{Observer, Progress};
pub use simulate::simulate;
pub use summary::{Outcome, Summary};
