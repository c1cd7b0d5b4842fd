//! Cells and vertices numbered so that neighbours in space are neighbours in memory.

use crate::{MeshError, SimplexMesh};

/// A mesh in the order of a curve.
#[derive(Clone, Debug)]
pub(super) struct AlongCurve<const D: usize> {
    pub mesh: SimplexMesh<D>,
    /// What cell k was in the mesh before.
    pub cells: Vec<u32>,
    /// What vertex k was in the mesh before.
    pub vertices: Vec<u32>,
}

impl<const D: usize> AlongCurve<D> {
    /// Cells in the order of a Morton curve (Morton 1966) through their centres, vertices in the order in which cells name them.
    pub fn new(mesh: &SimplexMesh<D>) -> Result<Self, MeshError> {
        let (mut low, mut high) = ([f64::INFINITY; D], [f64::NEG_INFINITY; D]);
        for x in mesh.vertices() {
            for a in 0..D {
                (low[a], high[a]) = (low[a].min(x[a]), high[a].max(x[a]));
            }
        }
        let extent = (0..D).map(|a| high[a] - low[a]).fold(0.0, f64::max);
        let bits = 63 / D as u32;
        let scale = ((1u64 << bits) - 1) as f64 / extent;
        let key = |cell: &[u32]| {
            let centre: [f64; D] = std::array::from_fn(|a| {
                let sum: f64 = cell.iter().map(|&vertex| mesh.vertices()[vertex as usize][a]).sum();
                sum / (D + 1) as f64
            });
            let places: [u64; D] = std::array::from_fn(|a| ((centre[a] - low[a]) * scale) as u64);
            (0..bits).rev().fold(0u64, |key, bit| {
                places.iter().fold(key, |key, place| key << 1 | (place >> bit & 1))
            })
        };
        let mut cells: Vec<(u64, u32)> = mesh
            .cells()
            .zip(0..)
            .map(|(cell, number)| (key(cell), number))
            .collect();
        cells.sort_unstable();
        let cells: Vec<u32> = cells.into_iter().map(|(_, number)| number).collect();
        let mut numbers = vec![u32::MAX; mesh.vertices().len()];
        let (mut vertices, mut members) = (Vec::with_capacity(numbers.len()), Vec::new());
        for &cell in &cells {
            for &vertex in mesh.cell(cell as usize) {
                let number = &mut numbers[vertex as usize];
                if *number == u32::MAX {
                    *number = vertices.len() as u32;
                    vertices.push(vertex);
                }
                members.push(*number);
            }
        }
        let positions = vertices
            .iter()
            .map(|&vertex| mesh.vertices()[vertex as usize])
            .collect();
        let mesh = SimplexMesh::new(positions, members)?;
        Ok(Self { mesh, cells, vertices })
    }
}
