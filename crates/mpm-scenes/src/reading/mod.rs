//! Numbers of finished runs: of the columns of their series, and of how far their particles are from where they should be.

mod column;
mod displacement_error;
mod stencil;

pub use column::{Take, curve};
pub use displacement_error::{ReadingError, displacement_error};
