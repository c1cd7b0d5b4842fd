//! What is said of samples.

mod bandwidth;
mod kernel_density_grid;
mod moments;
mod power_law;
mod summary;
