//! Whether what a scene puts around its bodies can act on them: a wall, an obstacle or a region that nothing reaches is a slip of the pen, and a body that begins inside of something rigid as well.

mod reach;

use mpm_core::ON_A_SURFACE;
use mpm_mesh::CellSearch;
use mpm_tensor::vector as algebra;

use crate::background::Background;
use crate::loads::Loads;
use crate::plane;
use crate::population::Population;
use crate::scene::{ObstacleTable, Scene};
use crate::shape::{self, Bounds, Shape};
use crate::values::{vector, within};
use crate::{HeldRegion, SceneFault};

use reach::Nodes;

/// Checks walls, obstacles, held regions and the barrier of a scene, whose bodies have been filled and whose forces have been made.
///
/// # Errors
/// [`SceneFault::Value`] for what acts on nothing, [`SceneFault::InsideRigid`] for a body that begins inside an obstacle or the barrier, [`SceneFault::HeldTwice`].
pub(crate) fn check<const D: usize>(
    scene: &Scene,
    background: &Background<D>,
    particles: &Population<D>,
) -> Result<(), SceneFault> {
    let nodes = Nodes::of(scene, background);
    check_walls(scene, background, &nodes)?;
    for (index, table) in scene.obstacles.iter().enumerate() {
        check_obstacle(scene, index, table, &nodes, particles)?;
    }
    let held = HeldRegion::<D>::of(scene)?;
    check_held_once(&held, &nodes, particles)?;
    for (index, region) in held.iter().enumerate() {
        let (field, table) = (format!("held[{index}].shape"), &scene.held[index].shape);
        let motion = &region.motion;
        let goes = algebra::norm(&motion.velocity) > 0.0;
        let reached = if scene.held[index].rotation.is_some() {
            true
        } else if goes {
            let time = region.until.min(scene.time.end);
            nodes.meet(&swept(&*region.shape, &motion.velocity, time))
        } else {
            nodes.come_as_near(&*region.shape, ON_A_SURFACE * nodes.spacing())
        };
        within(&field, table, reached, &held_somewhere(&nodes))?;
    }
    Ok(())
}

/// Checks whether all particles are in a cell of the mesh, or within its `reach`: a step would find none for them.
///
/// # Errors
/// [`SceneFault::OutsideMesh`] with the first that is not.
pub(crate) fn check_on_mesh<const D: usize>(
    scene: &Scene,
    search: &CellSearch<D>,
    particles: &Population<D>,
) -> Result<(), SceneFault> {
    let reach = scene.mesh.as_ref().map_or(0.0, |mesh| mesh.reach);
    let mut near = None;
    for (particle, position) in particles.positions.iter().enumerate() {
        if let Some(located) = search.locate(position, near) {
            near = Some(located.cell);
        } else if !(reach > 0.0 && search.nearest(position, reach).is_some()) {
            return Err(SceneFault::OutsideMesh {
                body: particles.body(scene, particle).unwrap_or_default(),
                particle,
                position: position.to_vec(),
                reach,
            });
        }
    }
    Ok(())
}

/// Checks the barrier, which the forces of the scene have.
///
/// # Errors
/// As [`check`].
pub(crate) fn check_barrier<const D: usize>(
    scene: &Scene,
    background: &Background<D>,
    particles: &Population<D>,
    loads: &Loads<D>,
) -> Result<(), SceneFault> {
    let (Some(table), Some(barrier)) = (&scene.barrier, &loads.barrier) else {
        return Ok(());
    };
    let nodes = Nodes::of(scene, background);
    for (index, shape) in barrier.shapes.iter().enumerate() {
        let Some(own) = table.shapes.get(index) else {
            outside(scene, "barrier.against", &**shape, 0.0, particles)?;
            continue;
        };
        let field = format!("barrier.shapes[{index}]");
        outside(scene, &field, &**shape, 0.0, particles)?;
        // A particle in the gap has a node within a cell.
        let reached = nodes.come_as_near(&**shape, table.gap + nodes.cell());
        let expected = format!(
            "a shape whose gap reaches into {}: beyond, it acts on nothing",
            nodes.described()
        );
        within(&field, own, reached, &expected)?;
    }
    Ok(())
}

