/// Why a mesh was refused. Cells and vertices are numbered from 0; [`in_words`](Self::in_words) gives them other names.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum MeshError {
    /// Simplices of this dimension are not treated: 1, 2 and 3 are.
    UnsupportedDimension {
        /// D.
        dimension: usize,
    },
    /// A number is outside its range.
    InvalidParameter {
        /// The parameter.
        name: &'static str,
        /// What was given.
        value: f64,
        /// What it should be.
        requirement: &'static str,
    },
    /// There are no vertices or no cells.
    Empty {
        /// `vertices` or `cells`.
        what: &'static str,
    },
    /// Vertices or cells are more than 32-bit numbers can name.
    TooLarge {
        /// `vertices` or `cells`.
        what: &'static str,
        /// How many there are.
        count: usize,
    },
    /// The list of cells does not divide into cells of D + 1 vertices.
    RaggedCells {
        /// Length of the list.
        count: usize,
        /// D + 1.
        per_cell: usize,
    },
    /// A cell names a vertex that there is not.
    UnknownVertex {
        /// The cell.
        cell: usize,
        /// What it names.
        vertex: u32,
        /// Number of vertices.
        vertex_count: usize,
    },
    /// A coordinate is not a finite number.
    NonFiniteVertex {
        /// The vertex.
        vertex: usize,
        /// Its position.
        position: Vec<f64>,
    },
    /// A vertex belongs to no cell.
    UnusedVertex {
        /// The vertex.
        vertex: usize,
    },
    /// A cell names a vertex twice.
    RepeatedVertex {
        /// The cell.
        cell: usize,
        /// The vertex.
        vertex: u32,
    },
    /// A cell is negatively oriented.
    InvertedCell {
        /// The cell.
        cell: usize,
        /// Its signed volume.
        volume: f64,
    },
    /// A cell has no volume to speak of, or one that is not finite.
    FlatCell {
        /// The cell.
        cell: usize,
        /// Its signed volume.
        volume: f64,
        /// Its longest edge.
        longest_edge: f64,
    },
    /// Two cells have the same vertices.
    DuplicateCells {
        /// One of them.
        first: usize,
        /// The other.
        second: usize,
    },
    /// A facet belongs to more than two cells.
    NonManifoldFacet {
        /// Its vertices.
        facet: Vec<u32>,
        /// The cells, more than two.
        cells: Vec<u32>,
    },
    /// Two cells lie on the same side of the facet that they share.
    OverlappingCells {
        /// One of them.
        first: usize,
        /// The other.
        second: usize,
        /// The vertices of the facet.
        facet: Vec<u32>,
    },
    /// Two vertices have the same position.
    DuplicateVertices {
        /// The smaller number.
        first: usize,
        /// The larger.
        second: usize,
    },
    /// A vertex lies on the boundary of a cell that it does not belong to: the mesh is not conforming.
    HangingVertex {
        /// The vertex.
        vertex: usize,
        /// The cell.
        cell: usize,
    },
    /// A vertex lies inside a cell: cells overlap.
    VertexInsideCell {
        /// The vertex.
        vertex: usize,
        /// The cell.
        cell: usize,
    },
}

impl MeshError {
    /// What is wrong, with names for cells and vertices: those of the file that they come from, where there is one.
    pub fn in_words(&self, cell: &dyn Fn(usize) -> String, vertex: &dyn Fn(usize) -> String) -> String {
        let all = |numbers: &[u32], name: &dyn Fn(usize) -> String| {
            let names: Vec<String> = numbers.iter().map(|&number| name(number as usize)).collect();
            match names.split_last() {
                Some((last, rest)) if !rest.is_empty() => format!("{} and {last}", rest.join(", ")),
                _ => names.concat(),
            }
        };
        match self {
            Self::UnsupportedDimension { dimension } => format!("meshes have dimension 1, 2 or 3, not {dimension}"),
            Self::InvalidParameter {
                name,
                value,
                requirement,
            } => format!("{name} is {value}, it should be {requirement}"),
            Self::Empty { what } => format!("the mesh has no {what}"),
            Self::TooLarge { what, count } => format!("{count} {what} are more than a mesh can number"),
            Self::RaggedCells { count, per_cell } => {
                format!("a list of length {count} does not divide into cells of {per_cell} vertices")
            }
            Self::UnknownVertex {
                cell: number,
                vertex: named,
                vertex_count,
            } => format!(
                "{} names {}, and the number of vertices is {vertex_count}",
                cell(*number),
                vertex(*named as usize)
            ),
            Self::NonFiniteVertex {
                vertex: number,
                position,
            } => format!("{} is at {position:?}", vertex(*number)),
            Self::UnusedVertex { vertex: number } => format!("{} belongs to no cell", vertex(*number)),
            Self::RepeatedVertex {
                cell: number,
                vertex: named,
            } => format!("{} names {} twice", cell(*number), vertex(*named as usize)),
            Self::InvertedCell { cell: number, volume } => {
                format!("{} is inverted, its volume is {volume:e}", cell(*number))
            }
            Self::FlatCell {
                cell: number,
                volume,
                longest_edge,
            } => format!(
                "{} is flat, its volume is {volume:e} and its longest edge {longest_edge:e}",
                cell(*number)
            ),
            Self::DuplicateCells { first, second } => {
                format!("{} and {} have the same vertices", cell(*first), cell(*second))
            }
            Self::NonManifoldFacet { facet, cells } => {
                let (facet, cells) = (all(facet, vertex), all(cells, cell));
                format!("the facet of {facet} belongs to {cells}, more than two")
            }
            Self::OverlappingCells { first, second, facet } => format!(
                "{} and {} lie on the same side of the facet of {}",
                cell(*first),
                cell(*second),
                all(facet, vertex)
            ),
            Self::DuplicateVertices { first, second } => {
                format!("{} and {} have the same position", vertex(*first), vertex(*second))
            }
            Self::HangingVertex {
                vertex: number,
                cell: other,
            } => format!(
                "{} lies on the boundary of {}, which it does not belong to",
                vertex(*number),
                cell(*other)
            ),
            Self::VertexInsideCell {
                vertex: number,
                cell: other,
            } => format!("{} lies inside {}", vertex(*number), cell(*other)),
        }
    }
}

impl std::fmt::Display for MeshError {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let words = self.in_words(&|cell| format!("cell {cell}"), &|vertex| format!("vertex {vertex}"));
        formatter.write_str(&words)
    }
}

impl std::error::Error for MeshError {}
