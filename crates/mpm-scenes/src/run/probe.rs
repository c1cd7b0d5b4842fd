//! Probes: means over chosen particles.

use mpm_materials::Law;
use mpm_tensor::{Matrix, vector as algebra};

use super::motion::Motion;
use crate::SceneFault;
use crate::loads::within;
use crate::population::Population;
use crate::scene::{ProbeTable, Scene};
use crate::shape::Bounds;
use crate::values::{self, vector};

/// How far from its particle the point of a probe may be, in diagonals of the particle's cube: the corner of a regular filling is at half of one.
const NEAR: f64 = 2.0;

/// Names of the axes.
pub(super) const AXES: [&str; 3] = ["x", "y", "z"];

/// Some particles whose mean displacement, velocity and Cauchy stress is followed, weighted by mass.
pub(super) struct Probe<const D: usize> {
    name: String,
    /// Numbers of the particles, and where they were at t = 0.
    particles: Vec<(usize, [f64; D])>,
    /// The share of their mass whose front is followed.
    share: Option<f64>,
}

impl<const D: usize> Probe<D> {
    /// The probe of a table.
    ///
    /// # Errors
    /// [`SceneFault::Value`] for a region or a body without particles.
    pub fn build(scene: &Scene, index: usize, table: &ProbeTable, all: &Population<D>) -> Result<Self, SceneFault> {
        let chosen = match (&table.region, &table.at) {
            (Some(region), _) => within(
                scene,
                all,
                &format!("probes[{index}].region"),
                region,
                table.body.as_ref(),
            )?,
            (None, at) => {
                let point = vector::<D>(&format!("probes[{index}].at"), at.as_deref().unwrap_or(&[]))?;
                vec![nearest(scene, all, &point, table.body.as_ref())]
            }
        };
        let particles = chosen.into_iter().map(|p| (p, all.positions[p])).collect();
        Ok(Self {
            name: table.name.clone(),
            particles,
            share: table.share,
        })
    }

    /// Whether the points that probes of a scene look about are in the room of its bodies, and near one of their particles.
    ///
    /// # Errors
    /// [`SceneFault::Value`] for one that is not.
    pub fn check_points(scene: &Scene, room: &Bounds<D>, all: &Population<D>) -> Result<(), SceneFault> {
        for (index, table) in scene.probes.iter().enumerate() {
            let Some(at) = &table.at else { continue };
            let field = format!("probes[{index}].at");
            let point = vector::<D>(&field, at)?;
            let inside = room.contains(&point);
            let (name, lower, upper) = (&table.name, &room.lower, &room.upper);
            let expected = format!("in the domain {lower:?} to {upper:?}, of the probe `{name}`");
            values::within(&field, at, inside, &expected)?;
            let particle = nearest(scene, all, &point, table.body.as_ref());
            let position = &all.positions[particle];
            let near = algebra::distance(position, &point) <= NEAR * (D as f64).sqrt() * all.width(particle);
            let expected = format!("near a particle, of the probe `{name}`: the nearest one is at {position:?}");
            values::within(&field, at, near, &expected)?;
        }
        Ok(())
    }

    /// The names of its columns.
    pub fn columns(&self) -> Vec<String> {
        let axes = &AXES[..D];
        let vectors = ["displacement", "velocity"].into_iter();
        let mut columns: Vec<String> = vectors
            .flat_map(|field| axes.iter().map(move |axis| format!("{}_{field}_{axis}", self.name)))
            .collect();
        for (a, b) in upper_triangle::<D>() {
            columns.push(format!("{}_stress_{}{}", self.name, axes[a], axes[b]));
        }
        if self.share.is_some() {
            columns.extend(axes.iter().map(|axis| format!("{}_share_{axis}", self.name)));
        }
        columns
    }

    /// The values of its columns, given where every particle stands in the present order.
    pub fn measure(&self, motion: &dyn Motion<D>, places: &[usize]) -> Vec<f64> {
        let (particles, laws) = (motion.particles(), motion.laws());
        let (mut total, mut displacement, mut velocity) = (0.0, [0.0; D], [0.0; D]);
        let mut stress = Matrix::<D>::ZERO;
        for &(number, start) in &self.particles {
            let p = places[number];
            let mass = particles.masses.get(p);
            total += mass;
            algebra::accumulate(
                &mut displacement,
                mass,
                &algebra::subtract(&particles.positions[p], &start),
            );
            algebra::accumulate(&mut velocity, mass, &particles.velocities[p]);
            let (deformation, state) = (&particles.deformation_gradients[p], &particles.states[p]);
            let rate = particles.velocity_gradients.get(p).unwrap_or(&Matrix::ZERO);
            let ratio = laws.volume_ratio(deformation, state);
            stress += laws.kirchhoff_stress(deformation, state, rate) * (mass / ratio);
        }
        let mut values = Vec::new();
        values.extend(displacement.map(|c| c / total));
        values.extend(velocity.map(|c| c / total));
        values.extend(upper_triangle::<D>().map(|(a, b)| stress.0[a][b] / total));
        if let Some(share) = self.share {
            values.extend((0..D).map(|axis| {
                let chosen = self.particles.iter().map(|&(number, _)| places[number]);
                let masses = chosen.map(|p| (particles.positions[p][axis], particles.masses.get(p)));
                front(masses.collect(), share)
            }));
        }
        values
    }
}

/// The least x with Σ m over the (x_k, m_k) with x_k ≤ x at least `share` Σ m.
fn front(mut masses: Vec<(f64, f64)>, share: f64) -> f64 {
    masses.sort_by(|(x, _), (y, _)| x.total_cmp(y));
    let total: f64 = masses.iter().map(|(_, mass)| mass).sum();
    let (mut sum, mut last) = (0.0, f64::NAN);
    for (x, mass) in masses {
        (sum, last) = (sum + mass, x);
        if sum >= share * total {
            break;
        }
    }
    last
}

/// Pairs a ≤ b of axes.
fn upper_triangle<const D: usize>() -> impl Iterator<Item = (usize, usize)> {
    (0..D).flat_map(|a| (a..D).map(move |b| (a, b)))
}

/// The particle of a body (or of all) that is nearest to a point at t = 0; every body has some.
fn nearest<const D: usize>(scene: &Scene, all: &Population<D>, point: &[f64; D], body: Option<&String>) -> usize {
    let body = body.and_then(|name| scene.bodies.iter().position(|body| body.name == *name));
    let chosen = (0..all.positions.len()).filter(|&p| body.is_none_or(|body| all.bodies[p] as usize == body));
    let distance = |p: usize| algebra::distance_squared(&all.positions[p], point);
    chosen.min_by(|&p, &q| distance(p).total_cmp(&distance(q))).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::front;

    #[test]
    fn the_front_is_where_the_share_of_the_mass_ends() {
        let masses = [(3.0, 1.0), (1.0, 2.0), (2.0, 1.0)];
        let front = |share| front(masses.to_vec(), share);
        assert_eq!(
            [0.4, 0.5, 0.6, 0.75, 0.76, 1.0].map(front),
            [1.0, 1.0, 2.0, 2.0, 3.0, 3.0]
        );
    }
}
