//! Particles deform by the velocities around them.

use mpm_kernels::{Wanted, deformed};
use mpm_tensor::Matrix;

use crate::transfer::{CellField, Moving, MovingParticle, Numbered, Velocities, gather_cells};
use crate::{Basis, Medium, Member, StressWork, VelocityNode};

/// What makes of a velocity gradient a deformation.
pub(crate) struct Deformation<'a, M> {
    medium: &'a M,
    pub time_step: f64,
    rate_dependent: bool,
    /// Whether the medium is asked what it admits; with volume averaging the trial deformation gradient is left for [`average_volume_ratios`](crate::volume_averaging::average_volume_ratios).
    admit: bool,
}

impl<M> Clone for Deformation<'_, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M> Copy for Deformation<'_, M> {}

impl<'a, M> Deformation<'a, M> {
    /// Over a time step.
    pub fn of<const D: usize>(medium: &'a M, time_step: f64, admit: bool) -> Self
    where
        M: Medium<D>,
    {
        let rate_dependent = medium.rate_dependent();
        Self {
            medium,
            time_step,
            rate_dependent,
            admit,
        }
    }

    /// Deform a particle that sees a velocity gradient.
    #[allow(non_snake_case)]
    #[inline(always)]
    pub fn apply<const D: usize>(&self, particle: MovingParticle<D, M::State>, gradient: &Matrix<D>)
    where
        M: Medium<D>,
    {
        if let Some((F, state)) = particle.deformation {
            let trial = deformed(F, gradient, self.time_step);
            match particle.work {
                None => *F = self.admitted(&trial, state),
                Some(work) => {
                    let before = particle.velocity_gradient.as_deref().unwrap_or(&Matrix::ZERO);
                    *work = self.account((F, trial), state, &(*gradient * self.time_step), before);
                }
            }
            if let (true, Some(velocity_gradient)) = (self.rate_dependent, particle.velocity_gradient) {
                *velocity_gradient = *gradient;
            }
        }
    }

    /// What becomes of a trial.
    #[inline(always)]
    fn admitted<const D: usize>(&self, trial: &Matrix<D>, state: &mut M::State) -> Matrix<D>
    where
        M: Medium<D>,
    {
        if self.admit {
            self.medium.advance(trial, state)
        } else {
            *trial
        }
    }

    /// Deform along the motion `way` = Δt L, and say what becomes of the work. Apart, and with the trial by value: elsewhere it stays in registers.
    #[allow(non_snake_case)]
    #[inline(never)]
    fn account<const D: usize>(
        &self,
        (F, trial): (&mut Matrix<D>, Matrix<D>),
        state: &mut M::State,
        way: &Matrix<D>,
        velocity_gradient: &Matrix<D>,
    ) -> StressWork
    where
        M: Medium<D>,
    {
        let work = self.medium.stress_work([F, &trial], way, state, velocity_gradient);
        *F = self.admitted(&trial, state);
        // What a trial beyond the yield surface would store is taken back within the step: none of it is an error of the time integration.
        if self.medium.yields([&trial, F], state) {
            StressWork::default()
        } else {
            work
        }
    }
}

/// G2P of particles that deform where they are. Compiled once for all transfers, but for the gradients of moving least squares.
pub(crate) fn deform<const LEAST_SQUARES: bool, const D: usize, B: Basis<D>, M: Medium<D>>(
    basis: &B,
    nodes: &[VelocityNode<D>],
    moving: Moving<D, M::State>,
    deformation: Deformation<M>,
) {
    let velocity = Velocities::<_, D>(nodes);
    gather_cells(
        basis,
        moving,
        move |data: &mut Moving<D, M::State>, work, first, (collected, velocities): &mut (B::Cell, CellField)| {
            let wanted = Wanted {
                gradient: M::DEFORMS,
                least_squares: LEAST_SQUARES,
                moment: false,
            };
            let (numbers, size) = (work.nodes, work.nodes.len());
            if !B::LONE_PARTICLES {
                velocities.collect_entering(basis, (work.cell, collected), numbers, velocity);
            }
            for p in work.particles {
                let particle = data.particle(p - first, false, M::DEFORMS);
                let x = *particle.position;
                let member = Member {
                    cell: collected,
                    particle: p,
                    x: &x,
                };
                let seen = if B::LONE_PARTICLES {
                    let field = velocity;
                    basis.interpolate(member, wanted, &Numbered { field, numbers })
                } else {
                    basis.interpolate(member, wanted, &velocities.nodes(basis, size))
                };
                deformation.apply(particle, &seen.gradient);
            }
        },
    );
}
