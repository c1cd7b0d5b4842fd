//! Which node is at a position.

use mpm_tensor::vector::distance;

use super::MeshBasis;

/// A vertex this close to a position, in units of the shortest edge, is there.
const SAME_PLACE: f64 = 1e-6;

impl<const D: usize> MeshBasis<D> {
    /// Number of the active node at `position`: a vertex of the cell there.
    pub(super) fn node_at(&self, position: &[f64; D]) -> Option<u32> {
        let mesh = self.mesh();
        let cell = match self.search.locate(position, None) {
            Some(located) => located.cell,
            // Rounding may put a vertex of the boundary outside.
            None => {
                self.search
                    .nearest(position, SAME_PLACE * self.shortest_edge)?
                    .located
                    .cell
            }
        };
        let near =
            |&&vertex: &&u32| distance(position, &mesh.vertices()[vertex as usize]) <= SAME_PLACE * self.shortest_edge;
        let vertex = *mesh.cell(cell as usize).iter().find(near)? as usize;
        (self.marks.get(vertex) == Some(&1)).then(|| self.numbers[vertex])
    }
}
