//! Facets by the names of their physical groups.

use std::collections::{BTreeMap, HashMap, HashSet};

use super::MshError;
use super::cursor::Cursor;
use super::groups::Groups;
use crate::SimplexMesh;

/// A mesh and the physical groups of its facets.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedMesh<const D: usize> {
    /// The mesh.
    pub mesh: SimplexMesh<D>,
    /// The facets of a group by its name (its tag, where the file names none): vertices of the mesh, D for each facet, in the order of the file. Empty for a group that the file names
    /// and no element is in.
    pub facets: BTreeMap<String, Vec<u32>>,
}

/// An element of one dimension less.
pub struct TaggedFacet {
    /// Its tag.
    pub element: u64,
    /// Where it is in the file.
    pub mark: usize,
    /// Tags of its nodes.
    pub nodes: Vec<u64>,
    /// The groups that it is in.
    pub groups: Vec<i64>,
}

/// Facets by the names of their groups. `numbers` are those of all nodes by their tags, `cells` name nodes by them; vertices of the mesh are the nodes that cells
/// name, in the same order.
pub fn name_facets<const D: usize>(
    facets: &[TaggedFacet],
    groups: &Groups,
    numbers: &HashMap<u64, u32>,
    cells: &[u32],
    cursor: &Cursor,
) -> Result<BTreeMap<String, Vec<u32>>, MshError> {
    let names = groups.named(D - 1).map(|name| (name.to_owned(), Vec::new()));
    let mut named: BTreeMap<String, Vec<u32>> = names.collect();
    if facets.is_empty() {
        return Ok(named);
    }
    let mut vertices: Vec<u32> = cells.to_vec();
    vertices.sort_unstable();
    vertices.dedup();
    let mut known: HashSet<Vec<u32>> = HashSet::new();
    for cell in cells.chunks_exact(D + 1) {
        for opposite in 0..=D {
            let others = cell.iter().enumerate().filter(|&(place, _)| place != opposite);
            known.insert(sorted(others.map(|(_, &node)| node)));
        }
    }
    for facet in facets {
        let (element, place) = (facet.element, || cursor.place(facet.mark));
        let number = |&tag: &u64| {
            let unknown = || MshError::UnknownNode {
                tag,
                element,
                place: place(),
            };
            numbers.get(&tag).copied().ok_or_else(unknown)
        };
        let nodes: Vec<u32> = facet.nodes.iter().map(number).collect::<Result<_, _>>()?;
        let is_known = known.contains(&sorted(nodes.iter().copied()));
        for &group in &facet.groups {
            let name = groups.name(D - 1, group);
            if !is_known {
                return Err(MshError::StrayFacet {
                    element,
                    group: name,
                    place: place(),
                });
            }
            let vertex = |node: &u32| vertices.partition_point(|vertex| vertex < node) as u32;
            named.entry(name).or_default().extend(nodes.iter().map(vertex));
        }
    }
    Ok(named)
}

fn sorted(nodes: impl Iterator<Item = u32>) -> Vec<u32> {
    let mut nodes: Vec<u32> = nodes.collect();
    nodes.sort_unstable();
    nodes
}
