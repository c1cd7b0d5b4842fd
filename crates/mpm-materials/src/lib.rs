#![doc = include_str!("../README.md")]

mod drucker_prager;
mod elastic_moduli;
mod error;
mod exponential;
mod fixed_corotated;
mod hencky;
mod isothermal_gas;
mod law;
mod linear_elastic;
mod log_strain;
mod material;
mod neo_hookean;
mod rotations;
mod side_by_side;
mod softening_hencky;
mod stretch;
mod tait_fluid;
mod tracked_gas;

pub use drucker_prager::{DruckerPrager, DruckerPragerState};
pub use elastic_moduli::ElasticModuli;
pub use error::{DeformationError, ParameterError};
pub use fixed_corotated::FixedCorotated;
pub use hencky::Hencky;
pub use isothermal_gas::IsothermalGas;
pub use law::Law;
pub use linear_elastic::LinearElastic;
pub use material::Material;
pub use neo_hookean::NeoHookean;
pub use softening_hencky::{SofteningHencky, SofteningState};
pub use tait_fluid::TaitFluid;
pub use tracked_gas::TrackedGas;
