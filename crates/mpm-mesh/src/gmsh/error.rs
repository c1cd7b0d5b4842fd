use super::element_types::simplex;
use crate::MeshError;

/// A place in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Place {
    /// Bytes before it.
    pub byte: usize,
    /// Number of the line, from 1, in a text file.
    pub line: Option<usize>,
}

impl std::fmt::Display for Place {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.line {
            Some(line) => write!(formatter, "line {line}"),
            None => write!(formatter, "byte {}", self.byte),
        }
    }
}

/// Why a `.msh` file was not read.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MshError {
    /// The version is neither 2.2 nor 4.1.
    #[error("version {version} of the format, only 2.2 and 4.1 are read")]
    UnsupportedVersion {
        /// As the file has it.
        version: String,
    },
    /// The size of numbers in a binary file is not 8 bytes.
    #[error("numbers of size {size}, only those of 8 bytes are read")]
    UnsupportedDataSize {
        /// As the file has it.
        size: u64,
    },
    /// The file ends too early.
    #[error("the file ends at {place}, where {expected} should follow")]
    Truncated {
        /// Where.
        place: Place,
        /// What should be there.
        expected: &'static str,
    },
    /// Something else stands where something should.
    #[error("{place}: `{found}` stands where {expected} should be")]
    Malformed {
        /// Where.
        place: Place,
        /// What should be there.
        expected: &'static str,
        /// What is there.
        found: String,
    },
    /// There are no nodes or elements.
    #[error("the file has no section ${name}")]
    MissingSection {
        /// `Nodes` or `Elements`.
        name: &'static str,
    },
    /// Two nodes have the same tag.
    #[error("{place}: node {tag} occurs twice")]
    DuplicateNode {
        /// The tag.
        tag: u64,
        /// Where it occurs again.
        place: Place,
    },
    /// An element names a node that there is not.
    #[error("{place}: element {element} names node {tag}, which there is not")]
    UnknownNode {
        /// Tag of the node.
        tag: u64,
        /// Tag of the element.
        element: u64,
        /// Where the element is.
        place: Place,
    },
    /// An element of the mesh's dimension is not a simplex with straight edges, or its type is not known.
    #[error(
        "{place}: elements of type {kind} ({name}) in a mesh of dimension {dimension}, whose cells are {}s with straight edges (type {})",
        simplex(*dimension).1, simplex(*dimension).0
    )]
    UnsupportedElement {
        /// Number of the type.
        kind: u64,
        /// Its name.
        name: &'static str,
        /// D.
        dimension: usize,
        /// Where the element or its block begins.
        place: Place,
    },
    /// There are no simplices of the dimension.
    #[error("the file has no {name}s, the cells of dimension {dimension}")]
    NoCells {
        /// What a cell would be.
        name: &'static str,
        /// D.
        dimension: usize,
    },
    /// An element of a physical group is no facet of a cell.
    #[error("{place}: element {element} of the physical group `{group}` is no facet of a cell")]
    StrayFacet {
        /// Tag of the element.
        element: u64,
        /// Name of the group, or its tag.
        group: String,
        /// Where the element is.
        place: Place,
    },
    /// Vertices differ in a coordinate beyond the dimension.
    #[error(
        "{place}: node {tag} has {axis} = {value}, others {expected}: the mesh does not have dimension {dimension}"
    )]
    OutOfPlane {
        /// Tag of the node.
        tag: u64,
        /// Where the node is.
        place: Place,
        /// `y` or `z`.
        axis: char,
        /// The coordinate.
        value: f64,
        /// The coordinate of the first node.
        expected: f64,
        /// D.
        dimension: usize,
    },
    /// Nodes and elements are not a valid mesh.
    #[error("{message}")]
    InvalidMesh {
        /// What is wrong; elements that are cells, and nodes that belong to some, are numbered in the order of the file.
        fault: MeshError,
        /// The same by the tags of the file, with places.
        message: String,
    },
    /// There are no meshes of the dimension.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}
