#![doc = include_str!("../README.md")]

mod cloud;
mod directions;
mod energy_distance;
mod error;
mod gaussian_discrepancy;
mod gaussian_energy;
mod kernel_stein;
mod lanes;
mod maximum_mean_discrepancy;
mod mode_mass;
mod moments;
mod norm_expectation;
mod pair_sum;
mod radial_kernel;
mod sliced_wasserstein;
mod sorted;
mod standardise;
mod summation;
mod wasserstein;
pub mod yardstick;

pub use cloud::{Cloud, effective_sample_size};
pub use directions::Directions;
pub use energy_distance::{EnergyReference, energy_distance_squared, mean_pair_distance};
pub use error::MetricError;
pub use gaussian_discrepancy::GaussianDiscrepancy;
pub use gaussian_energy::GaussianEnergy;
pub use kernel_stein::{InverseMultiquadric, SteinDiscrepancy, kernel_stein_discrepancy, target_stein_discrepancy};
pub use maximum_mean_discrepancy::{DiscrepancyReference, maximum_mean_discrepancy_squared};
pub use mode_mass::ModeMasses;
pub use moments::{CloudMoments, MomentError, quantiles};
pub use radial_kernel::RadialKernel;
pub use sliced_wasserstein::{SlicedReference, sliced_wasserstein};
pub use standardise::Standardiser;
pub use wasserstein::wasserstein_1d;
