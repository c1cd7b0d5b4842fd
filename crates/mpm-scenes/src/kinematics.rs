//! Particles whose motion is prescribed.

use mpm_tensor::{Matrix, vector as algebra};

use crate::loads::within;
use crate::scene::{Scene, TurningTable};
use crate::values::{self, vector};
use crate::vector_field::spin;
use crate::{Population, SceneFault};

/// The rigid motion x(X, t) = c + v t + R(t) (X − c) with the constant rates v (velocity) and W = ω × (spin), R(t) = exp(W t).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidMotion<const D: usize> {
    /// v.
    pub velocity: [f64; D],
    /// c, which turns stay around.
    pub centre: [f64; D],
    /// W, antisymmetric.
    pub spin: Matrix<D>,
}

impl<const D: usize> RigidMotion<D> {
    /// R(t) (X − c); Rodrigues: exp(W t) = I + sin(ωt)/ω W + (1 − cos ωt)/ω² W², D ≤ 3, ω² = ‖W‖²/2.
    fn turned(&self, reference: &[f64; D], time: f64) -> [f64; D] {
        let arm = algebra::subtract(reference, &self.centre);
        let rate = (0.5 * self.spin.contract(&self.spin)).sqrt();
        if rate == 0.0 {
            return arm;
        }
        let (once, angle) = (self.spin.apply(&arm), rate * time);
        let turned = algebra::add_scaled(&arm, angle.sin() / rate, &once);
        algebra::add_scaled(&turned, (1.0 - angle.cos()) / (rate * rate), &self.spin.apply(&once))
    }

    /// x(X, t).
    pub fn position(&self, reference: &[f64; D], time: f64) -> [f64; D] {
        let turned = algebra::add(&self.centre, &self.turned(reference, time));
        algebra::add_scaled(&turned, time, &self.velocity)
    }

    /// X of what is at x at a time.
    pub fn reference(&self, position: &[f64; D], time: f64) -> [f64; D] {
        let back = algebra::add_scaled(position, -time, &self.velocity);
        if self.spin == Matrix::ZERO {
            return back;
        }
        algebra::add(&self.centre, &self.turned(&back, -time))
    }

    /// The velocity that takes what is at x at `time` in `time_step` to where it is then: (x(X, t + Δt) − x(X, t)) / Δt, an affine function of x. A
    /// velocity of the grid that is affine comes to particles without error, so that these move exactly as the body does.
    pub fn mean_velocity(&self, position: &[f64; D], time: f64, time_step: f64) -> [f64; D] {
        if self.spin == Matrix::ZERO {
            return self.velocity;
        }
        let later = self.position(&self.reference(position, time), time + time_step);
        algebra::scale(&algebra::subtract(&later, position), 1.0 / time_step)
    }

    /// ∂x/∂t = v + W R(t) (X − c).
    pub fn velocity(&self, reference: &[f64; D], time: f64) -> [f64; D] {
        algebra::add(&self.velocity, &self.spin.apply(&self.turned(reference, time)))
    }
}

/// Particles that move as one rigid body up to a time, and are free afterwards.
#[derive(Clone, Debug, PartialEq)]
pub struct KinematicRegion<const D: usize> {
    /// How they move.
    pub motion: RigidMotion<D>,
    /// Until when; infinite: to the end.
    pub until: f64,
    /// Their numbers in the order of creation, ascending.
    pub members: Vec<usize>,
}

impl<const D: usize> KinematicRegion<D> {
    /// Whether the motion is still prescribed at this time, which may be off by the rounding of a sum of steps.
    pub fn prescribes(&self, time: f64) -> bool {
        prescribes(self.until, time)
    }
}

/// Whether something lasts until a time that may be off by the rounding of a sum of steps.
pub(crate) fn prescribes(until: f64, time: f64) -> bool {
    time <= until * (1.0 + 1e-9)
}

/// The kinematic regions of a scene. As the first step begins and at the end of every step their particles take the position and velocity of their region's motion; between, they
/// send mass, momentum and stress to the grid like all others.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Kinematics<const D: usize> {
    regions: Vec<KinematicRegion<D>>,
    /// For every particle the number of its region.
    region_of: Vec<Option<u32>>,
}

