//! Nodes and simplices as a file has them.

use std::collections::HashMap;

use super::MshError;
use super::cursor::Cursor;
use super::element_types::{ElementType, element_type, simplex};
use super::groups::Groups;
use super::named::{NamedMesh, TaggedFacet, name_facets};
use crate::{MeshError, SimplexMesh, mesh::signed_volume};

/// Coordinates beyond the dimension may differ by this share of the mesh's extent: rounding of what wrote them.
const ALIGNED: f64 = 1e-12;

/// What has been read.
#[derive(Default)]
pub struct Raw {
    tags: Vec<u64>,
    /// Where the tags of the nodes are in the file.
    node_marks: Vec<usize>,
    positions: Vec<[f64; 3]>,
    numbers: HashMap<u64, u32>,
    /// Tags of the nodes of all cells.
    cells: Vec<u64>,
    /// Tags of the cells.
    elements: Vec<u64>,
    /// Where the cells are in the file.
    element_marks: Vec<usize>,
    /// Elements of one dimension less that are in physical groups.
    facets: Vec<TaggedFacet>,
    /// The groups.
    pub groups: Groups,
}

impl Raw {
    /// Reads the position of a node, whose tag was at a mark.
    pub fn add_node(&mut self, tag: u64, mark: usize, cursor: &mut Cursor) -> Result<(), MshError> {
        if self.numbers.insert(tag, self.tags.len() as u32).is_some() {
            let place = cursor.place(mark);
            return Err(MshError::DuplicateNode { tag, place });
        }
        let mut position = [0.0; 3];
        for coordinate in &mut position {
            *coordinate = cursor.real("a coordinate")?;
        }
        self.tags.push(tag);
        self.node_marks.push(mark);
        self.positions.push(position);
        Ok(())
    }

    /// Adds an element at a mark by the tags of its nodes.
    pub fn add_cell(&mut self, tag: u64, mark: usize, nodes: &[u64]) {
        self.elements.push(tag);
        self.element_marks.push(mark);
        self.cells.extend(nodes);
    }

    /// Adds a facet at a mark by the tags of its nodes; nothing where it is in no group (0: none).
    pub fn add_facet(&mut self, element: u64, mark: usize, nodes: &[u64], groups: &[i64]) {
        let groups: Vec<i64> = groups.iter().copied().filter(|&group| group != 0).collect();
        if !groups.is_empty() {
            let nodes = nodes.to_vec();
            self.facets.push(TaggedFacet {
                element,
                mark,
                nodes,
                groups,
            });
        }
    }

    /// The mesh with the groups of its facets; the cursor is that of the file.
    pub fn named_mesh<const D: usize>(&self, cursor: &Cursor) -> Result<NamedMesh<D>, MshError> {
        let (mesh, cells) = self.mesh_and_nodes::<D>(cursor)?;
        let facets = name_facets::<D>(&self.facets, &self.groups, &self.numbers, &cells, cursor)?;
        Ok(NamedMesh { mesh, facets })
    }

    /// The mesh, clockwise triangles turned if all are.
    pub fn mesh<const D: usize>(&self, cursor: &Cursor) -> Result<SimplexMesh<D>, MshError> {
        Ok(self.mesh_and_nodes(cursor)?.0)
    }

