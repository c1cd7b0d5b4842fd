//! What the particles are made of: the stress impulse of a step, and whether it needs a deformation gradient.

mod continuum;
mod deforms_last;
mod gas;

use std::ops::Range;

use mpm_kernels::Columns;
use mpm_tensor::Matrix;

pub use continuum::Continuum;
pub use deforms_last::DeformsLast;

use crate::{MpmError, Particles};

/// Impulses per node that are linear in ∇w_ip: a pressure (`f64`) or a full stress (`Matrix<D>`).
pub trait StressImpulse<const D: usize>: Columns<D> + Send + Sync {
    /// No stress.
    const ZERO: Self;

    /// As a full stress.
    fn matrix(&self) -> Matrix<D>;
}

impl<const D: usize> StressImpulse<D> for f64 {
    const ZERO: Self = 0.0;

    #[inline(always)]
    fn matrix(&self) -> Matrix<D> {
        Matrix::IDENTITY * *self
    }
}

impl<const D: usize> StressImpulse<D> for Matrix<D> {
    const ZERO: Self = Matrix::ZERO;

    #[inline(always)]
    fn matrix(&self) -> Matrix<D> {
        *self
    }
}

/// What becomes of the work of a particle's stress in a step, per reference volume.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StressWork {
    /// ψ((I + Δt L) F) − ψ(F) − τ : Δt L, what it stores more than the work of its stress at rest, τ(F, 0).
    pub stored_beyond: f64,
    /// The work of what the rate adds to that stress, (τ(F, L_p) − τ(F, 0)) : Δt L.
    pub viscous: f64,
}

/// The internal force of a medium: f_i = −Σ_p V⁰_p τ_p ∇w_ip.
pub trait Medium<const D: usize>: Sync {
    /// −Δt V⁰_p τ_p, as a scalar where the stress is a pressure.
    type Impulse: StressImpulse<D>;

    /// Internal variables of a particle, kept in [`Particles::states`]; `()` for a medium without memory.
    type State: Copy + Send + Sync;

    /// Whether the medium reads F_p; without it F_p is neither stored nor updated.
    const DEFORMS: bool;

    /// Whether particles deform last and without averaged volumes, whatever else a body could be told ([`DeformsLast`]); other orders are then
    /// not even compiled.
    const ORDER_IS_FIXED: bool = false;

    /// Whether the stress reads the velocity gradient; without, it is not stored.
    fn rate_dependent(&self) -> bool {
        false
    }

    /// −Δt V⁰_p τ_p of one particle.
    fn impulse(&self, particles: &Particles<D, Self::State>, particle: usize, time_step: f64) -> Self::Impulse;

    /// [`impulse`](Self::impulse) of the particles of a range, written to `impulses`; media that deform do it for several at once.
    fn impulses(
        &self,
        particles: &Particles<D, Self::State>,
        range: Range<usize>,
        time_step: f64,
        impulses: &mut Vec<Self::Impulse>,
    ) {
        impulses.clear();
        impulses.extend(range.map(|particle| self.impulse(particles, particle, time_step)));
    }

    /// Takes the trial (I + Δt L_p) F_p to a deformation gradient that the medium admits, and updates the internal variables;
    /// the trial itself for a medium without memory.
    #[inline(always)]
    fn advance(&self, trial: &Matrix<D>, _state: &mut Self::State) -> Matrix<D> {
        *trial
    }

    /// What becomes of the work of a particle's stress along the motion `way` = Δt L, which takes its deformation gradient from `from` to `to`; stresses by its present state and velocity
    /// gradient. 0 for a medium that does not deform.
    fn stress_work(
        &self,
        [_from, _to]: [&Matrix<D>; 2],
        _way: &Matrix<D>,
        _state: &Self::State,
        _velocity_gradient: &Matrix<D>,
    ) -> StressWork {
        StressWork::default()
    }

    /// Whether a particle that was to deform to `trial` has been taken to `kept` at less energy than rounding explains: it yields. `state` is that after.
    fn yields(&self, [_trial, _kept]: [&Matrix<D>; 2], _state: &Self::State) -> bool {
        false
    }

    /// J, the present volume of a particle over its reference volume.
    #[inline(always)]
    fn volume_ratio(&self, deformation_gradient: &Matrix<D>, _state: &Self::State) -> f64 {
        deformation_gradient.determinant()
    }

    /// Largest wave speed in the medium's present state, for the CFL condition. Asked once at the start of every step, it
    /// is also where a medium refuses a state.
    ///
    /// # Errors
    /// [`MpmError::Deformation`] for the first particle that has no stress, [`MpmError::WaveSpeed`] for the first one with
    /// mass and reference volume that give no wave speed.
    fn wave_speed(&self, particles: &Particles<D, Self::State>) -> Result<f64, MpmError>;
}
