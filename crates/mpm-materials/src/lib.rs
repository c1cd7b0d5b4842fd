#![doc = include_str!("../README.md")]

mod elastic_moduli;
mod error;
mod isothermal_gas;
mod linear_elastic;
mod material;
mod neo_hookean;
mod stretch;
mod tracked_gas;

pub use elastic_moduli::ElasticModuli;
pub use error::{DeformationError, ParameterError};
pub use isothermal_gas::IsothermalGas;
pub use linear_elastic::LinearElastic;
pub use material::Material;
pub use neo_hookean::NeoHookean;
pub use tracked_gas::TrackedGas;
