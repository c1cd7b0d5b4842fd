//! What can be seen of a reduced body, as of a full-order one.

use mpm_scenes::Snapshot;
use mpm_tensor::{Matrix, vector};

use super::ReducedModel;
use crate::deformation_map::MaterialPoints;
use crate::manifold::Evaluation;

impl<const D: usize> ReducedModel<'_, D> {
    /// The body now at prepared points, in the scene's coordinates: what the full-order run of the scene would show of them. Every point has an equal share of the body's volume
    /// (ours: points that the dynamics do not know have none of their own), and its stress is that of F. Where J ≤ 0 it is not a number.
    pub fn snapshot(&self, points: &MaterialPoints<D>) -> Snapshot {
        let mut there = Evaluation::default();
        let (latent, rates) = (&self.coordinates.latent, &self.coordinates.rates);
        self.map.evaluate_moving(points, latent, rates, &mut there);
        let mut stresses = vec![Matrix::ZERO; there.gradients.len()];
        self.body.material.kirchhoff_stresses(&there.gradients, &mut stresses);
        let volume_ratios: Vec<f64> = there.gradients.iter().map(Matrix::determinant).collect();
        let count = points.reference.len();
        let volume = self.body.volumes.iter().sum::<f64>() / count.max(1) as f64;
        let in_scene = |list: &[[f64; D]]| {
            let moved = list.iter().flat_map(|x| vector::add(x, &self.body.centroid));
            moved.collect::<Vec<f64>>()
        };
        let cauchy = stresses
            .iter()
            .zip(&volume_ratios)
            .map(|(stress, ratio)| *stress * (1.0 / ratio));
        let across = |(gradient, ratio): (&Matrix<D>, &f64)| {
            let stress = self.body.material.kirchhoff_stress_across(gradient);
            stress.map_or(0.0, |stress| stress / ratio)
        };
        let stresses_across = match D {
            3 => Vec::new(),
            _ => there.gradients.iter().zip(&volume_ratios).map(across).collect(),
        };
        Snapshot {
            dimension: D,
            time: self.time(),
            reference_positions: in_scene(&points.reference),
            positions: in_scene(&there.positions),
            velocities: there.velocities.as_flattened().to_vec(),
            stresses: cauchy.flat_map(|stress| stress.0.into_iter().flatten()).collect(),
            stresses_across,
            deformation_gradients: there
                .gradients
                .iter()
                .flat_map(|gradient| gradient.0.into_iter().flatten())
                .collect(),
            volume_ratios,
            masses: vec![self.body.density * volume; count],
            reference_volumes: vec![volume; count],
            bodies: vec![0; count],
            materials: vec![0; count],
            scalars: Vec::new(),
        }
    }
}
