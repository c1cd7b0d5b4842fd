//! Distances of clouds from their targets. One theme per file.

mod common;
mod conformance;
mod energy_distance;
mod gaussian_energy;
mod kernel_stein;
mod maximum_mean_discrepancy;
mod moments;
mod wasserstein;
