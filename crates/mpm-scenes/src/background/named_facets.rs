//! Facets by the vertices that groups name.

use std::collections::HashSet;

use mpm_mesh::{BoundaryFacet, SimplexMesh};

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
