//! Turns about a point of the plane.

use mpm_tensor::{Matrix, vector as algebra};

use crate::SceneFault;
use crate::scene::RotationTable;
use crate::values::{finite, vector, within};

/// x ↦ c + R (x − c).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rotation<const D: usize> {
    /// c.
    pub centre: [f64; D],
    /// R.
    pub matrix: Matrix<D>,
}

impl<const D: usize> Rotation<D> {
    /// Where a point goes.
    pub fn apply(&self, x: &[f64; D]) -> [f64; D] {
        algebra::add(&self.centre, &self.matrix.apply(&algebra::subtract(x, &self.centre)))
    }

    /// Where a point comes from.
    pub fn undo(&self, x: &[f64; D]) -> [f64; D] {
        let offset = algebra::subtract(x, &self.centre);
        algebra::add(&self.centre, &self.matrix.apply_transposed(&offset))
    }
}

/// The turn that a table describes, none without one.
///
/// # Errors
/// [`SceneFault::Value`] in other dimensions than two, and for numbers that are not finite.
pub(crate) fn build<const D: usize>(
    field: &str,
    table: Option<&RotationTable>,
) -> Result<Option<Rotation<D>>, SceneFault> {
    let Some(table) = table else { return Ok(None) };
    within(field, table, D == 2, "left out unless dimension = 2")?;
    let centre = vector(&format!("{field}.centre"), &table.centre)?;
    let degrees = finite(&format!("{field}.degrees"), table.degrees)?;
    let (sine, cosine) = degrees.to_radians().sin_cos();
    let matrix = Matrix::from_fn(|a, b| match (a, b) {
        (0, 1) => -sine,
        (1, 0) => sine,
        _ => cosine,
    });
    Ok(Some(Rotation { centre, matrix }))
}
