//! The body of a scene as the reduced dynamics see it.

use mpm_core::{ON_A_SURFACE, PrescribedVelocity, VolumeAveraging};
use mpm_kernels::UniformGrid;
use mpm_materials::{ElasticModuli, FixedCorotated, Hencky, Material, NeoHookean, ParameterError};
use mpm_scenes::scene::{BasisName, MaterialTable, SolidTable, StressUpdateName, TransferKind};
use mpm_scenes::shape::{self, Shape};
use mpm_scenes::{HeldRegion, Kinematics, Population, Scene, SceneError};
use mpm_tensor::vector;

use super::OnlineError;
use crate::full_order::{body_of, steps_per_frame};

/// A body with everything that pulls at it: the same points, grid, kernel (quadratic), transfer (PIC), Δt and prescribed motions as in the full-order run
/// of its scene. Positions are relative to the centroid at rest.
pub struct ReducedBody<const D: usize> {
    /// X_p.
    pub reference: Vec<[f64; D]>,
    /// The centroid at rest in the scene's coordinates.
    pub centroid: [f64; D],
    /// V⁰_p.
    pub volumes: Vec<f64>,
    /// ρ₀.
    pub density: f64,
    /// The law.
    pub material: Box<dyn Material<D>>,
    /// Acceleration of gravity.
    pub gravity: [f64; D],
    /// Prescribed motions, in the scene's coordinates.
    pub kinematics: Kinematics<D>,
    /// The background grid.
    pub grid: UniformGrid<D>,
    /// Δt.
    pub time_step: f64,
    /// Steps from one frame to the next.
    pub steps_per_frame: u64,
    /// Regions whose nodes have a prescribed velocity, in the scene's coordinates.
    pub held: Vec<HeldRegion<D>>,
    /// Where the body is at rest, in the scene's coordinates.
    pub shapes: Vec<Box<dyn Shape<D>>>,
}

impl<const D: usize> ReducedBody<D> {
    /// The body of a scene.
    ///
    /// # Errors
    /// [`OnlineError::Unsupported`] for what the reduced dynamics do not have: other bases, transfers, laws and orders of the stress update, walls, obstacles, loads, a ramp of gravity, several
    /// materials, a Δt that is not given or does not divide the frame; what [`body_of`] says.
    pub fn of(scene: &Scene) -> Result<Self, OnlineError> {
        let refused = |fault| scene.error(fault);
        let body = body_of::<D>(scene, &[])?;
        let population = Population::<D>::fill(scene).map_err(refused)?;
        let kinematics = Kinematics::of(scene, &population).map_err(refused)?;
        let found: Supported<'_, D> = supported(scene)?;
        let origin: [f64; D] = std::array::from_fn(|a| found.lower.get(a).copied().unwrap_or(0.0));
        Ok(Self {
            density: body.density,
            volumes: population.volumes,
            material: found.material,
            gravity: std::array::from_fn(|a| scene.gravity.get(a).copied().unwrap_or(0.0)),
            kinematics,
            grid: UniformGrid::new(vector::subtract(&origin, &body.centroid), found.grid),
            time_step: scene.output.interval / found.steps_per_frame as f64,
            steps_per_frame: found.steps_per_frame,
            held: HeldRegion::of(scene).map_err(refused)?,
            shapes: shapes_of(scene)?,
            reference: body.reference,
            centroid: body.centroid,
        })
    }

    /// The same body, with positions relative to another origin: that of a map which was trained on other points of it.
    pub fn about(mut self, centroid: &[f64; D]) -> Self {
        let shift = vector::subtract(&self.centroid, centroid);
        for x in &mut self.reference {
            *x = vector::add(x, &shift);
        }
        self.grid = UniformGrid::new(vector::add(self.grid.origin(), &shift), self.grid.spacing());
        self.centroid = *centroid;
        self
    }

    /// The same body with time steps `factor` times as long; `None` unless they divide a frame. What is left out of a body's motion often allows longer steps than the grid's waves do.
    pub fn with_longer_steps(mut self, factor: u64) -> Option<Self> {
        if factor == 0 || !self.steps_per_frame.is_multiple_of(factor) {
            return None;
        }
        self.time_step *= factor as f64;
        self.steps_per_frame /= factor;
        Some(self)
    }

    /// X_p of the points with these numbers; numbers that there are not are left out.
    pub(super) fn reference_of(&self, numbers: &[u32]) -> Vec<[f64; D]> {
        let places = numbers.iter().filter_map(|&p| self.reference.get(p as usize));
        places.copied().collect()
    }

    /// Position and velocity of a material point at a time; `None` where they are not prescribed.
    pub fn prescribed(&self, point: usize, time: f64) -> Option<([f64; D], [f64; D])> {
        let reference = vector::add(self.reference.get(point)?, &self.centroid);
        let (position, velocity) = self.kinematics.prescribed(point, &reference, time)?;
        Some((vector::subtract(&position, &self.centroid), velocity))
    }

