//! What the particles are made of: the stress impulse of a step, and whether it needs a deformation gradient.

mod elastic;
mod gas;

use mpm_kernels::Deposit;
use mpm_tensor::Matrix;

pub use elastic::Elastic;

use crate::{Basis, MpmError, Particles};

/// Impulses per node that are linear in ∇w_ip: a pressure (`f64`) or a full stress (`Matrix<D>`).
pub trait StressImpulse<const D: usize>: Copy + Send + Sync {
    /// The impulse at a node with shape-function gradient ∇w_ip.
    fn at(&self, gradient: &[f64; D]) -> [f64; D];

    /// Visit the stencil of a particle at `x` with weight and w_ip `value` + (0, [`at`](Self::at)(∇w_ip)).
    #[inline(always)]
    fn for_each_deposit<B: Basis<D>>(
        &self,
        basis: &B,
        particle: usize,
        x: &[f64; D],
        value: &Deposit<D>,
        mut visit: impl FnMut(usize, f64, &Deposit<D>),
    ) {
        basis.for_each_node(particle, x, |index, entry| {
            let stress = Deposit {
                scalar: 0.0,
                vector: self.at(&entry.gradient),
            };
            visit(index, entry.weight, &value.combine(entry.weight, &stress, 1.0));
        });
    }
}

impl<const D: usize> StressImpulse<D> for f64 {
    #[inline(always)]
    fn at(&self, gradient: &[f64; D]) -> [f64; D] {
        gradient.map(|c| self * c)
    }

    #[inline(always)]
    fn for_each_deposit<B: Basis<D>>(
        &self,
        basis: &B,
        particle: usize,
        x: &[f64; D],
        value: &Deposit<D>,
        visit: impl FnMut(usize, f64, &Deposit<D>),
    ) {
        basis.for_each_deposit(particle, x, value, *self, visit);
    }
}

impl<const D: usize> StressImpulse<D> for Matrix<D> {
    #[inline(always)]
    fn at(&self, gradient: &[f64; D]) -> [f64; D] {
        self.apply(gradient)
    }
}

/// The internal force of a medium: f_i = −Σ_p V⁰_p τ_p ∇w_ip.
pub trait Medium<const D: usize>: Sync {
    /// −Δt V⁰_p τ_p, as a scalar where the stress is a pressure.
    type Impulse: StressImpulse<D>;

    /// Whether the medium reads F_p; without it F_p is neither stored nor updated.
    const DEFORMS: bool;

    /// −Δt V⁰_p τ_p of one particle.
    fn impulse(&self, particles: &Particles<D>, particle: usize, time_step: f64) -> Self::Impulse;

    /// Largest wave speed in the medium's present state, for the CFL condition. Asked once at the start of every step, it
    /// is also where a medium refuses a state.
    ///
    /// # Errors
    /// [`MpmError::Deformation`] for the first particle that has no stress, [`MpmError::WaveSpeed`] for the first one with
    /// mass and reference volume that give no wave speed.
    fn wave_speed(&self, particles: &Particles<D>) -> Result<f64, MpmError>;
}
