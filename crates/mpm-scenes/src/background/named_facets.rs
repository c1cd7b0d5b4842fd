//! Facets by the vertices that groups name.

use std::collections::{HashMap, HashSet};

use mpm_mesh::{BoundaryFacet, SimplexMesh};
use mpm_tensor::vector::dot;

/// The vertices of a facet in ascending order.
fn key(facet: &[u32]) -> Vec<u32> {
    let mut facet = facet.to_vec();
    facet.sort_unstable();
    facet
}

/// The facets of a group, each once.
pub(crate) fn facet_keys<const D: usize>(facets: &[u32]) -> HashSet<Vec<u32>> {
    facets.chunks_exact(D.max(1)).map(key).collect()
}

/// The facets of the boundary that a group names, by any order of their vertices.
pub(crate) fn named_facets<const D: usize>(
    inner: &SimplexMesh<D>,
    facets: &[u32],
) -> impl Iterator<Item = BoundaryFacet<D>> {
    let named = facet_keys::<D>(facets);
    let boundary = inner.boundary().into_iter();
    boundary.filter(move |facet| named.contains(&key(&facet.vertices)))
}

/// Cosine of the angle, 70°, by which facets that go over into each other turn at most. Those of a polygon for a curve turn by less, those at a corner of a box by more.
const CORNER: f64 = 0.342;

/// The facets of a group in parts that meet at corners, each in the order of the group; one that is inside the mesh is in none.
pub(crate) fn smooth_parts<const D: usize>(inner: &SimplexMesh<D>, facets: &[u32]) -> Vec<Vec<u32>> {
    let boundary: Vec<BoundaryFacet<D>> = named_facets(inner, facets).collect();
    let ridges = |facet: &BoundaryFacet<D>| {
        let vertices = key(&facet.vertices);
        let without = |left_out: &u32| vertices.iter().copied().filter(|vertex| vertex != left_out).collect();
        vertices.iter().map(without).collect::<Vec<Vec<u32>>>()
    };
    let mut at_ridges: HashMap<Vec<u32>, Vec<usize>> = HashMap::new();
    for (number, facet) in boundary.iter().enumerate() {
        for ridge in ridges(facet) {
            at_ridges.entry(ridge).or_default().push(number);
        }
    }
    let mut part_of: HashMap<Vec<u32>, usize> = HashMap::new();
    let mut parts: Vec<Vec<u32>> = Vec::new();
    for start in 0..boundary.len() {
        let mut reached = vec![start];
        while let Some(facet) = reached.pop().map(|number| &boundary[number]) {
            if part_of.contains_key(&key(&facet.vertices)) {
                continue;
            }
            part_of.insert(key(&facet.vertices), parts.len());
            let joined = ridges(facet).into_iter().flat_map(|ridge| &at_ridges[&ridge]);
            reached.extend(joined.filter(|&&other| dot(&facet.normal, &boundary[other].normal) > CORNER));
        }
        let own = part_of[&key(&boundary[start].vertices)] + 1;
        parts.resize(parts.len().max(own), Vec::new());
    }
    for facet in facets.chunks_exact(D.max(1)) {
        if let Some(&part) = part_of.get(&key(facet)) {
            parts[part].extend(facet);
        }
    }
    parts
}
