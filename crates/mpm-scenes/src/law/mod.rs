//! Constitutive laws of a scene: several in one run.

mod build;
mod laws;

pub use build::{AnyLaw, build};
pub use laws::{LawState, Laws};
