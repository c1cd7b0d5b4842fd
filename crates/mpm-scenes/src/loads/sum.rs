use mpm_core::{
    Amplitude, BodyForce, ContactPoint, ContactPotential, ForceLocation, Friction, MpmError, Particles, Sites,
};
use mpm_tensor::vector;
use rayon::prelude::*;

use super::{Barrier, DirectLoad, Penetration};
use crate::manufactured::in_the_plane;
use crate::{LawState, ManufacturedSolution};

/// The sum of all forces on particles, per unit mass.
#[derive(Default)]
pub struct Loads<const D: usize> {
    /// Acceleration of all particles; zero for none.
    pub gravity: Option<[f64; D]>,
    /// The share of it that acts.
    pub gravity_amplitude: Amplitude,
    /// Loads on some.
    pub direct: Vec<DirectLoad<D>>,
    /// Body forces of manufactured solutions.
    pub manufactured: Vec<Box<dyn ManufacturedSolution>>,
    /// Contact with rigid shapes.
    pub barrier: Option<Barrier<D>>,
    /// Reference positions X_p by the particle's number; empty without manufactured solutions.
    pub reference_positions: Vec<[f64; D]>,
    /// m_p by the particle's number.
    pub masses: Vec<f64>,
    /// Contact areas A_p by the particle's number; empty without a barrier.
    pub areas: Vec<f64>,
    /// The barrier's force per unit mass by the present order, of the last step; empty without a barrier, and where it is implicit.
    pub contact: Vec<[f64; D]>,
}

/// Particles of one piece of work.
const PIECE: usize = 1 << 10;

impl<const D: usize> Loads<D> {
    /// The acceleration of a particle, without the barrier.
    fn acceleration(&self, identity: usize, time: f64) -> [f64; D] {
        let mut sum = vector::scale(&self.gravity.unwrap_or([0.0; D]), self.gravity_amplitude.at(time));
        for load in &self.direct {
            if let Some(acceleration) = load.accelerations.get(identity) {
                vector::accumulate(&mut sum, load.amplitude.at(time), acceleration);
            }
        }
        for solution in &self.manufactured {
            if let Some(reference) = self.reference_positions.get(identity) {
                let acceleration = in_the_plane(reference, |start| solution.body_force(start, time));
                vector::accumulate(&mut sum, 1.0, &acceleration);
            }
        }
        sum
    }

    /// Whether forces act that neither gravity's energy nor the barrier's stands for.
    pub(crate) fn has_more_than_potentials(&self) -> bool {
        !self.gravity_amplitude.is_one() || !self.direct.is_empty() || !self.manufactured.is_empty()
    }

    /// Whether there is a barrier whose forces are those at the start of a step.
    pub(crate) fn has_explicit_barrier(&self) -> bool {
        self.barrier.as_ref().is_some_and(|barrier| !barrier.implicit)
    }

    /// Σ_p A_p [b(x_p') − b(x_p) + t(x_p) · (x_p' − x_p)] of an explicit barrier on particles that go from x_p to x_p' (in the order of creation), t its traction: what it stores more than
    /// the work against its forces; 0 where there is none.
    pub(crate) fn barrier_stored_beyond_work(&self, from: &[[f64; D]], to: &[[f64; D]]) -> f64 {
        let Some(barrier) = self.barrier.as_ref().filter(|barrier| !barrier.implicit) else {
            return 0.0;
        };
        let each = from.iter().zip(to).zip(&self.areas).map(|((from, to), area)| {
            let work = vector::dot(&barrier.traction(from), &vector::subtract(to, from));
            area * (barrier.energy_at(to) - barrier.energy_at(from) + work)
        });
        each.sum()
    }

    /// The work of those forces at a time, on particles that go from place to place (in the order of creation): Σ m_p (a_p − g) · Δx_p, a_p without the barrier.
    pub(crate) fn work_beside_potentials(&self, time: f64, from: &[[f64; D]], to: &[[f64; D]]) -> f64 {
        let gravity = self.gravity.unwrap_or([0.0; D]);
        let each = from.iter().zip(to).zip(&self.masses).enumerate();
        let work = each.map(|(identity, ((from, to), mass))| {
            let acceleration = vector::subtract(&self.acceleration(identity, time), &gravity);
            mass * vector::dot(&acceleration, &vector::subtract(to, from))
        });
        work.sum()
    }

    /// The barrier's force on a particle, per unit mass.
    fn contact_of(&self, identity: usize, x: &[f64; D]) -> [f64; D] {
        match (&self.barrier, self.areas.get(identity), self.masses.get(identity)) {
            (Some(barrier), Some(area), Some(mass)) => vector::scale(&barrier.traction(x), area / mass),
            _ => [0.0; D],
        }
    }

