//! From a shape's table to the shape.

use super::{Ball, Bounds, Capsule, Cuboid, Difference, HalfSpace, Intersection, Polygon, Shape, Twisted, Union, unit};
use crate::SceneFault;
use crate::scene::ShapeTable;
use crate::values::{positive, vector, within};

/// The shape that a table describes; `field` is what errors call it.
///
/// # Errors
/// [`SceneFault::Value`] for a vector of the wrong length, a number that is not finite, a box or polygon that holds no point, a radius that is not
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
            if !(0..D).all(|a| lower[a] < upper[a]) {
                return Err(SceneFault::value(
                    format!("{field}.upper"),
                    upper.as_slice(),
                    format!("above lower = {lower:?}"),
                ));
            }
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
            if direction == [0.0; D] {
                return Err(SceneFault::value(format!("{field}.normal"), normal, "longer than 0"));
            }
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

fn some<T>(field: &str, shapes: Vec<T>) -> Result<Vec<T>, SceneFault> {
    if shapes.is_empty() {
        return Err(SceneFault::value(
            format!("{field}.shapes"),
            [0; 0],
            "at least one shape",
        ));
    }
    Ok(shapes)
}

fn twisted<const D: usize>(field: &str, shape: &ShapeTable, rate: f64) -> Result<Twisted<D>, SceneFault> {
    if D != 3 {
        return Err(SceneFault::value(
            format!("{field}.kind"),
            "twist",
            "a shape of the scene's dimension",
        ));
    }
    let straight = build::<D>(&format!("{field}.shape"), shape)?;
    let Bounds { lower, upper } = straight.bounds();
    if !lower.iter().chain(&upper).all(|c| c.is_finite()) {
        return Err(SceneFault::value(
            format!("{field}.shape"),
            shape,
            "a shape with finite bounds",
        ));
    }
    let rate = within(&format!("{field}.rate"), rate, rate.is_finite(), "finite")?;
    Ok(Twisted::new(straight, rate))
}

fn polygon<const D: usize>(field: &str, corners: &[[f64; 2]]) -> Result<Polygon, SceneFault> {
    if D != 2 {
        return Err(SceneFault::value(
            format!("{field}.kind"),
            "polygon",
            "a shape of the scene's dimension",
        ));
    }
    let field = format!("{field}.corners");
    for corner in corners {
        vector::<2>(&field, corner)?;
    }
    let polygon = Polygon {
        corners: corners.to_vec(),
    };
    if corners.len() < 3 || polygon.signed_area() == 0.0 {
        return Err(SceneFault::value(
            field,
            corners,
            "at least three corners around an area",
        ));
    }
    Ok(polygon)
}
