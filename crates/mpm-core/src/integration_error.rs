//! What the explicit update of a step does to the energy of a body, particle by particle.

use mpm_kernels::{Wanted, deformed};
use mpm_tensor::{Matrix, vector};

use crate::transfer::{CellField, GridField, Numbered, gather_cells};
use crate::{Basis, Medium, Particles, StressImpulse};

/// Vectors of the nodes by their numbers.
#[derive(Clone, Copy)]
struct Vectors<'a, const D: usize>(&'a [[f64; D]]);

impl<const D: usize> GridField<D> for Vectors<'_, D> {
    #[inline(always)]
    fn vector(&self, number: usize) -> [f64; D] {
        self.0[number]
    }
}

/// Σ_p V⁰_p [ψ((I + Δt L_p) F_p) − ψ(F_p) − τ_p : Δt L_p] with L_p = Σ_i v_i ∇w_ipᵀ, v_i the velocities of the nodes that the particles are about to move with: what the particles store more, by
/// the motion of the step, than the work of their stresses along it. It is of second order in Δt, and positive where ψ is convex along the motion.
///
/// `least_squares`: L_p by moving least squares, where that is how forces are sent. What is summed is in the order of the particles, on any number of threads.
#[inline(never)]
pub(crate) fn stored_beyond_work<const D: usize, B: Basis<D>, M: Medium<D>>(
    basis: &B,
    medium: &M,
    particles: &Particles<D, M::State>,
    velocities: &[[f64; D]],
    time_step: f64,
    least_squares: bool,
) -> f64 {
    if !M::DEFORMS {
        return 0.0;
    }
    let mut excesses = vec![0.0; particles.len()];
    let wanted = Wanted {
        gradient: true,
        least_squares,
        moment: false,
    };
    let excess = |p: usize, gradient: &Matrix<D>| {
        let deformation = &particles.deformation_gradients[p];
        let trial = deformed(deformation, gradient, time_step);
        let stored = |deformation| medium.stored_energy(particles, p, deformation);
        stored(&trial) - stored(deformation) + medium.impulse(particles, p, time_step).matrix().contract(gradient)
    };
    let field = Vectors(velocities);
    gather_cells(
        basis,
        excesses.as_mut_slice(),
        |excesses: &mut &mut [f64], range, numbers, first, nodes: &mut CellField| {
            if !B::LONE_PARTICLES {
                nodes.collect(numbers, field);
            }
            for p in range {
                let x = &particles.positions[p];
                let seen = if B::LONE_PARTICLES {
                    basis.interpolate(p, x, wanted, &Numbered { field, numbers })
                } else {
                    basis.interpolate(p, x, wanted, &nodes.nodes(numbers.len()))
                };
                excesses[p - first] = excess(p, &seen.gradient);
            }
        },
    );
    excesses.iter().sum()
}

/// ½ Σ_i m_i Δv_i · (v_iⁿ⁺¹ − v_iⁿ), Δv_i what forces have given: half of what they do more along the motion with v_iⁿ⁺¹ than along that with v_iⁿ.
pub(crate) fn half_the_lead<const D: usize>(
    masses: impl Iterator<Item = f64>,
    (brought, forced, last): (&[[f64; D]], &[[f64; D]], &[[f64; D]]),
) -> f64 {
    let each = masses.enumerate().map(|(i, mass)| {
        let (given, change) = (
            vector::subtract(&forced[i], &brought[i]),
            vector::subtract(&last[i], &brought[i]),
        );
        0.5 * mass * vector::dot(&given, &change)
    });
    each.sum()
}