/// A wall that no node is near is felt by nobody, and one whose material leaves it by more than a cell as well: planes stay where they are.
fn check_walls<const D: usize>(scene: &Scene, background: &Background<D>, nodes: &Nodes<D>) -> Result<(), SceneFault> {
    for (index, table) in scene.walls.iter().enumerate() {
        let (point, normal) = plane::build(background.room(), index, table)?;
        // The corner of the room that is farthest behind the plane.
        let room = nodes.room();
        let corner = std::array::from_fn(|a| if normal[a] > 0.0 { room.lower[a] } else { room.upper[a] });
        let behind = algebra::dot(&algebra::subtract(&corner, &point), &normal);
        let reached = behind <= ON_A_SURFACE * nodes.spacing();
        let expected = format!("in reach of {}: beyond, the wall acts on nothing", nodes.described());
        match table.axis.and_then(|axis| point.get(axis.index())) {
            Some(position) => within(&format!("walls[{index}].position"), *position, reached, &expected).map(drop)?,
            None => within(&format!("walls[{index}].point"), point.to_vec(), reached, &expected).map(drop)?,
        }
        if let Some(list) = &table.velocity {
            let field = format!("walls[{index}].velocity");
            let way = algebra::dot(&vector::<D>(&field, list)?, &normal).abs() * scene.time.end;
            let expected = "along the wall, or across it by a cell at most until time.end: the wall stays where it is, [[obstacles]] and [[held]] move";
            within(&field, list, way <= nodes.spacing(), expected).map(drop)?;
        }
    }
    Ok(())
}

fn check_obstacle<const D: usize>(
    scene: &Scene,
    index: usize,
    table: &ObstacleTable,
    nodes: &Nodes<D>,
    particles: &Population<D>,
) -> Result<(), SceneFault> {
    let field = format!("obstacles[{index}].shape");
    let shape = shape::build::<D>(&field, &table.shape)?;
    outside(scene, &field, &*shape, ON_A_SURFACE * nodes.spacing(), particles)?;
    let velocity = match &table.velocity {
        Some(list) if table.moves => vector(&format!("obstacles[{index}].velocity"), list)?,
        _ => [0.0; D],
    };
    let reached = if velocity == [0.0; D] {
        nodes.come_as_near(&*shape, ON_A_SURFACE * nodes.spacing())
    } else {
        nodes.meet(&swept(&*shape, &velocity, scene.time.end))
    };
    within(&field, &table.shape, reached, &held_somewhere(nodes)).map(drop)
}

/// Particles have no nodes farther away than this many cells.
const REACH: f64 = 2.0;

/// Whether no two held regions that move in two ways have nodes near a body in common at t = 0: one of them would say nothing.
fn check_held_once<const D: usize>(
    held: &[HeldRegion<D>],
    nodes: &Nodes<D>,
    particles: &Population<D>,
) -> Result<(), SceneFault> {
    for (second, region) in held.iter().enumerate() {
        let others = held[..second].iter().enumerate();
        for (first, other) in others.filter(|(_, other)| other.motion != region.motion) {
            let in_both = |x: &[f64; D]| region.shape.distance(x).max(other.shape.distance(x));
            let near = |x: &[f64; D]| in_both(x) <= REACH * nodes.cell();
            let common = || nodes.found(&in_both, ON_A_SURFACE * nodes.spacing());
            if particles.positions.iter().any(near) && common() == Some(true) {
                return Err(SceneFault::HeldTwice {
                    first,
                    second,
                    nodes: nodes.described(),
                });
            }
        }
    }
    Ok(())
}

/// What is asked of a shape that acts on the nodes in it.
fn held_somewhere<const D: usize>(nodes: &Nodes<D>) -> String {
    format!(
        "a shape that holds a node of {}, or comes by one: without, it acts on nothing",
        nodes.described()
    )
}

/// The box around a shape on its way.
fn swept<const D: usize>(shape: &dyn Shape<D>, velocity: &[f64; D], time: f64) -> Bounds<D> {
    let start = shape.bounds();
    let end = Bounds {
        lower: algebra::add_scaled(&start.lower, time, velocity),
        upper: algebra::add_scaled(&start.upper, time, velocity),
    };
    start.hull(&end)
}

/// Whether no particle is at the surface of something rigid or deeper in it than a tolerance.
fn outside<const D: usize>(
    scene: &Scene,
    table: &str,
    shape: &dyn Shape<D>,
    tolerance: f64,
    particles: &Population<D>,
) -> Result<(), SceneFault> {
    for (particle, position) in particles.positions.iter().enumerate() {
        let Some((distance, _)) = shape.closer_than(position, f64::MIN_POSITIVE) else {
            continue;
        };
        if tolerance > 0.0 && distance > -tolerance {
            continue;
        }
        return Err(SceneFault::InsideRigid {
            body: particles.body(scene, particle).unwrap_or_default(),
            particle,
            position: position.to_vec(),
            table: table.to_owned(),
            depth: -distance,
        });
    }
    Ok(())
}
