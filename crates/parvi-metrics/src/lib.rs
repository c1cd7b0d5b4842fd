//! How far a particle cloud is from its target.
mod cloud;
mod energy_distance;
mod error;
mod gaussian_energy;
mod lanes;
mod norm_expectation;
mod pair_sum;
mod sorted;
mod summation;

pub use cloud::{Cloud, effective_sample_size};
pub use energy_distance::{EnergyReference, energy_distance_squared, mean_pair_distance};
pub use error::MetricError;
pub use gaussian_energy::GaussianEnergy;
