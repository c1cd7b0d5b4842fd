//! Tractions of facets as functions of the place.

use mpm_tensor::vector as algebra;

use crate::scene::{FacetTable, PressureField, PressureTable, Scene, VectorField, VectorTable};
use crate::values::{finite, positive, vector, within};
use crate::{SceneFault, vector_field};

/// t at a point of a facet, from its outward normal.
pub(crate) type Traction<const D: usize> = Box<dyn Fn(&[f64; D], &[f64; D]) -> [f64; D]>;

/// What a table with `condition = "traction"` says: t itself, or −p n. Without either there is none.
///
/// # Errors
/// [`SceneFault::Value`] for vectors of the wrong length, numbers out of range, a manufactured solution and a fluid without gravity.
pub(crate) fn build<const D: usize>(
    field: &dyn Fn(&str) -> String,
    table: &FacetTable,
    scene: &Scene,
) -> Result<Traction<D>, SceneFault> {
    let manufactured = matches!(
        table.traction,
        Some(VectorTable::Field(VectorField::Manufactured { .. }))
    );
    let expected = "a vector or a field of another kind: this is a velocity";
    within(&field("traction"), &table.traction, !manufactured, expected)?;
    if table.traction.is_some() {
        let traction = vector_field::build::<D>(&field("traction"), table.traction.as_ref(), scene)?;
        return Ok(Box::new(move |x, _| traction.at(x)));
    }
    let pressure = pressure(&field("pressure"), table.pressure.as_ref(), scene)?;
    Ok(Box::new(move |x, normal| algebra::scale(normal, -pressure(x))))
}

/// p at a point.
type Pressure<const D: usize> = Box<dyn Fn(&[f64; D]) -> f64>;

fn pressure<const D: usize>(
    field: &str,
    table: Option<&PressureTable>,
    scene: &Scene,
) -> Result<Pressure<D>, SceneFault> {
    let PressureField::Hydrostatic { density, surface } = match table {
        None => return Ok(Box::new(|_| 0.0)),
        Some(&PressureTable::Uniform(pressure)) => {
            finite(field, pressure)?;
            return Ok(Box::new(move |_| pressure));
        }
        Some(PressureTable::Field(table)) => table,
    };
    let density = positive(&format!("{field}.density"), *density)?;
    let surface = vector::<D>(&format!("{field}.surface"), surface)?;
    let gravity = <[f64; D]>::try_from(scene.gravity.as_slice()).unwrap_or([0.0; D]);
    let falls = gravity != [0.0; D];
    within(
        field,
        table,
        falls,
        "a number: without gravity a fluid at rest has no pressure",
    )?;
    Ok(Box::new(move |x| {
        density * algebra::dot(&gravity, &algebra::subtract(x, &surface)).max(0.0)
    }))
}
