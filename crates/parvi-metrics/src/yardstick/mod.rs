//! A target of the catalogue as what particles on it are measured against.
//!
//! For a Gaussian the energy distance is exact. Every other target is represented by N reference points. The error that the
//! reference brings into ED² = 2E‖x − Y‖ − E‖x − x'‖ − E‖Y − Y'‖ has two parts. One is the mean over the reference of
//! g(y) = 2E‖x − y‖ − 2E‖Y − y‖, which for independent reference points would be of the order (M N)^{−1/2}, several percent of the
//! level E‖Y − Y'‖/M of M independent draws at N = 100 M. The other is ED²(reference, target), for independent points
//! E‖Y − Y'‖/N. Quasi-random points make both far smaller: scrambled Sobol points through the target's map from the unit cube, or
//! where it has none those of an importance sample. Their own term is the V-statistic, O(N²) once per target.

mod reference_energy;
mod reference_error;
mod representation;
mod target_yardstick;

use parvi_targets::TargetError;

use crate::MetricError;

pub use reference_error::ReferenceError;
pub use target_yardstick::TargetYardstick;

/// How a target is represented and particles are measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct YardstickOptions {
    /// N, the reference points that stand for the target; a power of two keeps their balance.
    pub points: usize,
    /// Their seed.
    pub seed: u64,
    /// Directions of the sliced Wasserstein distance.
    pub directions: usize,
    /// What distances are measured in.
    pub coordinates: Coordinates,
}

/// The coordinates in which distances are measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coordinates {
    /// The target's own. Only targets without exact moments and a map from the unit cube, the posteriors of regressions, whose axes
    /// have units of their own, are measured in standard deviations per axis, against points resampled systematically from an
    /// importance sample.
    Own,
    /// Standard deviations per axis of the points that stand for the target, as for [`Standardised`](Self::Standardised).
    Scaled,
    /// Those in which the target has mean zero and unit covariance. A target without a map from the unit cube is represented by the
    /// weighted points of an importance sample.
    Standardised,
}

impl YardstickOptions {
    /// So many points of a seed; the sliced distance is not looked at.
    pub fn of_energy(points: usize, seed: u64, coordinates: Coordinates) -> Self {
        Self {
            points,
            seed,
            directions: 1,
            coordinates,
        }
    }

    /// The same with so many directions of the sliced distance.
    pub fn over(self, directions: usize) -> Self {
        Self { directions, ..self }
    }
}

/// Errors of particles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// Squared energy distance.
    pub energy_distance_squared: f64,
    /// Sliced Wasserstein distance of order 2.
    pub sliced_wasserstein: f64,
    /// Largest error of a mean in standard deviations.
    pub mean: f64,
    /// Largest relative error of a standard deviation.
    pub deviation: f64,
    /// Largest error of a mode's mass, for targets with modes.
    pub mass: Option<f64>,
}

/// Why a target cannot be represented.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum YardstickError {
    /// The importance sample or the quasi-random points cannot be had.
    #[error(transparent)]
    Target(#[from] TargetError),
    /// The sample that stands for the target is worth too few independent draws.
    #[error(
        "the importance sample that stands for the target is worth {effective_size:.1} independent draws, not {needed}"
    )]
    ReferenceTooSmall {
        /// (Σ w)² / Σ w².
        effective_size: f64,
        /// What is compared with it, and 100 or more.
        needed: usize,
    },
    /// The points cannot be compared with.
    #[error(transparent)]
    Metric(#[from] MetricError),
}
