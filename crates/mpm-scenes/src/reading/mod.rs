//! Numbers of finished runs: of the columns of their series, and of how far their particles are from where they should be.

mod column;
mod displacement_error;
mod stated;
mod stencil;

pub use column::{Take, curve};
pub use displacement_error::{ReadingError, displacement_error};
pub use stated::{FinishedRun, Measured, OtherRun, ParticleReading, Reading};
