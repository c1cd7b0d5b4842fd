//! The baseline for super-resolution: points that the coarse run carries along.

use mpm_core::{Boundaries, Continuum, Masses, Mpm, Particles, Pic, PrescribedVelocity, SplineGrid, StepControl};
use mpm_kernels::Quadratic;
use mpm_materials::Material;
use mpm_scenes::HeldRegion;
use mpm_scenes::loads::Loads;
use mpm_tensor::vector;

use super::FullOrderError;
use crate::online::ReducedBody;

/// Mass of a tracer as a share of its volume's: so small that it changes no digit of the motion, and large enough to divide by.
const SHARE: f64 = 1e-14;

/// A full-order run of a body with tracers.
///
/// A tracer is a particle of vanishing mass and volume (ours): it moves with the velocities of the run's grid, x ← x + Δt Σ_i N_i(x) v_i, and only nodes that no
/// particle of the body touches, beyond its surface, move with the tracers around them.
pub struct TracedRun<'a, const D: usize> {
    mpm: Mpm<D, SplineGrid<Quadratic, 3, D>, Pic, Continuum<&'a dyn Material<D>>, Loads<D>, Boundaries<D>>,
    body: &'a ReducedBody<D>,
    step: u64,
}

/// A held region, seen from the centroid.
struct Held<const D: usize> {
    region: HeldRegion<D>,
    centroid: [f64; D],
}

impl<const D: usize> PrescribedVelocity<D> for Held<D> {
    fn velocity(&self, x: &[f64; D], close: f64, time: f64, time_step: f64) -> Option<[f64; D]> {
        let x = vector::add(x, &self.centroid);
        self.region.velocity(&x, close, time, time_step)
    }
}

impl<'a, const D: usize> TracedRun<'a, D> {
    /// The body at rest at t = 0 with tracers at these reference positions, relative to its centroid.
    ///
    /// # Errors
    /// [`FullOrderError::Mechanics`].
    pub fn new(body: &'a ReducedBody<D>, tracers: &[[f64; D]]) -> Result<Self, FullOrderError> {
        let count = body.reference.len() + tracers.len();
        let mean = body.volumes.iter().sum::<f64>() / body.volumes.len().max(1) as f64;
        let mut volumes = body.volumes.clone();
        volumes.resize(count, SHARE * mean);
        let masses = volumes.iter().map(|volume| body.density * volume).collect();
        let positions = body.reference.iter().chain(tracers).copied().collect();
        let numbers = (0..count as u32).collect();
        let particles = Particles::in_order(
            positions,
            vec![[0.0; D]; count],
            Masses::Each(masses),
            Vec::new(),
            numbers,
        )?;
        let grid = SplineGrid::new(*body.grid.origin(), body.grid.spacing())?;
        let loads = Loads {
            gravity: Some(body.gravity),
            ..Loads::default()
        };
        let law: &dyn Material<D> = &*body.material;
        let mpm = Mpm::new(
            particles.with_elastic_state(volumes),
            grid,
            Pic,
            Continuum { law },
            loads,
        );
        let held = body.held.iter().map(|region| {
            let (region, centroid) = (region.clone(), body.centroid);
            Box::new(Held { region, centroid }) as Box<dyn PrescribedVelocity<D>>
        });
        let mpm = mpm.with_boundary(Boundaries::default().with_prescribed(held.collect()));
        Ok(Self { mpm, body, step: 0 })
    }

    /// All steps of one frame.
    ///
    /// # Errors
    /// [`FullOrderError::Mechanics`].
    pub fn advance_frame(&mut self) -> Result<(), FullOrderError> {
        let control = StepControl {
            time_step: self.body.time_step,
            courant: f64::INFINITY,
            displacement: f64::INFINITY,
            friction: 0.0,
        };
        for _ in 0..self.body.steps_per_frame {
            self.mpm.step(&control)?;
            self.step += 1;
            self.prescribe();
        }
        Ok(())
    }

    /// Kinematic points take their prescribed values.
    fn prescribe(&mut self) {
        let time = self.step as f64 * self.body.time_step;
        let particles = &mut self.mpm.particles;
        let numbers: Vec<usize> = (0..particles.len()).map(|index| particles.identity(index)).collect();
        let state = particles.positions.iter_mut().zip(&mut particles.velocities);
        for ((x, v), point) in state.zip(numbers) {
            if let Some((position, velocity)) = self.body.prescribed(point, time) {
                (*x, *v) = (position, velocity);
            }
        }
    }

    /// Positions of the body's points, and of the tracers after them.
    pub fn positions(&self) -> Vec<[f64; D]> {
        self.mpm
            .particles
            .in_creation_order(&self.mpm.particles.positions)
            .to_vec()
    }

    /// Positions of the tracers.
    pub fn tracers(&self) -> Vec<[f64; D]> {
        self.positions().split_off(self.body.reference.len())
    }
}
