#![doc = include_str!("../README.md")]

mod banana;
mod error;
mod frame;
mod gaussian;
mod mixture;
mod special;
mod target;

pub use banana::Banana;
pub use error::TargetError;
pub use frame::Frame;
pub use gaussian::Gaussian;
pub use mixture::GaussianMixture;
pub use special::normal_quantile;
pub use target::{CatalogueTarget, ExactDraws, Mode, Moments, Target, UnitCubeTransport};
