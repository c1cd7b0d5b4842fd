//! Basis and transfer, chosen once per run.

use mpm_core::{
    Apic, Boundaries, Continuum, Flip, Masses, Mls, Mpm, MpmError, Particles, SplineGrid, StressUpdate, Transfer,
};
use mpm_kernels::{Cubic, Gimp, Linear, Quadratic, Spline};

use super::motion::Motion;
use crate::SceneFault;
use crate::law::{self, LawState, Laws};
use crate::loads::Loads;
use crate::population::{Population, domain};
use crate::scene::{BasisName, Scene, StressUpdateName, TransferKind};

/// Share of FLIP unless a scene says otherwise.
const FLIP_SHARE: f64 = 0.99;

/// The parts of a body that do not depend on basis and transfer.
struct Parts<'a, const D: usize> {
    scene: &'a Scene,
    particles: Particles<D, LawState>,
    laws: Laws,
    loads: Loads<D>,
    boundaries: Boundaries<D>,
}

/// The body of a scene at t = 0.
///
/// # Errors
/// [`SceneFault::Value`] for tables that [`Scene::read`] refuses.
pub(super) fn build<const D: usize>(
    scene: &Scene,
    population: &Population<D>,
    boundaries: Boundaries<D>,
) -> Result<Box<dyn Motion<D>>, SceneFault> {
    let laws = laws(scene)?;
    let parts = Parts {
        scene,
        particles: particles(population, &laws)?,
        loads: Loads::of(scene, population)?,
        laws,
        boundaries,
    };
    match scene.grid.basis {
        BasisName::Linear => with_spline::<Linear, 2, D>(parts),
        BasisName::Quadratic => with_spline::<Quadratic, 3, D>(parts),
        BasisName::Cubic => with_spline::<Cubic, 4, D>(parts),
        BasisName::Gimp => match scene.bodies.first().map(|body| body.particles_per_axis) {
            Some(1) => with_share::<Gimp<1>, 3, D>(parts),
            Some(2) => with_share::<Gimp<2>, 3, D>(parts),
            Some(3) => with_share::<Gimp<3>, 3, D>(parts),
            Some(4) => with_share::<Gimp<4>, 3, D>(parts),
            other => Err(SceneFault::value(
                "bodies.particles_per_axis",
                other.unwrap_or(0),
                "1 to 4 with grid.basis = \"gimp\"",
            )),
        },
    }
}

fn laws(scene: &Scene) -> Result<Laws, SceneFault> {
    let tables = scene.materials.iter();
    let laws = tables.map(|(name, table)| law::build(&format!("materials.{name}"), table));
    let laws = Laws::new(laws.collect::<Result<_, _>>()?);
    laws.ok_or_else(|| SceneFault::value("materials", [0; 0], "at least one material"))
}

fn particles<const D: usize>(population: &Population<D>, laws: &Laws) -> Result<Particles<D, LawState>, SceneFault> {
    let particles = Particles::in_order(
        population.positions.clone(),
        population.velocities.clone(),
        Masses::Each(population.masses.clone()),
        Vec::new(),
        (0..population.positions.len() as u32).collect(),
    );
    let states = population.materials.iter().map(|&law| laws.virgin(law)).collect();
    Ok(particles
        .map_err(refused)?
        .with_states(population.volumes.clone(), states))
}

fn with_spline<S: Spline<W> + Sync + 'static, const W: usize, const D: usize>(
    parts: Parts<D>,
) -> Result<Box<dyn Motion<D>>, SceneFault> {
    match parts.scene.transfer.kind {
        TransferKind::Pic | TransferKind::Flip => with_share::<S, W, D>(parts),
        TransferKind::Apic => with_transfer::<S, W, D, _>(parts, Apic),
        TransferKind::Mls => with_transfer::<S, W, D, _>(parts, Mls),
    }
}

/// FLIP with its share. PIC is FLIP without one: a step less to compile for every basis and dimension.
fn with_share<S: Spline<W> + Sync + 'static, const W: usize, const D: usize>(
    parts: Parts<D>,
) -> Result<Box<dyn Motion<D>>, SceneFault> {
    let transfer = parts.scene.transfer;
    let share = match transfer.kind {
        TransferKind::Pic => 0.0,
        _ => transfer.flip_share.unwrap_or(FLIP_SHARE),
    };
    with_transfer::<S, W, D, _>(parts, Flip { share })
}

fn with_transfer<S: Spline<W> + Sync + 'static, const W: usize, const D: usize, T: Transfer<D> + 'static>(
    parts: Parts<D>,
    transfer: T,
) -> Result<Box<dyn Motion<D>>, SceneFault> {
    let scene = parts.scene;
    let room = domain::<D>(scene)?;
    let grid = SplineGrid::<S, W, D>::new(room.lower, scene.grid.spacing);
    let grid = grid
        .and_then(|grid| grid.with_limits(room.lower, room.upper))
        .map_err(refused)?;
    let medium = Continuum { law: parts.laws };
    let mut mpm = Mpm::new(parts.particles, grid, transfer, medium, parts.loads).with_boundary(parts.boundaries);
    mpm.volume_averaging = scene.volume_averaging;
    mpm.stress_update = match scene.time.stress_update {
        StressUpdateName::First => StressUpdate::First,
        StressUpdateName::Last => StressUpdate::Last,
        StressUpdateName::ModifiedLast => StressUpdate::ModifiedLast,
    };
    Ok(Box::new(mpm))
}

/// What the mechanics say of a parameter that a scene gave.
fn refused(error: MpmError) -> SceneFault {
    match error {
        MpmError::InvalidParameter { field, value, expected } => SceneFault::value(field, value, expected),
        other => SceneFault::value("bodies", other.to_string(), "particles that the grid can hold"),
    }
}
