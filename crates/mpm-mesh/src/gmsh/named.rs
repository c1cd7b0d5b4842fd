//! Facets by the names of their physical groups.

use std::collections::{BTreeMap, HashMap, HashSet};

use super::MshError;
use super::groups::Groups;
use crate::SimplexMesh;

/// A mesh and the physical groups of its facets.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedMesh<const D: usize> {
    /// The mesh.
    pub mesh: SimplexMesh<D>,
    /// The facets of a group by its name (its tag, where the file names none): vertices of the mesh, D for each facet, in the order of the file.
    pub facets: BTreeMap<String, Vec<u32>>,
}

/// An element of one dimension less.
pub struct TaggedFacet {
    /// Its tag.
    pub element: u64,
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
) -> Result<BTreeMap<String, Vec<u32>>, MshError> {
    let mut named: BTreeMap<String, Vec<u32>> = BTreeMap::new();
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
        let nodes: Option<Vec<u32>> = facet.nodes.iter().map(|tag| numbers.get(tag).copied()).collect();
        let nodes = nodes.filter(|nodes| known.contains(&sorted(nodes.iter().copied())));
        for &group in &facet.groups {
            let name = groups.name(D - 1, group);
            let Some(nodes) = &nodes else {
                let element = facet.element;
                return Err(MshError::StrayFacet { element, group: name });
            };
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