impl<const D: usize> Kinematics<D> {
    /// The regions of a scene; a particle in several belongs to the first.
    ///
    /// # Errors
    /// [`SceneFault::Value`] for a region without particles of its own, and for tables that [`Scene::read`] refuses.
    pub fn of(scene: &Scene, particles: &Population<D>) -> Result<Self, SceneFault> {
        let mut all = Self {
            regions: Vec::new(),
            region_of: vec![None; particles.positions.len()],
        };
        for (index, table) in scene.kinematic.iter().enumerate() {
            let field = |key: &str| format!("kinematic[{index}].{key}");
            let mut members = within(scene, particles, &field("region"), &table.region, table.body.as_ref())?;
            members.retain(|&p| all.region_of.get(p) == Some(&None));
            let expected = "a region with particles that no earlier one has";
            values::within(&field("region"), &table.region, !members.is_empty(), expected)?;
            for &p in &members {
                if let Some(own) = all.region_of.get_mut(p) {
                    *own = Some(index as u32);
                }
            }
            all.regions.push(KinematicRegion {
                motion: motion(&field, table.velocity.as_ref(), table.rotation.as_ref())?,
                until: table.until.unwrap_or(f64::INFINITY),
                members,
            });
        }
        Ok(all)
    }

    /// The regions in the order of the scene.
    pub fn regions(&self) -> &[KinematicRegion<D>] {
        &self.regions
    }

    /// Position and velocity of a particle at a time; `None` where they are not prescribed.
    pub fn prescribed(&self, particle: usize, reference: &[f64; D], time: f64) -> Option<([f64; D], [f64; D])> {
        let region = self.region_of.get(particle).copied().flatten()?;
        let region = self
            .regions
            .get(region as usize)
            .filter(|region| region.prescribes(time))?;
        let motion = &region.motion;
        Some((motion.position(reference, time), motion.velocity(reference, time)))
    }
}

/// The motion that `velocity` and `rotation` of a table describe.
pub(crate) fn motion<const D: usize>(
    field: &dyn Fn(&str) -> String,
    velocity: Option<&Vec<f64>>,
    rotation: Option<&TurningTable>,
) -> Result<RigidMotion<D>, SceneFault> {
    let velocity = velocity.map_or(Ok([0.0; D]), |list| vector(&field("velocity"), list))?;
    let (centre, spin) = match rotation {
        None => ([0.0; D], Matrix::ZERO),
        Some(rotation) => (
            vector(&field("rotation.centre"), &rotation.centre)?,
            spin(&field("rotation.rate"), &rotation.rate)?,
        ),
    };
    Ok(RigidMotion { velocity, centre, spin })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rigid_motion_keeps_lengths_and_its_velocity_is_its_rate() {
        let motion = RigidMotion {
            velocity: [0.3, -0.2, 0.5],
            centre: [1.0, 2.0, 3.0],
            spin: spin::<3>("rate", &[0.4, -0.7, 1.1]).expect("three numbers"),
        };
        let (x, y, t, step) = ([0.5, 1.0, -2.0], [1.5, 0.2, 0.3], 0.8, 1e-5);
        assert_eq!(motion.position(&x, 0.0), x);
        let length = algebra::distance(&motion.position(&x, t), &motion.position(&y, t));
        assert!((length - algebra::distance(&x, &y)).abs() < 1e-14);
        let now = motion.position(&x, t);
        assert!(algebra::distance(&motion.reference(&now, t), &x) < 1e-14);
        let moved = algebra::add_scaled(&now, 0.3, &motion.mean_velocity(&now, t, 0.3));
        assert!(algebra::distance(&moved, &motion.position(&x, t + 0.3)) < 1e-14);
        let (before, after) = (motion.position(&x, t - step), motion.position(&x, t + step));
        let rate = algebra::scale(&algebra::subtract(&after, &before), 0.5 / step);
        assert!(algebra::distance(&rate, &motion.velocity(&x, t)) < 1e-9);
    }

    #[test]
    fn a_quarter_turn_in_the_plane_is_by_hand() {
        let motion = RigidMotion {
            velocity: [1.0, 0.0],
            centre: [1.0, 1.0],
            spin: spin::<2>("rate", &[0.5 * std::f64::consts::PI]).expect("one number"),
        };
        let x = motion.position(&[2.0, 1.0], 1.0);
        assert!(algebra::distance(&x, &[2.0, 2.0]) < 1e-15, "{x:?}");
    }
}
