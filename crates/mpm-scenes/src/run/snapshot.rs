//! The particles of a body as a snapshot.

use mpm_materials::Law;
use mpm_tensor::Matrix;

use super::motion::Motion;
use crate::Snapshot;
use crate::population::Population;

/// All particles of a body in the order of creation.
pub(super) fn snapshot<const D: usize>(motion: &dyn Motion<D>, start: &Population<D>) -> Snapshot {
    let (particles, laws) = (motion.particles(), motion.laws());
    let flat = |field: &[[f64; D]]| particles.in_creation_order(field).as_flattened().to_vec();
    let tensors = |field: &[Matrix<D>]| {
        let sorted = particles.in_creation_order(field);
        sorted
            .iter()
            .flat_map(|matrix| matrix.0.into_iter().flatten())
            .collect::<Vec<f64>>()
    };
    let ratios: Vec<f64> = pairs(motion)
        .map(|(deformation, state)| laws.volume_ratio(deformation, state))
        .collect();
    let stresses: Vec<Matrix<D>> = pairs(motion)
        .zip(&ratios)
        .enumerate()
        .map(|(p, ((deformation, state), ratio))| {
            let rate = particles.velocity_gradients.get(p).unwrap_or(&Matrix::ZERO);
            laws.kirchhoff_stress(deformation, state, rate) * (1.0 / ratio)
        })
        .collect();
    let across = |(deformation, state), ratio: &f64| {
        let stress = laws.kirchhoff_stress_across(deformation, state);
        stress.map_or(0.0, |stress| stress / ratio)
    };
    let stresses_across: Vec<f64> = match D {
        3 => Vec::new(),
        _ => pairs(motion)
            .zip(&ratios)
            .map(|(pair, ratio)| across(pair, ratio))
            .collect(),
    };
    let states = particles.in_creation_order(&particles.states);
    let variable = |name: &'static str| {
        let values: Vec<Option<f64>> = states.iter().map(|state| laws.internal_variable(state, name)).collect();
        let is_there = values.iter().any(Option::is_some);
        is_there.then(|| {
            (
                name.to_owned(),
                values.into_iter().map(Option::unwrap_or_default).collect(),
            )
        })
    };
    let mut scalars: Vec<_> = laws.internal_variables().into_iter().filter_map(variable).collect();
    if let Some(forces) = motion.loads().contact_forces(particles) {
        scalars.push(("contact_force".to_owned(), particles.in_creation_order(&forces)));
    }
    Snapshot {
        dimension: D,
        time: motion.time(),
        reference_positions: start.positions.as_flattened().to_vec(),
        positions: flat(&particles.positions),
        velocities: flat(&particles.velocities),
        stresses: tensors(&stresses),
        stresses_across: particles.in_creation_order(&stresses_across),
        deformation_gradients: tensors(&particles.deformation_gradients),
        volume_ratios: particles.in_creation_order(&ratios),
        masses: start.masses.clone(),
        reference_volumes: start.volumes.clone(),
        bodies: start.bodies.clone(),
        materials: start.materials.clone(),
        scalars,
    }
}

/// F and state of every particle in the present order.
fn pairs<const D: usize>(motion: &dyn Motion<D>) -> impl Iterator<Item = (&Matrix<D>, &crate::law::LawState)> {
    let particles = motion.particles();
    particles.deformation_gradients.iter().zip(&particles.states)
}
