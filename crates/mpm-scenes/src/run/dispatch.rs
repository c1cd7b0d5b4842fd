//! Basis and transfer, chosen once per run.

use mpm_core::{
    AffineFlip, Apic, Boundaries, Continuum, Flip, Masses, Mls, Moments, Mpm, MpmError, Particles, SplineGrid,
    StressUpdate, Transfer, VelocityFilter,
};
use mpm_kernels::{Cubic, Gimp, Linear, Quadratic, Spline};
use mpm_materials::Law;
use mpm_mesh::{Gradient, KernelWidth, MeshBasis, Outside, SampleWeight, SimplexMesh};
use mpm_tensor::Matrix;

use super::basis::SecondMoments;
use super::motion::Motion;
use crate::SceneFault;
use crate::background::Background;
use crate::law::{self, LawState, Laws};
use crate::loads::Loads;
use crate::placement;
use crate::plane;
use crate::population::Population;
use crate::scene::{
    BasisName, Discretisation, GradientName, GridTable, KernelName, MomentsName, Scene, StressUpdateName, TransferKind,
    WidthName,
};
use crate::shape::Bounds;

/// Share of FLIP unless a scene says otherwise, or names a rate.
const FLIP_SHARE: f64 = 0.99;

/// The parts of a body that do not depend on basis and transfer.
struct Parts<'a, const D: usize> {
    scene: &'a Scene,
    particles: Particles<D, LawState>,
    laws: Laws<D>,
    loads: Loads<D>,
    boundaries: Boundaries<D>,
}

/// A grid that is still to be made for a spline.
#[derive(Clone, Copy)]
struct Grid<const D: usize> {
    spacing: f64,
    room: Bounds<D>,
    /// Where particles may be.
    limits: Bounds<D>,
}

/// The body of a scene at t = 0.
///
/// # Errors
/// [`SceneFault::OutsideMesh`], what [`placement::check_barrier`] says, and [`SceneFault::Value`] for tables that [`Scene::read`] refuses.
pub(super) fn build<const D: usize>(
    scene: &Scene,
    population: &Population<D>,
    background: Background<D>,
    boundaries: Boundaries<D>,
) -> Result<Box<dyn Motion<D>>, SceneFault> {
    let loads = Loads::of(scene, population, &background)?;
    placement::check_barrier(scene, &background, population, &loads)?;
    let laws = laws(scene)?;
    let parts = Parts {
        scene,
        particles: particles(population, &laws)?,
        loads,
        laws,
        boundaries,
    };
    match (scene.discretisation()?, background) {
        (Discretisation::Grid(table), Background::Grid { spacing, room }) => {
            let limits = plane::limits(scene, &room, spacing)?;
            on_grid(table, parts, Grid { spacing, room, limits })
        }
        (Discretisation::Mesh(_), Background::Mesh { whole, .. }) => {
            let basis = mesh_basis(scene, &whole)?;
            placement::check_on_mesh(scene, basis.search(), population)?;
            on_basis(parts, basis)
        }
        _ => Err(SceneFault::missing("grid", "given unless there is a [mesh]")),
    }
}

fn on_grid<const D: usize>(
    table: &GridTable,
    parts: Parts<D>,
    grid: Grid<D>,
) -> Result<Box<dyn Motion<D>>, SceneFault> {
    match table.basis {
        BasisName::Linear => on_basis(parts, grid.of_spline(Linear)?),
        BasisName::Quadratic => on_basis(parts, grid.of_spline(Quadratic)?),
        BasisName::Cubic => on_basis(parts, grid.of_spline(Cubic)?),
        BasisName::Gimp => match parts.scene.bodies.first().map(|body| body.per_axis()) {
            Some(per_axis @ 1..=4) => with_share(parts, grid.of_spline(Gimp::new(per_axis))?),
            other => Err(SceneFault::value(
                "bodies.particles_per_axis",
                other.unwrap_or(0),
                "1 to 4 with grid.basis = \"gimp\"",
            )),
        },
    }
}

fn laws<const D: usize>(scene: &Scene) -> Result<Laws<D>, SceneFault> {
    let tables = scene.materials.iter();
    let laws = tables.map(|(name, table)| law::build(&format!("materials.{name}"), table));
    let laws = Laws::new(laws.collect::<Result<_, _>>()?);
    laws.ok_or_else(|| SceneFault::value("materials", [0; 0], "at least one material"))
}

/// At t = 0, with what the laws admit of F = λ 1: sand that begins apart is not under tension.
fn particles<const D: usize>(population: &Population<D>, laws: &Laws<D>) -> Result<Particles<D, LawState>, SceneFault> {
    let particles = Particles::in_order(
        population.positions.clone(),
        population.velocities.clone(),
        Masses::Each(population.masses.clone()),
        Vec::new(),
        (0..population.positions.len() as u32).collect(),
    );
    let states = population.materials.iter().map(|&law| LawState::virgin(law)).collect();
    let particles = particles.map_err(refused)?;
    let mut particles = particles.with_states(population.volumes.clone(), states);
    let each = population.stretches.iter().zip(&mut particles.states);
    particles.deformation_gradients = each
        .map(|(&stretch, state)| laws.advance(&(Matrix::IDENTITY * stretch), state))
        .collect();
    Ok(particles)
}