    /// The mesh, and the nodes of its cells.
    fn mesh_and_nodes<const D: usize>(&self, cursor: &Cursor) -> Result<(SimplexMesh<D>, Vec<u32>), MshError> {
        if self.cells.is_empty() {
            let (_, name) = simplex(D);
            return Err(MshError::NoCells { name, dimension: D });
        }
        let number = |(place, &tag): (usize, &u64)| {
            let cell = place / (D + 1);
            let unknown = || MshError::UnknownNode {
                tag,
                element: self.elements[cell],
                place: cursor.place(self.element_marks[cell]),
            };
            self.numbers.get(&tag).copied().ok_or_else(unknown)
        };
        let mut cells: Vec<u32> = self.cells.iter().enumerate().map(number).collect::<Result<_, _>>()?;
        self.check_aligned::<D>(&cells, cursor)?;
        let vertices: Vec<[f64; D]> = self
            .positions
            .iter()
            .map(|x| std::array::from_fn(|axis| x[axis]))
            .collect();
        if cells
            .chunks_exact(D + 1)
            .all(|cell| signed_volume(&vertices, cell) < 0.0)
        {
            cells.chunks_exact_mut(D + 1).for_each(|cell| cell.swap(0, 1));
        }
        match SimplexMesh::from_used(&vertices, &cells) {
            Ok(mesh) => Ok((mesh, cells)),
            Err(fault) => Err(self.at_tags(fault, cells, cursor)),
        }
    }

    /// A fault of the mesh in the tags and places of the file: vertices are the nodes that cells name, in their order.
    fn at_tags(&self, fault: MeshError, mut used: Vec<u32>, cursor: &Cursor) -> MshError {
        used.sort_unstable();
        used.dedup();
        let named =
            |what: &str, tags: &[u64], marks: &[usize], number: usize| match (tags.get(number), marks.get(number)) {
                (Some(tag), Some(&mark)) => format!("{what} {tag} ({})", cursor.place(mark)),
                _ => format!("{what} number {number}"),
            };
        let element = |cell: usize| named("element", &self.elements, &self.element_marks, cell);
        let node = |vertex: usize| {
            let number = used.get(vertex).map_or(vertex, |&number| number as usize);
            named("node", &self.tags, &self.node_marks, number)
        };
        MshError::InvalidMesh {
            message: fault.in_words(&element, &node),
            fault,
        }
    }

    /// The vertices agree in the coordinates from D on.
    fn check_aligned<const D: usize>(&self, cells: &[u32], cursor: &Cursor) -> Result<(), MshError> {
        let used = || cells.iter().map(|&vertex| vertex as usize);
        let range = |axis: usize| {
            let coordinates = || used().map(|vertex| self.positions[vertex][axis]);
            coordinates().fold(f64::NEG_INFINITY, f64::max) - coordinates().fold(f64::INFINITY, f64::min)
        };
        let limit = ALIGNED * (0..D).map(range).fold(0.0, f64::max);
        for (axis, name) in ['x', 'y', 'z'].into_iter().enumerate().skip(D) {
            let expected = used().next().map_or(0.0, |first| self.positions[first][axis]);
            let aligned = |&vertex: &usize| (self.positions[vertex][axis] - expected).abs() <= limit;
            if let Some(vertex) = used().find(|vertex| !aligned(vertex)) {
                return Err(MshError::OutOfPlane {
                    tag: self.tags[vertex],
                    place: cursor.place(self.node_marks[vertex]),
                    axis: name,
                    value: self.positions[vertex][axis],
                    expected,
                    dimension: D,
                });
            }
        }
        Ok(())
    }
}

/// What elements are to a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Its cells.
    Cell,
    /// Simplices with straight edges of one dimension less.
    Facet,
    /// What it has no use for.
    Other,
}

/// The type of elements that begin at a mark, and what they are: those of lower dimension are no cells, others refused.
pub fn check_kind<const D: usize>(kind: u64, mark: usize, cursor: &Cursor) -> Result<(ElementType, Role), MshError> {
    let unsupported = |name| MshError::UnsupportedElement {
        kind,
        name,
        dimension: D,
        place: cursor.place(mark),
    };
    let found = element_type(kind).ok_or_else(|| unsupported("unknown"))?;
    let role = match found.dimension {
        _ if kind == simplex(D).0 => Role::Cell,
        dimension if dimension >= D => return Err(unsupported(found.name)),
        dimension if dimension + 1 == D && found.node_count == D => Role::Facet,
        _ => Role::Other,
    };
    Ok((found, role))
}
