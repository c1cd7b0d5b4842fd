/// Why a mesh was refused.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshError {
    /// There are no vertices or no cells.
    #[error("the mesh has no {what}")]
    Empty {
        /// `vertices` or `cells`.
        what: &'static str,
    },
    /// The list of cells does not divide into cells of D + 1 vertices.
    #[error("{count} vertex numbers do not divide into cells of {per_cell}")]
    RaggedCells {
        /// Length of the list.
        count: usize,
        /// D + 1.
        per_cell: usize,
    },
    /// A cell names a vertex that there is not.
    #[error("cell {cell} names vertex {vertex}, and there are {vertex_count}")]
    UnknownVertex {
        /// The cell.
        cell: usize,
        /// What it names.
        vertex: u32,
        /// Number of vertices.
        vertex_count: usize,
    },
}
