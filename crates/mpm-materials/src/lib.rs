#![doc = include_str!("../README.md")]
// F, J, R, P and the like are the symbols of the field.
#![allow(non_snake_case)]

mod any_law;
pub mod conformance;
mod deforming_gas;
mod drucker_prager;
mod elastic_moduli;
mod error;
mod exponential;
mod fixed_corotated;
mod flowing_gas;
mod hencky;
mod isothermal_gas;
mod kelvin_voigt;
mod law;
mod linear_cauchy;
mod linear_elastic;
mod log_strain;
mod material;
mod neo_hookean;
mod rotations;
mod side_by_side;
mod snow;
mod softening_hencky;
mod stretch;
mod stretch_limit;
mod tait_fluid;
mod tracked_gas;

pub use any_law::{AnyLaw, Memory, Numbered, Remembered};
pub use deforming_gas::{DeformingGas, GasState};
pub use drucker_prager::{DruckerPrager, DruckerPragerState};
pub use elastic_moduli::ElasticModuli;
pub use error::{DeformationError, ParameterError};
pub use fixed_corotated::FixedCorotated;
pub use flowing_gas::FlowingGas;
pub use hencky::Hencky;
pub use isothermal_gas::IsothermalGas;
pub use kelvin_voigt::KelvinVoigt;
pub use law::Law;
pub use linear_cauchy::LinearCauchy;
pub use linear_elastic::LinearElastic;
pub use material::Material;
pub use neo_hookean::NeoHookean;
pub use snow::{Snow, SnowState};
pub use softening_hencky::{SofteningHencky, SofteningState};
pub use tait_fluid::TaitFluid;
pub use tracked_gas::TrackedGas;
