//! Where walls are.

use crate::SceneFault;
use crate::scene::{Side, WallTable};
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
            let (axis, (border, inward)) = (
                name.index(),
                match side {
                    Side::Lower => (&room.lower, 1.0),
                    Side::Upper => (&room.upper, -1.0),
                },
            );
            let expected = format!("one of the {D} axes of the scene");
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
