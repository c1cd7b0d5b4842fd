//! Walls, obstacles and held regions of a scene as boundaries of the step.

use std::sync::Arc;

use mpm_core::{Boundaries, Contact, Obstacle, Plane, PrescribedVelocity, SignedDistance};
use mpm_tensor::vector as algebra;

use super::tagged::{self, Tagged};
use crate::background::Background;
use crate::population::Population;
use crate::scene::{self, Scene, WallCondition};
use crate::shape::{self, Bounds, Shape};
use crate::values::vector;
use crate::{HeldRegion, SceneFault, plane};

/// A shape that has been moved from where the scene puts it.
struct Placed<const D: usize> {
    shape: Arc<dyn Shape<D>>,
    offset: [f64; D],
}

impl<const D: usize> SignedDistance<D> for Placed<D> {
    fn distance(&self, x: &[f64; D]) -> f64 {
        self.shape.distance(&algebra::subtract(x, &self.offset))
    }

    fn normal(&self, x: &[f64; D]) -> [f64; D] {
        self.shape.normal(&algebra::subtract(x, &self.offset))
    }
}

/// What moves by itself.
pub(super) struct Movers<const D: usize> {
    /// Obstacles: their number among the obstacles and their shape at t = 0.
    obstacles: Vec<(usize, Arc<dyn Shape<D>>)>,
    /// The largest speeds of obstacles and held regions, and until when they have them.
    speeds: Vec<(f64, f64)>,
}

impl<const D: usize> Movers<D> {
    /// The largest speed at this time of a surface that may be on its way to a body.
    pub fn largest_speed(&self, time: f64) -> f64 {
        let still = self.speeds.iter().filter(|(_, until)| time < *until);
        still.fold(0.0, |largest, (speed, _)| speed.max(largest))
    }

    /// Puts every moving obstacle where it is at this time.
    pub fn place(&self, boundaries: &mut Boundaries<D>, time: f64) {
        for (number, shape) in &self.obstacles {
            if let Some(obstacle) = boundaries.obstacles.get_mut(*number) {
                obstacle.shape = Box::new(Placed {
                    shape: Arc::clone(shape),
                    offset: algebra::scale(&obstacle.velocity, time),
                });
            }
        }
    }
}

/// The boundaries of a scene.
///
/// # Errors
/// [`SceneFault::Value`] for tables that [`Scene::read`] refuses.
pub(super) fn build<const D: usize>(
    scene: &Scene,
    background: &Background<D>,
    population: &Population<D>,
) -> Result<(Boundaries<D>, Movers<D>), SceneFault> {
    plane::check_alike(scene, Some(background.room()))?;
    let walls = scene
        .walls
        .iter()
        .enumerate()
        .map(|(index, table)| wall(background.room(), index, table));
    let (mut obstacles, mut moving, mut speeds) = (Vec::new(), Vec::new(), Vec::new());
    for (index, table) in scene.obstacles.iter().enumerate() {
        let field = format!("obstacles[{index}]");
        let shape: Arc<dyn Shape<D>> = Arc::from(shape::build::<D>(&format!("{field}.shape"), &table.shape)?);
        let velocity = velocity(&format!("{field}.velocity"), table.velocity.as_ref())?;
        if table.moves && velocity != [0.0; D] {
            moving.push((obstacles.len(), Arc::clone(&shape)));
            speeds.push((algebra::norm(&velocity), f64::INFINITY));
        }
        let contact = match table.contact {
            scene::Contact::Stick => Contact::Stick,
            scene::Contact::Slip => Contact::Slip,
            scene::Contact::Separate => Contact::Separate {
                friction: table.friction.unwrap_or(0.0),
            },
        };
        obstacles.push(obstacle(shape, contact, velocity));
    }
    let Tagged {
        surfaces,
        obstacles: tagged,
        forces,
    } = tagged::build(scene, background, population)?;
    obstacles.extend(tagged);
    let held = HeldRegion::<D>::of(scene)?;
    speeds.extend(held.iter().map(|region| (region.largest_speed(), region.until)));
    let held = held.into_iter();
    let prescribed = held.map(|region| Box::new(region) as Box<dyn PrescribedVelocity<D>>);
    let boundaries = Boundaries::new(walls.collect::<Result<_, _>>()?, obstacles).with_prescribed(prescribed.collect());
    let boundaries = boundaries.with_surfaces(surfaces).with_forces(forces);
    let movers = Movers {
        obstacles: moving,
        speeds,
    };
    Ok((boundaries, movers))
}

fn obstacle<const D: usize>(shape: Arc<dyn Shape<D>>, contact: Contact, velocity: [f64; D]) -> Obstacle<D> {
    Obstacle {
        shape: Box::new(Placed {
            shape,
            offset: [0.0; D],
        }),
        contact,
        velocity,
    }
}

fn velocity<const D: usize>(field: &str, list: Option<&Vec<f64>>) -> Result<[f64; D], SceneFault> {
    list.map_or(Ok([0.0; D]), |list| vector(field, list))
}

fn wall<const D: usize>(room: &Bounds<D>, index: usize, table: &scene::WallTable) -> Result<Plane<D>, SceneFault> {
    let (point, normal) = plane::build(room, index, table)?;
    Ok(Plane {
        point,
        normal,
        contact: match table.condition {
            WallCondition::Fixed | WallCondition::Prescribed => Contact::Stick,
            WallCondition::Slip => Contact::Slip,
            WallCondition::Friction => Contact::Separate {
                friction: table.friction.unwrap_or(0.0),
            },
        },
        velocity: velocity(&format!("walls[{index}].velocity"), table.velocity.as_ref())?,
    })
}
