//! The virtual stress of tractions.

use std::collections::BTreeMap;

use mpm_core::VirtualStress;
use mpm_mesh::{BoundaryFacet, CellSearch, SimplexMesh};
use mpm_tensor::{Matrix, SymmetricEigen};

/// A facet of the boundary with the force per area that acts on it at its vertices, linear between them, 0 where it is free.
pub(super) struct LoadedFacet<const D: usize> {
    pub facet: BoundaryFacet<D>,
    pub tractions: [[f64; D]; D],
}

/// What is left of σ̂ at vertices so many edges from the loaded facets; nothing farther away. Whole where the nodes of the boundary and of the outer layer reach.
const SHARES: [f64; 5] = [1.0, 1.0, 1.0, 2.0 / 3.0, 1.0 / 3.0];

/// Least eigenvalue of Σ A n nᵀ / Σ A of the facets at a vertex at which their normals say something of the stress along its eigenvector: normals that differ by less than 26° are one.
const LEAST_SPREAD: f64 = 0.05;

/// σ̂, linear in the cells of a mesh.
struct InCells<const D: usize> {
    search: CellSearch<D>,
    /// By vertex.
    stresses: Vec<Matrix<D>>,
    /// Positions of the vertices of the cells in which it is not 0.
    nodes: Vec<[f64; D]>,
    /// How far outside of the mesh particles may be.
    reach: f64,
}

impl<const D: usize> VirtualStress<D> for InCells<D> {
    fn at(&self, x: &[f64; D]) -> Matrix<D> {
        let located = self.search.locate(x, None);
        let Some(place) = located.or_else(|| Some(self.search.nearest(x, self.reach)?.located)) else {
            return Matrix::ZERO;
        };
        let first = 1.0 - place.barycentric.iter().sum::<f64>();
        let shares = std::iter::once(first).chain(place.barycentric);
        let vertices = self.search.mesh().cell(place.cell as usize).iter();
        let each = vertices
            .zip(shares)
            .map(|(&vertex, share)| self.stresses[vertex as usize] * share);
        each.fold(Matrix::ZERO, |sum, stress| sum + stress)
    }

    fn nodes(&self) -> &[[f64; D]] {
        &self.nodes
    }
}

/// σ̂ with these values at the vertices of the whole mesh.
pub(super) fn in_cells<const D: usize>(
    whole: &SimplexMesh<D>,
    stresses: Vec<Matrix<D>>,
) -> impl VirtualStress<D> + use<D> {
    let stressed = |cell: &&[u32]| cell.iter().any(|&vertex| stresses[vertex as usize] != Matrix::ZERO);
    let mut vertices: Vec<u32> = whole.cells().filter(stressed).flatten().copied().collect();
    vertices.sort_unstable();
    vertices.dedup();
    InCells {
        nodes: vertices
            .iter()
            .map(|&vertex| whole.vertices()[vertex as usize])
            .collect(),
        reach: whole.edge_lengths().longest,
        search: CellSearch::new(whole.clone()),
        stresses,
    }
}

/// σ̂ at the vertices of the whole mesh: at those of loaded facets, the least with σ̂ n = t; from there inwards and outwards as it is, and at free facets with σ̂ n = 0.
pub(super) fn virtual_stresses<const D: usize>(whole: &SimplexMesh<D>, facets: &[LoadedFacet<D>]) -> Vec<Matrix<D>> {
    let mut at_vertices: BTreeMap<u32, Vec<Load<D>>> = BTreeMap::new();
    for LoadedFacet { facet, tractions } in facets {
        for (vertex, traction) in facet.vertices.into_iter().zip(tractions) {
            at_vertices.entry(vertex).or_default().push((facet, traction));
        }
    }
    let adapted = |vertex: u32, stress: Matrix<D>| match at_vertices.get(&vertex) {
        Some(facets) => with_tractions(stress, facets),
        None => stress,
    };
    let neighbours = whole.vertex_neighbours();
    let mut stresses = vec![Matrix::ZERO; whole.vertices().len()];
    let mut rings = vec![usize::MAX; whole.vertices().len()];
    let loaded = facets.iter().filter(|loaded| loaded.tractions != [[0.0; D]; D]);
    let mut ring: Vec<u32> = loaded.flat_map(|loaded| loaded.facet.vertices).collect();
    for number in 0..SHARES.len() {
        ring.sort_unstable();
        ring.dedup();
        let before = |vertex: &&u32| number > 0 && rings[**vertex as usize] == number - 1;
        let values: Vec<Matrix<D>> = ring
            .iter()
            .map(|&vertex| {
                let near = neighbours.get(vertex as usize).iter().filter(before);
                let (sum, count) = near.fold((Matrix::ZERO, 0.0), |(sum, count), &other| {
                    (sum + stresses[other as usize], count + 1.0)
                });
                adapted(vertex, sum * (1.0 / f64::max(count, 1.0)))
            })
            .collect();
        for (&vertex, value) in ring.iter().zip(values) {
            (rings[vertex as usize], stresses[vertex as usize]) = (number, value);
        }
        let next = ring.iter().flat_map(|&vertex| neighbours.get(vertex as usize));
        ring = next
            .copied()
            .filter(|&vertex| rings[vertex as usize] == usize::MAX)
            .collect();
    }
    for (stress, &number) in stresses.iter_mut().zip(&rings) {
        *stress *= SHARES.get(number).copied().unwrap_or(0.0);
    }
    stresses
}

