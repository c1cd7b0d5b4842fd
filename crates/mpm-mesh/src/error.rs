/// Why a mesh was refused.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshError {
    /// Simplices of this dimension are not treated: 1, 2 and 3 are.
    #[error("meshes have dimension 1, 2 or 3, not {dimension}")]
    UnsupportedDimension {
        /// D.
        dimension: usize,
    },
    /// There are no vertices or no cells.
    #[error("the mesh has no {what}")]
    Empty {
        /// `vertices` or `cells`.
        what: &'static str,
    },
    /// Vertices or cells are more than 32-bit numbers can name.
    #[error("{count} {what} are more than a mesh can number")]
    TooLarge {
        /// `vertices` or `cells`.
        what: &'static str,
        /// How many there are.
        count: usize,
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
    /// A coordinate is not a finite number.
    #[error("vertex {vertex} is at {position:?}")]
    NonFiniteVertex {
        /// The vertex.
        vertex: usize,
        /// Its position.
        position: Vec<f64>,
    },
    /// A vertex belongs to no cell.
    #[error("vertex {vertex} belongs to no cell")]
    UnusedVertex {
        /// The vertex.
        vertex: usize,
    },
    /// A cell names a vertex twice.
    #[error("cell {cell} names vertex {vertex} twice")]
    RepeatedVertex {
        /// The cell.
        cell: usize,
        /// The vertex.
        vertex: u32,
    },
    /// A cell is negatively oriented.
    #[error("cell {cell} is inverted, its volume is {volume:e}")]
    InvertedCell {
        /// The cell.
        cell: usize,
        /// Its signed volume.
        volume: f64,
    },
    /// A cell has no volume to speak of, or one that is not finite.
    #[error("cell {cell} is flat, its volume is {volume:e} and its longest edge {longest_edge:e}")]
    FlatCell {
        /// The cell.
        cell: usize,
        /// Its signed volume.
        volume: f64,
        /// Its longest edge.
        longest_edge: f64,
    },
    /// Two cells have the same vertices.
    #[error("cells {first} and {second} have the same vertices")]
    DuplicateCells {
        /// One of them.
        first: usize,
        /// The other.
        second: usize,
    },
    /// A facet belongs to more than two cells.
    #[error("the facet of vertices {facet:?} belongs to cells {cells:?}")]
    NonManifoldFacet {
        /// Its vertices.
        facet: Vec<u32>,
        /// The cells, more than two.
        cells: Vec<u32>,
    },
    /// Two cells lie on the same side of the facet that they share.
    #[error("cells {first} and {second} lie on the same side of the facet of vertices {facet:?}")]
    OverlappingCells {
        /// One of them.
        first: usize,
        /// The other.
        second: usize,
        /// The vertices of the facet.
        facet: Vec<u32>,
    },
    /// Two vertices have the same position.
    #[error("vertices {first} and {second} have the same position")]
    DuplicateVertices {
        /// The smaller number.
        first: usize,
        /// The larger.
        second: usize,
    },
    /// A vertex lies on the boundary of a cell that it does not belong to: the mesh is not conforming.
    #[error("vertex {vertex} lies on the boundary of cell {cell}, which it does not belong to")]
    HangingVertex {
        /// The vertex.
        vertex: usize,
        /// The cell.
        cell: usize,
    },
    /// A vertex lies inside a cell: cells overlap.
    #[error("vertex {vertex} lies inside cell {cell}")]
    VertexInsideCell {
        /// The vertex.
        vertex: usize,
        /// The cell.
        cell: usize,
    },
}
