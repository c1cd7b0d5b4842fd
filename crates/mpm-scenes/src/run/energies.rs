//! The energies of a body.

use mpm_materials::Law;

use super::motion::Motion;

/// The energies of a body; what it has not is 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Energies {
    pub kinetic: f64,
    pub affine: f64,
    pub strain: f64,
    pub potential: f64,
    pub barrier: f64,
}

impl Energies {
    /// Those now.
    pub fn of<const D: usize>(motion: &dyn Motion<D>) -> Self {
        let (particles, loads) = (motion.particles(), motion.loads());
        Self {
            kinetic: particles.kinetic_energy(),
            affine: if motion.is_affine() { affine_energy(motion) } else { 0.0 },
            strain: strain_energy(motion),
            potential: loads.gravity_energy(particles),
            barrier: loads.barrier_energy(particles),
        }
    }

    /// All together.
    pub fn sum(&self) -> f64 {
        self.kinetic + self.affine + self.strain + self.potential + self.barrier
    }
}

/// ½ Σ m_p tr(B_p D_p⁻¹ B_pᵀ), the kinetic energy of the affine motion around the particles (Jiang et al. 2015, §5.3).
fn affine_energy<const D: usize>(motion: &dyn Motion<D>) -> f64 {
    let particles = motion.particles();
    let each = particles.affine.iter().zip(&particles.positions).enumerate();
    let energy =
        each.map(|(p, (moment, x))| particles.masses.get(p) * (*moment * motion.inverse_moment(x)).contract(moment));
    0.5 * energy.sum::<f64>()
}

/// Σ V⁰_p ψ_p.
fn strain_energy<const D: usize>(motion: &dyn Motion<D>) -> f64 {
    let (particles, laws) = (motion.particles(), motion.laws());
    let fields = particles.deformation_gradients.iter().zip(&particles.states);
    let each = fields.zip(&particles.reference_volumes);
    each.map(|((deformation, state), volume)| volume * laws.energy_density(deformation, state))
        .sum()
}