    /// The longest time step that the barrier allows; infinite without one, and where it is implicit.
    ///
    /// # Errors
    /// [`Penetration`] of the first particle that has reached a rigid shape.
    pub fn longest_step(&self, particles: &Particles<D, LawState>) -> Result<f64, Penetration> {
        let Some(barrier) = self.barrier.as_ref().filter(|barrier| !barrier.implicit) else {
            return Ok(f64::INFINITY);
        };
        let longest = (0..particles.len()).into_par_iter().with_min_len(PIECE).map(|index| {
            let identity = particles.identity(index);
            let (x, v) = (&particles.positions[index], &particles.velocities[index]);
            let (mass, area) = (self.masses.get(identity).copied(), self.areas.get(identity).copied());
            let step = barrier.longest_step(x, v, mass.unwrap_or(1.0), area.unwrap_or(1.0));
            step.map_err(|distance| Penetration { index, distance })
        });
        // The first of the particles is at fault, on any number of threads.
        longest.reduce(
            || Ok(f64::INFINITY),
            |a, b| match (a, b) {
                (Ok(a), Ok(b)) => Ok(a.min(b)),
                (Err(a), Err(b)) => Err(if a.index < b.index { a } else { b }),
                (Err(error), _) | (_, Err(error)) => Err(error),
            },
        )
    }

    /// The magnitude of the barrier's normal force on every particle, A_p p(g_p), in the present order; `None` without a barrier.
    pub fn contact_forces(&self, particles: &Particles<D, LawState>) -> Option<Vec<f64>> {
        self.barrier.as_ref()?;
        let each = particles.positions.iter().enumerate();
        let force =
            |(index, x)| particles.masses.get(index) * vector::norm(&self.contact_of(particles.identity(index), x));
        Some(each.map(force).collect())
    }

    /// Σ_p A_p b(g_p); 0 without a barrier.
    pub fn barrier_energy(&self, particles: &Particles<D, LawState>) -> f64 {
        let Some(barrier) = &self.barrier else { return 0.0 };
        let each = particles.positions.iter().enumerate();
        each.map(|(index, x)| {
            let area = self.areas.get(particles.identity(index)).copied().unwrap_or(0.0);
            area * barrier.energy_at(x)
        })
        .sum()
    }

    /// −Σ_p m_p g · x_p, with its zero at the origin and the whole of g.
    pub fn gravity_energy(&self, particles: &Particles<D, LawState>) -> f64 {
        let Some(gravity) = &self.gravity else { return 0.0 };
        let each = particles.positions.iter().enumerate();
        each.map(|(p, x)| -particles.masses.get(p) * vector::dot(gravity, x))
            .sum()
    }
}

impl<const D: usize> BodyForce<D> for Loads<D> {
    fn location(&self) -> ForceLocation {
        let some = self.gravity.is_some()
            || !self.direct.is_empty()
            || !self.manufactured.is_empty()
            || self.barrier.is_some();
        if some {
            ForceLocation::Particles
        } else {
            ForceLocation::Nowhere
        }
    }

    fn at_particles(&mut self, sites: &Sites<D>, accelerations: &mut [[f64; D]]) -> Result<(), MpmError> {
        let mut contact = std::mem::take(&mut self.contact);
        if self.barrier.as_ref().is_some_and(|barrier| !barrier.implicit) {
            contact.resize(sites.positions.len(), [0.0; D]);
            let places = sites.positions.par_iter().zip(sites.identities);
            let each = contact.par_iter_mut().zip(places).with_min_len(PIECE);
            each.for_each(|(contact, (x, &identity))| *contact = self.contact_of(identity as usize, x));
        }
        let (own, contact_of) = (&*self, &contact);
        let each = accelerations.par_iter_mut().zip(sites.identities).enumerate();
        each.with_min_len(PIECE).for_each(|(index, (acceleration, &identity))| {
            *acceleration = own.acceleration(identity as usize, sites.time);
            if let Some(contact) = contact_of.get(index) {
                vector::accumulate(acceleration, 1.0, contact);
            }
        });
        self.contact = contact;
        Ok(())
    }

    fn contact(&self) -> Option<&dyn ContactPotential<D>> {
        self.barrier.as_ref().filter(|barrier| barrier.implicit)?;
        Some(self)
    }

    fn friction(&self) -> Option<Friction<'_, D>> {
        let barrier = self.barrier.as_ref().filter(|barrier| barrier.friction > 0.0)?;
        Some(Friction {
            coefficient: barrier.friction,
            full_speed: barrier.friction_speed,
            normal_forces: &self.contact,
        })
    }
}

impl<const D: usize> ContactPotential<D> for Loads<D> {
    fn points(&self, sites: &Sites<D>, reach: f64, points: &mut Vec<ContactPoint<D>>) {
        let Some(barrier) = &self.barrier else { return };
        let limit = barrier.gap + reach.min(barrier.reach);
        let each = sites.positions.par_iter().zip(sites.identities).enumerate();
        let near = each.with_min_len(PIECE).flat_map_iter(|(particle, (x, &identity))| {
            let area = self.areas.get(identity as usize).copied().unwrap_or(0.0);
            barrier.shapes.iter().filter_map(move |shape| {
                let (distance, normal) = shape.closer_than(x, limit)?;
                Some(ContactPoint {
                    particle,
                    area,
                    distance,
                    normal,
                })
            })
        });
        points.par_extend(near);
    }

    fn pressure_and_stiffness(&self, distance: f64) -> (f64, f64) {
        let both = |barrier: &Barrier<D>| (barrier.pressure(distance), barrier.second_derivative(distance));
        self.barrier.as_ref().map_or((0.0, 0.0), both)
    }
}
