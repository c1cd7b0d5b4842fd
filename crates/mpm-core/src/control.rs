//! Step control: how long a step may be, and how far it may move a particle.

use crate::MpmError;
use crate::error::{not_negative, within};

/// Limits of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepControl {
    /// Longest time step; > 0 and finite.
    pub time_step: f64,
    /// C > 0 in Δt ≤ C h / (c + max |v_p|), c the wave speed; infinite: off.
    pub courant: f64,
    /// No particle moves farther than this multiple (> 0) of h in a step; infinite: off. Nodal velocities are shortened, and
    /// the weights of a basis with w ≥ 0 average them, so the limit holds for the particles. What is shortened loses its momentum: a guard for sampling, and for
    /// mechanics one that must not act ([`StepReport::displacement`] says whether it did).
    pub displacement: f64,
    /// Friction γ ≥ 0, finite: v_i ← e^{−γΔt} (v_i + Δt f_i / m_i), with all forces f_i, those of contact, friction and [`NodeForces`](crate::NodeForces) among them. What is at
    /// rest is in balance, however large γΔt; what boundaries prescribe is not damped.
    pub friction: f64,
}

impl StepControl {
    /// Whether every limit is in its range.
    ///
    /// # Errors
    /// [`MpmError::InvalidParameter`] with the first that is not.
    pub fn check(&self) -> Result<(), MpmError> {
        let positive = |field, value: f64| within(field, value, value > 0.0, "positive");
        let is_step = self.time_step > 0.0 && self.time_step.is_finite();
        within("time_step", self.time_step, is_step, "positive and finite")?;
        positive("courant", self.courant)?;
        positive("displacement", self.displacement)?;
        not_negative("friction", self.friction)
    }

    /// Δt of the next step, min(`time_step`, C h / (c + max |v_p|)).
    ///
    /// # Errors
    /// [`MpmError::NoTimeStep`] where the speeds leave none: Δt would be zero or is not a number.
    pub fn next_time_step(&self, spacing: f64, wave_speed: f64, particle_speed: f64) -> Result<f64, MpmError> {
        if self.courant == f64::INFINITY {
            return Ok(self.time_step);
        }
        let bound = self.courant * spacing / (wave_speed + particle_speed);
        if bound > 0.0 {
            Ok(self.time_step.min(bound))
        } else {
            Err(MpmError::NoTimeStep {
                wave_speed,
                particle_speed,
            })
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
    /// Largest nodal displacement Δt |v_i| / h before the limit was applied; infinite where |v_i|² overflows.
    pub displacement: f64,
}
