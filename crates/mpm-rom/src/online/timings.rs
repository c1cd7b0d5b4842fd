//! Where the time of a run goes.

use std::time::Duration;

/// Wall time by phase, summed over the steps of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Timings {
    /// Sample points: positions and Jacobians.
    pub samples: Duration,
    /// Nodes that they touch.
    pub nodes: Duration,
    /// Quadrature points: found, evaluated, stresses.
    pub quadrature: Duration,
    /// Sums at the nodes and their velocities.
    pub grid: Duration,
    /// Velocities of the sample points.
    pub gather: Duration,
    /// v̂ and x̂.
    pub coordinates: Duration,
    /// Steps.
    pub steps: u64,
}

impl Timings {
    /// The sum of all phases.
    pub fn total(&self) -> Duration {
        self.samples + self.nodes + self.quadrature + self.grid + self.gather + self.coordinates
    }
}
