//! Blocks of cubes, straight and sheared.

use super::cubes::{Cubes, counts};
use crate::SimplexMesh;
use crate::generate::GenerationError;

/// A mesh of a box, cut from the body-centred lattice of the cuboids that divide it, nearest to cubes of edge `length`.
///
/// This lattice is ours: its tetrahedra are the best that fill space in one shape (angles of 60° and 90°, radius ratio 0.95), where those of
/// Kuhn have 45° and 0.72. At the boundary pyramids are cut in half (45°). Edges have `length`, √3/2 and, on the boundary, √2 of it.
///
/// # Errors
/// [`GenerationError::InvalidParameter`] unless `lower` is less than `upper` along every axis and the length positive;
/// [`GenerationError::TooFine`].
pub fn cuboid(lower: [f64; 3], upper: [f64; 3], length: f64) -> Result<SimplexMesh<3>, GenerationError> {
    let extents: [f64; 3] = std::array::from_fn(|axis| upper[axis] - lower[axis]);
    for (name, extent) in ["extent along x", "extent along y", "extent along z"]
        .into_iter()
        .zip(extents)
    {
        GenerationError::check_positive(name, extent)?;
    }
    let map = |unit: [f64; 3]| std::array::from_fn(|axis| lower[axis] * (1.0 - unit[axis]) + upper[axis] * unit[axis]);
    let counts = counts(extents, length)?;
    Cubes { counts, map }.mesh()
}

/// A mesh of a slope: 0 ≤ y ≤ height, 0 ≤ z ≤ width and 0 ≤ x ≤ base + (crest − base) y / height, so `crest` is the length at
/// the top and `base` at the bottom.
///
/// The cubes of [`cuboid`], as many at every height, are stretched along x: sheared more the nearer they are to the slope.
///
/// # Errors
/// [`GenerationError::InvalidParameter`] unless all are positive; [`GenerationError::TooFine`].
pub fn slope(height: f64, crest: f64, base: f64, width: f64, length: f64) -> Result<SimplexMesh<3>, GenerationError> {
    for (name, value) in [("height", height), ("crest", crest), ("base", base), ("width", width)] {
        GenerationError::check_positive(name, value)?;
    }
    let map = |[x, y, z]: [f64; 3]| [x * (base + (crest - base) * y), height * y, width * z];
    let counts = counts([0.5 * (crest + base), height, width], length)?;
    Cubes { counts, map }.mesh()
}
