//! What vertices and cells have to satisfy one by one.

use mpm_tensor::vector::{distance, is_finite};

use super::frame::signed_volume;
use crate::MeshError;

/// A cell of volume V and longest edge h is flat where |V| ≤ this · h^D. Ours: well above the rounding of a determinant and
/// well below any cell of use (a regular triangle has 0.43, a regular tetrahedron 0.12).
const FLAT: f64 = 1e-12;

/// The checks that need no neighbour: numbers, coordinates, orientation.
pub fn check<const D: usize>(vertices: &[[f64; D]], cells: &[u32]) -> Result<(), MeshError> {
    if !(1..=3).contains(&D) {
        return Err(MeshError::UnsupportedDimension { dimension: D });
    }
    for (what, count) in [("vertices", vertices.len()), ("cells", cells.len().div_ceil(D + 1))] {
        if count == 0 {
            return Err(MeshError::Empty { what });
        }
        if count >= u32::MAX as usize {
            return Err(MeshError::TooLarge { what, count });
        }
    }
    if !cells.len().is_multiple_of(D + 1) {
        return Err(MeshError::RaggedCells {
            count: cells.len(),
            per_cell: D + 1,
        });
    }
    check_vertices(vertices, cells)?;
    for (number, cell) in cells.chunks_exact(D + 1).enumerate() {
        check_cell(vertices, number, cell)?;
    }
    Ok(())
}

fn check_vertices<const D: usize>(vertices: &[[f64; D]], cells: &[u32]) -> Result<(), MeshError> {
    let mut used = vec![false; vertices.len()];
    for (place, &vertex) in cells.iter().enumerate() {
        let mark = used.get_mut(vertex as usize);
        *mark.ok_or(MeshError::UnknownVertex {
            cell: place / (D + 1),
            vertex,
            vertex_count: vertices.len(),
        })? = true;
    }
    if let Some(vertex) = vertices.iter().position(|position| !is_finite(position)) {
        let position = vertices[vertex].to_vec();
        return Err(MeshError::NonFiniteVertex { vertex, position });
    }
    match used.iter().position(|&used| !used) {
        Some(vertex) => Err(MeshError::UnusedVertex { vertex }),
        None => Ok(()),
    }
}

fn check_cell<const D: usize>(vertices: &[[f64; D]], number: usize, cell: &[u32]) -> Result<(), MeshError> {
    for (place, &vertex) in cell.iter().enumerate() {
        if cell[..place].contains(&vertex) {
            return Err(MeshError::RepeatedVertex { cell: number, vertex });
        }
    }
    let volume = signed_volume(vertices, cell);
    let longest_edge = longest_edge(vertices, cell);
    let limit = FLAT * longest_edge.powi(D as i32);
    if volume < -limit {
        return Err(MeshError::InvertedCell { cell: number, volume });
    }
    if volume > limit && volume.is_finite() {
        return Ok(());
    }
    Err(MeshError::FlatCell {
        cell: number,
        volume,
        longest_edge,
    })
}

fn longest_edge<const D: usize>(vertices: &[[f64; D]], cell: &[u32]) -> f64 {
    let mut longest = 0f64;
    for (place, &a) in cell.iter().enumerate() {
        for &b in &cell[..place] {
            longest = longest.max(distance(&vertices[a as usize], &vertices[b as usize]));
        }
    }
    longest
}