fn on_basis<const D: usize, B: SecondMoments<D> + 'static>(
    parts: Parts<D>,
    basis: B,
) -> Result<Box<dyn Motion<D>>, SceneFault> {
    match parts.scene.transfer.kind {
        TransferKind::Pic | TransferKind::Flip => with_share(parts, basis),
        TransferKind::AffineFlip => {
            let moments = match parts.scene.transfer.moments.unwrap_or_default() {
                MomentsName::Nodes => Moments::OfNodes,
                MomentsName::Increments => Moments::Increments,
            };
            let flip = share(parts.scene);
            with_transfer(parts, basis, AffineFlip { flip, moments })
        }
        TransferKind::Apic => with_transfer(parts, basis, Apic),
        TransferKind::Mls => with_transfer(parts, basis, Mls),
    }
}

/// FLIP with its share. PIC is FLIP without one: a step less to compile for every basis and dimension.
fn with_share<const D: usize, B: SecondMoments<D> + 'static>(
    parts: Parts<D>,
    basis: B,
) -> Result<Box<dyn Motion<D>>, SceneFault> {
    let transfer = share(parts.scene);
    with_transfer(parts, basis, transfer)
}

fn share(scene: &Scene) -> Flip {
    let share = match scene.transfer.kind {
        TransferKind::Pic => 0.0,
        _ => {
            let default = scene.transfer.pic_rate.map_or(FLIP_SHARE, |_| 1.0);
            scene.transfer.flip_share.unwrap_or(default)
        }
    };
    let pic_rate = match higher_order(scene) {
        Some(_) => 0.0, // the filter's
        None => scene.transfer.pic_rate.unwrap_or(0.0),
    };
    Flip { share, pic_rate }
}

/// Order and rate of a filter that turns velocities into those of XPIC; PIC itself is FLIP's affair.
fn higher_order(scene: &Scene) -> Option<(usize, f64)> {
    let order = scene.transfer.pic_order.filter(|&order| order > 1);
    order.zip(scene.transfer.pic_rate)
}

impl<const D: usize> Grid<D> {
    fn of_spline<S: Spline<W>, const W: usize>(self, kernel: S) -> Result<SplineGrid<S, W, D>, SceneFault> {
        let grid = SplineGrid::<S, W, D>::new(self.room.lower, self.spacing);
        grid.and_then(|grid| grid.with_limits(self.limits.lower, self.limits.upper))
            .map(|grid| grid.with_kernel(kernel))
            .map_err(refused)
    }
}

/// The basis of a scene on its mesh.
pub(super) fn mesh_basis<const D: usize>(scene: &Scene, mesh: &SimplexMesh<D>) -> Result<MeshBasis<D>, SceneFault> {
    let Discretisation::Mesh(table) = scene.discretisation()? else {
        return Err(SceneFault::missing("mesh", "given instead of a [grid]"));
    };
    let invalid = |error: mpm_mesh::MeshError| SceneFault::value("mesh", table, format!("valid: {error}"));
    let outside = match table.reach {
        0.0 => Outside::Refuse,
        reach => Outside::Extrapolate { reach },
    };
    let weight = match table.kernel {
        KernelName::Umls => SampleWeight::Continuous,
        KernelName::Smooth => SampleWeight::Smooth,
        KernelName::WithoutDiminishing => SampleWeight::DistanceAlone,
        KernelName::Hat => SampleWeight::CellAlone,
    };
    let gradient = match table.gradient {
        GradientName::Diffuse => Gradient::Diffuse,
        GradientName::Exact => Gradient::Exact,
    };
    let width = match table.width {
        WidthName::LongestEdge => KernelWidth::LongestEdge,
        WidthName::Local => KernelWidth::Local,
    };
    let basis = MeshBasis::new(mesh).map_err(invalid)?.with_kernel_width(width);
    let basis = basis
        .with_gradient(gradient)
        .with_outside(outside)
        .with_sample_weight(weight);
    Ok(basis.with_positive_weights(table.positive_weights))
}

fn with_transfer<const D: usize, B: SecondMoments<D> + 'static, T: Transfer<D> + 'static>(
    parts: Parts<D>,
    basis: B,
    transfer: T,
) -> Result<Box<dyn Motion<D>>, SceneFault> {
    let scene = parts.scene;
    let medium = Continuum { law: parts.laws };
    let mut mpm = Mpm::new(parts.particles, basis, transfer, medium, parts.loads).with_boundary(parts.boundaries);
    mpm.volume_averaging = scene.volume_averaging;
    if let Some((order, rate)) = higher_order(scene) {
        mpm.velocity_filter = Some(VelocityFilter::new(order, rate).map_err(refused)?);
    }
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
