//! Meshes of an interval.

use super::GenerationError;
use crate::SimplexMesh;

/// Segments of the given sizes from `start` on: vertex k at start + Σ_{j < k} size_j.
///
/// # Errors
/// [`GenerationError::InvalidParameter`] unless all sizes are positive and finite, [`GenerationError::Mesh`] without any.
pub fn segments(start: f64, sizes: &[f64]) -> Result<SimplexMesh<1>, GenerationError> {
    let mut vertices = vec![[start]];
    let mut end = start;
    for &size in sizes {
        GenerationError::check_positive("size", size)?;
        end += size;
        vertices.push([end]);
    }
    let cells = (0..sizes.len() as u32).flat_map(|cell| [cell, cell + 1]).collect();
    Ok(SimplexMesh::new(vertices, cells)?)
}

/// `count` sizes that go in turn through `pattern` and together make up `length`: s_k = length · p_{k mod n} / Σ_j p_{j mod n}.
///
/// `[1.0]` gives equal sizes, `[1.0, r, r * r]` the ratios 1, R, R² in turn.
///
/// # Errors
/// [`GenerationError::InvalidParameter`] unless the length, the count and every entry of the pattern are positive and finite.
pub fn cyclic_sizes(length: f64, count: usize, pattern: &[f64]) -> Result<Vec<f64>, GenerationError> {
    GenerationError::check_positive("length", length)?;
    GenerationError::check_positive("count", count as f64)?;
    GenerationError::check_positive("length of the pattern", pattern.len() as f64)?;
    for &entry in pattern {
        GenerationError::check_positive("entry of the pattern", entry)?;
    }
    GenerationError::check_count(length / count as f64, count as f64)?;
    let parts: Vec<f64> = pattern.iter().copied().cycle().take(count).collect();
    let sum: f64 = parts.iter().sum();
    Ok(parts.iter().map(|part| length * part / sum).collect())
}
