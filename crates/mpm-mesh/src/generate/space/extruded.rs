//! Prisms on triangles.

use super::slices;
use crate::SimplexMesh;
use crate::generate::prism::prism_cells;
use crate::generate::{EdgeTarget, GenerationError, polygon};

/// The mesh of the body 0 ≤ z ≤ `width` above a mesh of triangles in the plane z = 0, in layers of a height nearest to `length`: each prism is cut
/// into three tetrahedra.
///
/// On an equilateral triangle with height and edge equal these have radius ratios 0.81, 0.73 and 0.81 and angles from 41° to 112°.
///
/// # Errors
/// [`GenerationError::InvalidParameter`] unless width and length are positive; [`GenerationError::TooFine`].
pub fn extruded(base: &SimplexMesh<2>, width: f64, length: f64) -> Result<SimplexMesh<3>, GenerationError> {
    let layers = slices("width", width, length)?;
    GenerationError::check_count(length, 3.0 * layers * base.cell_count() as f64)?;
    let count = base.vertices().len() as u32;
    let layers = layers as u32;
    let level = |layer: u32| {
        let z = width * (f64::from(layer) / f64::from(layers));
        base.vertices().iter().map(move |&[x, y]| [x, y, z])
    };
    let vertices = (0..=layers).flat_map(level).collect();
    let mut cells = Vec::new();
    for triangle in base.cells() {
        let mut members: [u32; 3] = std::array::from_fn(|k| triangle[k]);
        let inversions = [(0, 1), (0, 2), (1, 2)]
            .iter()
            .filter(|&&(a, b)| members[a] > members[b]);
        let positive = inversions.count() % 2 == 0;
        members.sort_unstable();
        for layer in 0..layers {
            let [lower, upper] = [layer, layer + 1].map(|layer| members.map(|vertex| layer * count + vertex));
            cells.extend(prism_cells(&lower, &upper, positive));
        }
    }
    Ok(SimplexMesh::new(vertices, cells)?)
}

/// A mesh of a slope: 0 ≤ y ≤ height, 0 ≤ z ≤ width and 0 ≤ x ≤ base + (crest − base) y / height, so `crest` is the length at
/// the top and `base` at the bottom: a [`polygon`], [`extruded`].
///
/// # Errors
/// [`GenerationError::InvalidParameter`] unless all are positive; [`GenerationError::TooFine`].
pub fn slope(height: f64, crest: f64, base: f64, width: f64, length: f64) -> Result<SimplexMesh<3>, GenerationError> {
    for (name, value) in [("height", height), ("crest", crest), ("base", base), ("width", width)] {
        GenerationError::check_positive(name, value)?;
    }
    let corners = [[0.0, 0.0], [base, 0.0], [crest, height], [0.0, height]];
    extruded(&polygon(&corners, &EdgeTarget { length, angle: 0.0 })?, width, length)
}
