//! What is watched of a body on its way, to find its best configuration.

use super::with_defaults::with_defaults;

/// A number that says how good a configuration is; the least is the best. All are taken in the coordinates of the body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Monitor {
    /// The kernel Stein discrepancy of the inverse multiquadric, which knows place, shape and spread of the target; M scores and M² kernels a look.
    #[default]
    SteinDiscrepancy,
    /// −E\[log p\] (the paper's overall probability); M densities a look. It is least where all particles stand at a mode.
    LogDensity,
    /// −E\[log ρ_h\] of the density of the particles on the grid (the paper's average particle density); no evaluation. It is least where they stand in one place.
    ParticleDensity,
}

with_defaults! {
    /// Finds the best configuration of a run ("a transient or steady state which best approximates the target shape", MPM-ParVI paper, §3), and may end it.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub struct Watch {
        /// What is watched.
        pub monitor: Monitor = Monitor::default(),
        /// Steps from one look to the next, at least 1; the start and the end are looked at in any case.
        pub every: usize = 10,
        /// The run ends after so many looks in a row that were not better than the best one by a hundredth (`None`: it takes all its steps).
        pub patience: Option<usize> = None,
    }
}
