//! Step control: how long a step may be, and how far it may move a particle.

/// Limits of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepControl {
    /// Longest time step.
    pub time_step: f64,
    /// C in Δt ≤ C h / (c + max |v_p|), c the wave speed; infinite: off.
    pub courant: f64,
    /// No particle moves farther than this multiple of h in a step; infinite: off. Nodal velocities are shortened, and
    /// the weights of a basis with w ≥ 0 average them, so the limit holds for the particles.
    pub displacement: f64,
    /// Friction γ: velocities are multiplied by e^{−γΔt}.
    pub friction: f64,
}

impl StepControl {
    /// Δt of the next step.
    pub fn next_time_step(&self, spacing: f64, wave_speed: f64, largest_speed: f64) -> f64 {
        let signal = wave_speed + largest_speed;
        if signal > 0.0 {
            self.time_step.min(self.courant * spacing / signal)
        } else {
            self.time_step
        }
    }

    /// Longest nodal velocity in a step of length `time_step`.
    pub fn speed_limit(&self, spacing: f64, time_step: f64) -> f64 {
        self.displacement * spacing / time_step
    }

    /// Factor e^{−γΔt}.
    pub fn damping(&self, time_step: f64) -> f64 {
        (-self.friction * time_step).exp()
    }
}

/// What a step did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StepReport {
    /// Δt taken.
    pub time_step: f64,
    /// Active nodes.
    pub active_nodes: usize,
    /// Largest nodal displacement Δt |v_i| / h before the limit was applied.
    pub displacement: f64,
}
