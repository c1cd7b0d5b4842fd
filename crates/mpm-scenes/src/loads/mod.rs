//! Forces on particles, per unit mass: gravity, loads on some of them, manufactured body forces, barriers.

mod barrier;
mod build;
mod direct;
mod sum;

pub use barrier::{Barrier, Penetration};
pub(crate) use build::within;
pub use direct::DirectLoad;
pub use sum::Loads;