/// A facet at a vertex, and t there.
type Load<'a, const D: usize> = (&'a BoundaryFacet<D>, &'a [f64; D]);

/// The symmetric stress nearest to `prior` with σ̂ n = t at these facets, in the mean where they contradict each other.
fn with_tractions<const D: usize>(prior: Matrix<D>, facets: &[Load<D>]) -> Matrix<D> {
    let total: f64 = facets.iter().map(|(facet, _)| facet.area).sum();
    let (mut normals, mut tractions) = (Matrix::ZERO, Matrix::ZERO);
    for &(facet, traction) in facets {
        normals += Matrix::outer(&facet.normal, &facet.normal) * (facet.area / total);
        tractions += Matrix::outer(traction, &facet.normal) * (facet.area / total);
    }
    let Some(SymmetricEigen { values, vectors }) = SymmetricEigen::new(&normals) else {
        return prior;
    };
    // In the basis of the eigenvectors: (σ̂ N)_ab = σ̂_ab λ_b = (Σ A t nᵀ)_ab.
    let rotated = |matrix: &Matrix<D>| vectors.transpose() * *matrix * vectors;
    let (prior, wanted) = (rotated(&prior), rotated(&tractions));
    let known = |a: usize| values[a] > LEAST_SPREAD;
    let entry = |a: usize, b: usize| match (known(a), known(b)) {
        (true, true) => 0.5 * (wanted.0[a][b] / values[b] + wanted.0[b][a] / values[a]),
        (false, true) => wanted.0[a][b] / values[b],
        (true, false) => wanted.0[b][a] / values[a],
        (false, false) => prior.0[a][b],
    };
    vectors * Matrix::from_fn(entry) * vectors.transpose()
}

#[cfg(test)]
pub(super) mod tests {
    use mpm_tensor::vector as algebra;

    use super::*;

    pub fn under<const D: usize>(stress: Matrix<D>) -> impl Fn(BoundaryFacet<D>) -> LoadedFacet<D> {
        move |facet| LoadedFacet {
            tractions: [stress.apply(&facet.normal); D],
            facet,
        }
    }

    fn facet<const D: usize>(normal: [f64; D], area: f64) -> BoundaryFacet<D> {
        BoundaryFacet {
            cell: 0,
            opposite: 0,
            vertices: [0; D],
            normal,
            area,
        }
    }

    /// Where normals span space the stress is known, where they do not what acts on the facets is, and the rest is what it was.
    #[test]
    fn stresses_have_the_tractions_of_their_facets() {
        let (stress, prior) = (
            Matrix([[2.0, -0.7, 0.3], [-0.7, 0.5, 1.1], [0.3, 1.1, -0.4]]),
            Matrix::diagonal(&[7.0, 8.0, 9.0]),
        );
        let normals = [[1.0, 0.0, 0.0], [0.0, 0.6, 0.8], [0.0, -0.8, 0.6]];
        let facets: Vec<_> = normals.map(|normal| under(stress)(facet(normal, 0.1))).into();
        let all: Vec<Load<3>> = facets
            .iter()
            .map(|loaded| (&loaded.facet, &loaded.tractions[0]))
            .collect();
        assert!((with_tractions(prior, &all) - stress).maximum_norm() < 1e-12);
        for known in 1..3 {
            let found = with_tractions(prior, &all[..known]);
            assert!((found - found.transpose()).maximum_norm() < 1e-12);
            for (facet, traction) in &all[..known] {
                let error = algebra::distance(&found.apply(&facet.normal), traction);
                assert!(error < 1e-12, "{error}");
            }
            let free = normals[2];
            let left = algebra::dot(&free, &found.apply(&free));
            assert!((left - algebra::dot(&free, &prior.apply(&free))).abs() < 1e-12);
        }
    }
}
