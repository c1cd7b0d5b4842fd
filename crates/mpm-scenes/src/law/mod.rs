//! Constitutive laws of a scene: several in one run.

mod any_law;
mod batch;
mod build;
mod laws;
mod memory;

pub use any_law::AnyLaw;
pub use build::build;
pub use laws::{LawState, Laws};
pub use memory::{INTERNAL_VARIABLES, MEMORY_SIZE, Memory};
