//! Where walls are.

use crate::SceneFault;
use crate::scene::{Side, WallTable};
use crate::shape::{Bounds, unit};
use crate::values::{vector, within};

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
            let Some(&border) = border.get(axis) else {
                return Err(SceneFault::value(
                    field("axis"),
                    name,
                    format!("one of the {D} axes of the scene"),
                ));
            };
            let position = wall.position.unwrap_or(border);
            within(&field("position"), position, position.is_finite(), "finite")?;
            let along = |value: f64| std::array::from_fn(|a| if a == axis { value } else { 0.0 });
            Ok((along(position), along(inward)))
        }
        (None, None, Some(point), Some(normal)) => {
            if let Some(position) = wall.position {
                let expected = "left out unless there is an axis";
                return Err(SceneFault::value(field("position"), position, expected));
            }
            let direction = unit(vector(&field("normal"), normal)?);
            if direction == [0.0; D] {
                return Err(SceneFault::value(field("normal"), normal, "longer than 0"));
            }
            Ok((vector(&field("point"), point)?, direction))
        }
        (axis, ..) => {
            let expected = "given with a side, or left out with a point and a normal";
            Err(SceneFault::value(field("axis"), axis, expected))
        }
    }
}
