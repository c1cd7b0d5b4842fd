//! From the tables of a scene to its forces.

use mpm_core::Amplitude;

use super::{Barrier, DirectLoad, Loads};
use crate::background::Background;
use crate::population::Population;
use crate::scene::{BarrierAgainst, BarrierIntegration, BarrierTable, LoadTable, Scene, ShapeTable, amplitude};
use crate::shape::{MeshOutside, Shape};
use crate::values::{vector, within as within_range};
use crate::{SceneFault, reference, shape};

impl<const D: usize> Loads<D> {
    /// The forces of a scene on its particles.
    ///
    /// # Errors
    /// [`SceneFault::Value`] for a load whose region holds no particle, and for tables that [`Scene::read`] refuses.
    pub(crate) fn of(scene: &Scene, particles: &Population<D>, background: &Background<D>) -> Result<Self, SceneFault> {
        let mut loads = Self {
            masses: particles.masses.clone(),
            ..Self::default()
        };
        if !scene.gravity.is_empty() {
            loads.gravity = Some(vector("gravity", &scene.gravity)?);
            loads.gravity_amplitude = Amplitude::ramp(scene.gravity_ramp);
        }
        for (index, table) in scene.loads.iter().enumerate() {
            let field = |key: &str| format!("loads[{index}].{key}");
            if let Some(part) = table.part() {
                let (key, force) = part.force;
                let force = vector::<D>(&field(key), force)?;
                let chosen = within(scene, particles, &field("region"), part.region, part.body)?;
                let mass: f64 = chosen.iter().map(|&p| particles.masses[p]).sum();
                let mut accelerations = vec![[0.0; D]; particles.positions.len()];
                for p in chosen {
                    accelerations[p] = match table {
                        LoadTable::Traction { thickness, .. } => {
                            let scale = particles.volumes[p] / (thickness * particles.masses[p]);
                            force.map(|c| scale * c)
                        }
                        _ => force.map(|c| c / mass),
                    };
                }
                loads.direct.push(DirectLoad {
                    accelerations,
                    amplitude: amplitude(&field, part.ramp, part.amplitude)?,
                });
            }
            if let LoadTable::Manufactured { solution } = table {
                loads.manufactured.push(reference::manufactured(solution, scene)?);
                loads.reference_positions.clone_from(&particles.positions);
            }
        }
        if let Some(table) = &scene.barrier {
            loads.barrier = Some(barrier(table, background)?);
            let power = (D as f64 - 1.0) / D as f64;
            loads.areas = particles.volumes.iter().map(|volume| volume.powf(power)).collect();
        }
        Ok(loads)
    }
}

/// The particles that a region of the reference configuration holds, of one body or of all.
///
/// # Errors
/// [`SceneFault::Value`] if there are none.
pub(crate) fn within<const D: usize>(
    scene: &Scene,
    particles: &Population<D>,
    field: &str,
    region: &ShapeTable,
    body: Option<&String>,
) -> Result<Vec<usize>, SceneFault> {
    let shape = shape::build::<D>(field, region)?;
    let body = body.and_then(|name| scene.bodies.iter().position(|body| body.name == *name));
    let of_body = |p: usize| body.is_none_or(|body| particles.bodies[p] as usize == body);
    let all = particles.positions.iter().enumerate();
    let chosen = all
        .filter(|&(p, x)| of_body(p) && shape.distance(x) <= 0.0)
        .map(|(p, _)| p);
    let chosen: Vec<usize> = chosen.collect();
    within_range(field, region, !chosen.is_empty(), "a region with particles in it").map(|_| chosen)
}

/// With a Courant number of at most 1 no particle goes farther than one spacing in a step.
fn barrier<const D: usize>(table: &BarrierTable, background: &Background<D>) -> Result<Barrier<D>, SceneFault> {
    let spacing = background.spacing();
    let shapes = table.shapes.iter().enumerate();
    let shapes = shapes.map(|(index, table)| shape::build(&format!("barrier.shapes[{index}]"), table));
    let mut shapes: Vec<Box<dyn Shape<D>>> = shapes.collect::<Result<_, _>>()?;
    match (table.against, background) {
        (Some(BarrierAgainst::Mesh), Background::Mesh { inner, .. }) => {
            shapes.push(Box::new(MeshOutside::new(inner, table.gap + spacing)));
        }
        (Some(against), Background::Grid { .. }) => {
            let expected = "left out unless there is a [mesh]";
            return Err(SceneFault::value("barrier.against", against, expected));
        }
        (None, _) => {}
    }
    Ok(Barrier {
        shapes,
        stiffness: table.stiffness,
        gap: table.gap,
        friction: table.friction,
        friction_speed: table.friction_speed,
        reach: spacing,
        implicit: table.integration == BarrierIntegration::Implicit,
    })
}