    /// The velocity of a node at x in the step from `time` on; `None` where it is not prescribed. Where regions overlap, the last one's.
    pub fn held_velocity(&self, x: &[f64; D], time: f64) -> Option<[f64; D]> {
        let x = vector::add(x, &self.centroid);
        let close = ON_A_SURFACE * self.grid.spacing();
        let mut regions = self.held.iter().rev();
        regions.find_map(|region| region.velocity(&x, close, time, self.time_step))
    }

    /// The distance of X from the surface of the body at rest, negative inside; at most that, of combined shapes.
    pub fn distance(&self, reference: &[f64; D]) -> f64 {
        let x = vector::add(reference, &self.centroid);
        let distances = self.shapes.iter().map(|shape| shape.distance(&x));
        distances.fold(f64::INFINITY, f64::min)
    }
}

/// Where the bodies of a scene are at rest.
///
/// # Errors
/// What the scene's own reader says.
pub(crate) fn shapes_of<const D: usize>(scene: &Scene) -> Result<Vec<Box<dyn Shape<D>>>, SceneError> {
    let shapes = scene.bodies.iter();
    let shapes = shapes.map(|body| shape::build("bodies.shape", &body.shape));
    shapes.collect::<Result<_, _>>().map_err(|fault| scene.error(fault))
}

fn unsupported<T>(scene: &Scene, field: &'static str, expected: &'static str) -> Result<T, OnlineError> {
    Err(OnlineError::Unsupported {
        file: scene.file.display().to_string(),
        field,
        expected,
    })
}

/// What a scene that can be reduced has.
struct Supported<'a, const D: usize> {
    /// The spacing of its grid.
    grid: f64,
    /// The first node of it.
    lower: &'a [f64],
    material: Box<dyn Material<D>>,
    steps_per_frame: u64,
}

fn supported<const D: usize>(scene: &Scene) -> Result<Supported<'_, D>, OnlineError> {
    let (Some(grid), Some(domain)) = (&scene.grid, &scene.domain) else {
        return unsupported(scene, "mesh", "left out: a [grid] is needed");
    };
    let turned = scene
        .bodies
        .iter()
        .any(|body| body.rotation.is_some() || body.deformation.is_some());
    let moving = scene.bodies.iter().any(|body| body.velocity.is_some());
    let surroundings = [scene.walls.len(), scene.obstacles.len(), scene.loads.len()];
    let rules = [
        (grid.basis == BasisName::Quadratic, "grid.basis", "\"quadratic\""),
        (scene.transfer.kind == TransferKind::Pic, "transfer.kind", "\"pic\""),
        (
            surroundings == [0; 3] && scene.barrier.is_none(),
            "walls, obstacles, loads, barrier",
            "left out",
        ),
        (
            scene.volume_averaging == VolumeAveraging::Off,
            "volume_averaging",
            "false",
        ),
        (scene.gravity_ramp == 0.0, "gravity_ramp", "0"),
        (scene.time.damping == 0.0, "time.damping", "0"),
        (
            scene.time.stress_update == StressUpdateName::Last,
            "time.stress_update",
            "\"last\"",
        ),
        (!turned, "bodies.rotation, bodies.deformation", "left out"),
        (!moving, "bodies.velocity", "left out"),
    ];
    for (kept, field, expected) in rules {
        if !kept {
            return unsupported(scene, field, expected);
        }
    }
    let Some(steps_per_frame) = steps_per_frame(scene) else {
        return unsupported(scene, "time.step", "given, and a whole part of output.interval");
    };
    let [table] = scene.materials.values().collect::<Vec<_>>()[..] else {
        return unsupported(scene, "materials", "a single one");
    };
    Ok(Supported {
        grid: grid.spacing,
        lower: &domain.lower,
        material: material(scene, table)?,
        steps_per_frame,
    })
}

/// Steps of a frame, unless a scene is one that the reduced dynamics do not have; no body is filled for it.
///
/// # Errors
/// [`OnlineError::Unsupported`], as [`ReducedBody::of`].
pub(crate) fn check_supported<const D: usize>(scene: &Scene) -> Result<u64, OnlineError> {
    Ok(supported::<D>(scene)?.steps_per_frame)
}

fn material<const D: usize>(scene: &Scene, table: &MaterialTable) -> Result<Box<dyn Material<D>>, OnlineError> {
    let moduli = |solid: &SolidTable| {
        let moduli: Result<_, ParameterError> = ElasticModuli::new(solid.young_modulus, solid.poisson_ratio);
        moduli.or_else(|_| unsupported(scene, "materials", "one whose moduli are in range"))
    };
    Ok(match table {
        MaterialTable::FixedCorotated(solid) => Box::new(FixedCorotated::new(moduli(solid)?)),
        MaterialTable::NeoHookean(solid) => Box::new(NeoHookean::new(moduli(solid)?)),
        MaterialTable::Hencky(solid) => Box::new(Hencky::new(moduli(solid)?)),
        _ => {
            let expected = "\"fixed-corotated\", \"neo-hookean\" or \"hencky\"";
            return unsupported(scene, "materials.law", expected);
        }
    })
}
