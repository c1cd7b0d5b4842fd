//! Where walls are.

use mpm_tensor::vector as algebra;

use crate::SceneFault;
use crate::scene::{Scene, Side, WallTable};
use crate::shape::{Bounds, unit};
use crate::values::{finite, vector, within};

/// A point of the plane of a wall, and the unit normal into the domain.
///
/// # Errors
/// [`SceneFault::Value`] unless there are either an axis of the scene and a side, or a point and a normal.
pub(crate) fn build<const D: usize>(
    room: &Bounds<D>,
    index: usize,
    wall: &WallTable,
) -> Result<([f64; D], [f64; D]), SceneFault> {
    let field = |key: &str| format!("walls[{index}].{key}");
    match (wall.axis, wall.side, &wall.point, &wall.normal) {
        (Some(name), Some(side), None, None) => {
            let axis = name.index();
            let (border, inward) = match side {
                Side::Lower => (&room.lower, 1.0),
                Side::Upper => (&room.upper, -1.0),
            };
            let expected = format!("an axis of the scene, whose dimension is {D}");
            within(&field("axis"), name, axis < D, &expected)?;
            let position = finite(&field("position"), wall.position.unwrap_or(border[axis]))?;
            let along = |value: f64| std::array::from_fn(|a| if a == axis { value } else { 0.0 });
            Ok((along(position), along(inward)))
        }
        (None, None, Some(point), Some(normal)) => {
            let (position, expected) = (wall.position, "left out unless there is an axis");
            within(&field("position"), position, position.is_none(), expected)?;
            let direction = unit(vector(&field("normal"), normal)?);
            within(&field("normal"), normal, direction != [0.0; D], "longer than 0")?;
            Ok((vector(&field("point"), point)?, direction))
        }
        (axis, ..) => {
            let expected = "given with a side, or left out with a point and a normal";
            Err(SceneFault::value(field("axis"), axis, expected))
        }
    }
}

/// A room whose borders are not known yet: no position that a wall can have is at one.
const UNKNOWN: f64 = f64::MAX;

/// Planes whose points differ along the normal by less than this share of their largest coordinate are one.
const SAME: f64 = 1e-9;

/// Whether all walls in the same plane, on the same side of it, say the same. Borders of a scene without a domain, that of its mesh, are known with `room` alone.
///
/// # Errors
/// [`SceneFault::Value`] with what a wall says in another way than an earlier one, and what [`build`] says.
pub(crate) fn check_alike<const D: usize>(scene: &Scene, room: Option<&Bounds<D>>) -> Result<(), SceneFault> {
    let unknown = Bounds {
        lower: [-UNKNOWN; D],
        upper: [UNKNOWN; D],
    };
    let room = room.unwrap_or(&unknown);
    let mut earlier: Vec<([f64; D], [f64; D])> = Vec::new();
    for (index, wall) in scene.walls.iter().enumerate() {
        let (point, normal) = build(room, index, wall)?;
        let largest = |x: &[f64; D]| x.iter().fold(0.0f64, |largest, c| largest.max(c.abs()));
        let same = |(other, direction): &([f64; D], [f64; D])| {
            let apart = algebra::dot(&algebra::subtract(&point, other), &normal);
            largest(&algebra::subtract(&normal, direction)) <= SAME
                && apart.abs() <= SAME * largest(&point).max(largest(other))
        };
        if let Some(first) = earlier.iter().position(same) {
            let (other, field) = (&scene.walls[first], |key: &str| format!("walls[{index}].{key}"));
            let expected = format!("that of walls[{first}], which is in the same plane");
            within(
                &field("condition"),
                wall.condition,
                wall.condition == other.condition,
                &expected,
            )?;
            within(
                &field("velocity"),
                &wall.velocity,
                wall.velocity == other.velocity,
                &expected,
            )?;
            within(
                &field("friction"),
                wall.friction,
                wall.friction == other.friction,
                &expected,
            )?;
        }
        earlier.push((point, normal));
    }
    Ok(())
}

/// Where particles may be in a run: the domain, and a cell beyond where a wall stands at its border. Walls are felt by nodes, and particles that touch one may be a little behind it.
///
/// # Errors
/// What [`build`] says.
pub(crate) fn limits<const D: usize>(scene: &Scene, room: &Bounds<D>, spacing: f64) -> Result<Bounds<D>, SceneFault> {
    let mut limits = *room;
    for (index, wall) in scene.walls.iter().enumerate() {
        let (point, normal) = build(room, index, wall)?;
        for axis in 0..D {
            if normal[axis] == 1.0 && point[axis] == room.lower[axis] {
                limits.lower[axis] = room.lower[axis] - spacing;
            }
            if normal[axis] == -1.0 && point[axis] == room.upper[axis] {
                limits.upper[axis] = room.upper[axis] + spacing;
            }
        }
    }
    Ok(limits)
}

/// A particle this far behind a wall, in units of h, is on it: rounding of turned planes and bodies.
const ON_WALL: f64 = 1e-9;

/// Whether no particle is behind a wall at t = 0: a wall that looks the wrong way would hold all of a body, and say nothing. `bodies` are the particles' numbers of their bodies.
///
/// # Errors
/// [`SceneFault::BehindWall`] with the first one, and what [`build`] says.
pub(crate) fn check_sides<const D: usize>(
    scene: &Scene,
    room: &Bounds<D>,
    spacing: f64,
    positions: &[[f64; D]],
    bodies: &[u32],
) -> Result<(), SceneFault> {
    for (index, wall) in scene.walls.iter().enumerate() {
        let (point, normal) = build(room, index, wall)?;
        let height = |x: &[f64; D]| algebra::dot(&algebra::subtract(x, &point), &normal);
        if let Some(particle) = positions.iter().position(|x| height(x) < -ON_WALL * spacing) {
            let body = bodies.get(particle).and_then(|&body| scene.bodies.get(body as usize));
            return Err(SceneFault::BehindWall {
                body: body.map_or(String::new(), |body| body.name.clone()),
                particle,
                position: positions[particle].to_vec(),
                wall: index,
                point: point.to_vec(),
                normal: normal.to_vec(),
            });
        }
    }
    Ok(())
}
