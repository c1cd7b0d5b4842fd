//! Which cells share a facet.

use crate::SimplexMesh;

/// In the place of a neighbour at the boundary.
pub(super) const NO_CELL: u32 = u32::MAX;

/// The cell across the facet opposite to vertex n of cell c, at c (D + 1) + n. Of more than two cells at a facet the first two in
/// order are neighbours.
pub(super) fn facet_neighbours<const D: usize>(mesh: &SimplexMesh<D>) -> Vec<u32> {
    let mut facets: Vec<([u32; D], u32)> = Vec::with_capacity(mesh.cell_count() * (D + 1));
    for (c, cell) in mesh.cells().enumerate() {
        for n in 0..=D {
            let mut facet: [u32; D] = std::array::from_fn(|k| cell[if k < n { k } else { k + 1 }]);
            facet.sort_unstable();
            facets.push((facet, (c * (D + 1) + n) as u32));
        }
    }
    facets.sort_unstable();
    let mut neighbours = vec![NO_CELL; facets.len()];
    let mut rest = &facets[..];
    while let [first, second, ..] = rest {
        if first.0 != second.0 {
            rest = &rest[1..];
            continue;
        }
        let per_cell = D as u32 + 1;
        neighbours[first.1 as usize] = second.1 / per_cell;
        neighbours[second.1 as usize] = first.1 / per_cell;
        rest = &rest[2..];
    }
    neighbours
}
