//! Facets that cells share.

use crate::MeshError;

/// In place of a neighbour's number, where a facet is part of the boundary.
pub const NO_CELL: u32 = u32::MAX;

/// A facet as one of its cells has it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Facet<const D: usize> {
    /// Vertices in ascending order.
    vertices: [u32; D],
    cell: u32,
    /// Place in the cell of the vertex opposite.
    opposite: u8,
    /// Which side of the facet the cell is on: the sign of the order (opposite, ascending vertices) relative to the cell's own.
    even: bool,
}

/// D + 1 cells per cell, the k-th across the facet opposite vertex k.
pub fn neighbours<const D: usize>(cells: &[u32]) -> Result<Vec<u32>, MeshError> {
    let numbered = (0u32..).zip(cells.chunks_exact(D + 1));
    let mut facets: Vec<Facet<D>> = numbered
        .flat_map(|(number, cell)| (0..=D).map(move |k| facet(number, cell, k)))
        .collect();
    facets.sort_unstable();
    let mut neighbours = vec![NO_CELL; cells.len()];
    for group in facets.chunk_by(|a, b| a.vertices == b.vertices) {
        if let [first, second] = group {
            check_pair(first, second, cells)?;
            neighbours[place(first)] = second.cell;
            neighbours[place(second)] = first.cell;
        } else if group.len() > 2 {
            return Err(too_many(group, cells));
        }
    }
    Ok(neighbours)
}

fn facet<const D: usize>(number: u32, cell: &[u32], opposite: usize) -> Facet<D> {
    let mut vertices = std::array::from_fn(|k| cell[if k < opposite { k } else { k + 1 }]);
    // Moving the opposite vertex to the front takes `opposite` exchanges, sorting the others one per inversion.
    let inversions = (1..D).map(|k| vertices[..k].iter().filter(|&&v| v > vertices[k]).count());
    let exchanges = opposite + inversions.sum::<usize>();
    vertices.sort_unstable();
    Facet {
        vertices,
        cell: number,
        opposite: opposite as u8,
        even: exchanges.is_multiple_of(2),
    }
}

/// Where the neighbour across the facet is listed.
fn place<const D: usize>(facet: &Facet<D>) -> usize {
    facet.cell as usize * (D + 1) + facet.opposite as usize
}

fn check_pair<const D: usize>(first: &Facet<D>, second: &Facet<D>, cells: &[u32]) -> Result<(), MeshError> {
    let (one, other) = (first.cell as usize, second.cell as usize);
    if cells[place(first)] == cells[place(second)] {
        return Err(MeshError::DuplicateCells {
            first: one,
            second: other,
        });
    }
    if first.even == second.even {
        return Err(MeshError::OverlappingCells {
            first: one,
            second: other,
            facet: first.vertices.to_vec(),
        });
    }
    Ok(())
}

/// More than two cells at one facet: twice the same cell, or a mesh that is not a manifold.
fn too_many<const D: usize>(group: &[Facet<D>], cells: &[u32]) -> MeshError {
    for (k, second) in group.iter().enumerate() {
        let opposite = cells[place(second)];
        if let Some(first) = group[..k].iter().find(|first| cells[place(first)] == opposite) {
            return MeshError::DuplicateCells {
                first: first.cell as usize,
                second: second.cell as usize,
            };
        }
    }
    MeshError::NonManifoldFacet {
        facet: group[0].vertices.to_vec(),
        cells: group.iter().map(|facet| facet.cell).collect(),
    }
}
