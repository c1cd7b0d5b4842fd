//! A lattice of equilateral triangles that covers a rectangle.

use crate::SimplexMesh;
use crate::generate::GenerationError;

/// A mesh of equal triangles that covers the rectangle between two corners: a background for bodies that are not as wide as it.
///
/// Columns of vertices, `length` apart along y and every second one moved by half of it, stand w = W / ⌈2W / (√3 `length`)⌉ apart, W being the
/// rectangle's width. So the sides x = `lower`\[0\] and x = `upper`\[0\] are straight, and walls may stand there; the other two are serrated and reach up to 3/2 `length`
/// beyond the rectangle. Sides along y have the length asked for, the others √(w² + `length`²/4), at most as much: no mesh of this
/// target has a shorter longest edge, which is the width of the kernel, and hardly one a longer shortest edge, which limits the time step. Ours.
///
/// # Errors
/// [`GenerationError::InvalidParameter`] unless `length` is positive and `lower` less than `upper` along both axes;
/// [`GenerationError::TooFine`]; [`GenerationError::Mesh`] where the columns are too close for triangles: a rectangle far narrower than an edge.
pub fn triangle_lattice(lower: [f64; 2], upper: [f64; 2], length: f64) -> Result<SimplexMesh<2>, GenerationError> {
    let [width, height] = [upper[0] - lower[0], upper[1] - lower[1]];
    GenerationError::check_positive("width", width)?;
    GenerationError::check_positive("height", height)?;
    GenerationError::check_positive("length", length)?;
    let (columns, rows) = (whole(width / (0.75f64.sqrt() * length)), whole(height / length));
    GenerationError::check_count(length, columns * (2.0 * rows + 1.0))?;
    let step = width / columns;
    let (columns, rows) = (columns as u32, rows as u32);
    let mut vertices = Vec::new();
    let mut starts = Vec::new();
    for column in 0..=columns {
        starts.push(vertices.len() as u32);
        let x = if column == columns {
            upper[0]
        } else {
            lower[0] + f64::from(column) * step
        };
        let moved = column % 2;
        let first = lower[1] - 0.5 * f64::from(moved) * length;
        vertices.extend((0..=rows + moved).map(|row| [x, first + f64::from(row) * length]));
    }
    let mut cells = Vec::new();
    for (column, pair) in starts.windows(2).enumerate() {
        let &[left, right] = pair else { continue };
        // Between a column of n + 1 vertices and one of n + 2 there are n + 1 triangles with a side on the longer one and n with a side on the
        // shorter one; the longer one is on the right of even columns.
        let even = column % 2 == 0;
        for row in 0..=rows {
            cells.extend(if even {
                [left + row, right + row, right + row + 1]
            } else {
                [left + row, right + row, left + row + 1]
            });
        }
        for row in 0..rows {
            cells.extend(if even {
                [left + row, right + row + 1, left + row + 1]
            } else {
                [left + row + 1, right + row, right + row + 1]
            });
        }
    }
    Ok(SimplexMesh::new(vertices, cells)?)
}

/// The least whole number that is not below x by more than rounding, at least one.
fn whole(x: f64) -> f64 {
    (x * (1.0 - 1e-12)).ceil().max(1.0)
}
