//! From a shape's table to the shape.

use mpm_mesh::generate::check_outlines;

use super::{Ball, Bounds, Capsule, Cuboid, Difference, HalfSpace, Intersection, Polygon, Shape, Twisted, Union, unit};
use crate::SceneFault;
use crate::scene::ShapeTable;
use crate::values::{finite, positive, vector, within};

/// The shape that a table describes; `field` is what errors call it.
///
/// # Errors
/// [`SceneFault::Value`] for a vector of the wrong length, a number that is not finite, a box or polygon that holds no point, a polygon that crosses itself, a radius that is not
/// positive, a normal of no length, a combination of nothing, a polygon in other than two dimensions, a twist in
/// other than three or of a shape without bounds.
pub fn build<const D: usize>(field: &str, table: &ShapeTable) -> Result<Box<dyn Shape<D>>, SceneFault> {
    let point = |name: &str, list: &[f64]| vector::<D>(&format!("{field}.{name}"), list);
    let radius_of = |radius: f64| positive(&format!("{field}.radius"), radius);
    let all = |name: &str, tables: &[ShapeTable]| {
        let each = tables.iter().enumerate();
        each.map(|(k, table)| build::<D>(&format!("{field}.{name}[{k}]"), table))
            .collect::<Result<Vec<_>, _>>()
    };
    Ok(match table {
        ShapeTable::Box { lower, upper } => {
            let (lower, upper) = (point("lower", lower)?, point("upper", upper)?);
            let (name, above) = (format!("{field}.upper"), (0..D).all(|a| lower[a] < upper[a]));
            within(&name, upper.as_slice(), above, &format!("above lower = {lower:?}"))?;
            Box::new(Cuboid { lower, upper })
        }
        ShapeTable::Sphere { centre, radius } => Box::new(Ball {
            centre: point("centre", centre)?,
            radius: radius_of(*radius)?,
        }),
        ShapeTable::Capsule { start, end, radius } => Box::new(Capsule {
            start: point("start", start)?,
            end: point("end", end)?,
            radius: radius_of(*radius)?,
        }),
        ShapeTable::Polygon { corners } => Box::new(polygon::<D>(field, corners)?),
        ShapeTable::HalfSpace { point: on, normal } => {
            let direction = unit(point("normal", normal)?);
            within(
                &format!("{field}.normal"),
                normal,
                direction != [0.0; D],
                "longer than 0",
            )?;
            Box::new(HalfSpace {
                point: point("point", on)?,
                normal: direction,
            })
        }
        ShapeTable::Union { shapes } => Box::new(Union(some(field, all("shapes", shapes)?)?)),
        ShapeTable::Intersection { shapes } => Box::new(Intersection(some(field, all("shapes", shapes)?)?)),
        ShapeTable::Difference { from, remove } => Box::new(Difference {
            from: build(&format!("{field}.from"), from)?,
            remove: all("remove", remove)?,
        }),
        ShapeTable::Twist { shape, rate } => Box::new(twisted(field, shape, *rate)?),
    })
}

/// What a shape of other dimensions than its own must be.
const OF_DIMENSION: &str = "a shape of the scene's dimension";

fn some<T>(field: &str, shapes: Vec<T>) -> Result<Vec<T>, SceneFault> {
    let field = format!("{field}.shapes");
    within(&field, [0; 0], !shapes.is_empty(), "at least one shape").map(|_| shapes)
}

fn twisted<const D: usize>(field: &str, shape: &ShapeTable, rate: f64) -> Result<Twisted<D>, SceneFault> {
    within(&format!("{field}.kind"), "twist", D == 3, OF_DIMENSION)?;
    let straight = build::<D>(&format!("{field}.shape"), shape)?;
    let Bounds { lower, upper } = straight.bounds();
    let bounded = lower.iter().chain(&upper).all(|c| c.is_finite());
    within(&format!("{field}.shape"), shape, bounded, "a shape with finite bounds")?;
    Ok(Twisted::new(straight, finite(&format!("{field}.rate"), rate)?))
}

fn polygon<const D: usize>(field: &str, corners: &[[f64; 2]]) -> Result<Polygon, SceneFault> {
    within(&format!("{field}.kind"), "polygon", D == 2, OF_DIMENSION)?;
    let field = format!("{field}.corners");
    for corner in corners {
        vector::<2>(&field, corner)?;
    }
    // What stands twice in a row is one corner.
    let mut distinct = corners.to_vec();
    distinct.dedup();
    if distinct.len() > 1 && distinct.first() == distinct.last() {
        distinct.pop();
    }
    let expected = "at least three corners around an area";
    within(&field, corners, distinct.len() >= 3, expected)?;
    check_outlines(&[distinct])
        .map_err(|error| SceneFault::value(&field, corners, format!("those of a polygon: {error}")))?;
    let polygon = Polygon {
        corners: corners.to_vec(),
    };
    within(&field, corners, polygon.signed_area() != 0.0, expected).map(|_| polygon)
}
