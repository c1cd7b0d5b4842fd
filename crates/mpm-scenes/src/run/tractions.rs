//! Tractions on facets of a mesh, as a virtual stress of the particles and forces at nodes.

use std::collections::{BTreeMap, BTreeSet};

use mpm_core::{NodeForces, VirtualStress};
use mpm_mesh::{BoundaryFacet, CellSearch, Lists, MeshBasis, SimplexMesh};
use mpm_tensor::vector as algebra;
use mpm_tensor::{Matrix, SymmetricEigen};

use crate::population::Population;

/// A facet by its cell and the place of the vertex opposite.
type Place = (u32, usize);

fn place<const D: usize>(facet: &BoundaryFacet<D>) -> Place {
    (facet.cell, facet.opposite)
}

/// The tractions of a scene.
#[derive(Default)]
pub(super) struct Tractions<const D: usize> {
    /// The bits of the time over which they grow, and t by facet.
    loads: BTreeMap<u64, BTreeMap<Place, [f64; D]>>,
    /// Facets at which something else says what happens.
    held: BTreeSet<Place>,
}

/// What bodies fill of the cells of a mesh.
pub(super) struct Filled<'a, const D: usize> {
    mesh: &'a SimplexMesh<D>,
    vertex_cells: Lists,
    /// Volume of the particles in each cell.
    volumes: Vec<f64>,
}

impl<'a, const D: usize> Filled<'a, D> {
    /// With these particles.
    pub fn new(mesh: &'a SimplexMesh<D>, population: &Population<D>) -> Self {
        let search = CellSearch::new(mesh.clone());
        let (mut volumes, mut near) = (vec![0.0; mesh.cell_count()], None);
        let sizes = population.volumes.iter().zip(&population.stretches);
        for (x, (volume, stretch)) in population.positions.iter().zip(sizes) {
            near = search.locate(x, near).map(|place| place.cell);
            if let Some(cell) = near {
                volumes[cell as usize] += volume * stretch.powi(D as i32);
            }
        }
        Self {
            mesh,
            vertex_cells: mesh.vertex_cells(),
            volumes,
        }
    }

    /// Whether a body is at a facet: it fills more than half of the cells that have a vertex of it.
    pub fn is_touched(&self, facet: &BoundaryFacet<D>) -> bool {
        let at_vertices = facet
            .vertices
            .iter()
            .flat_map(|&vertex| self.vertex_cells.get(vertex as usize));
        let cells: BTreeSet<usize> = at_vertices.map(|&cell| cell as usize).collect();
        let sum = |volume: &dyn Fn(usize) -> f64| cells.iter().map(|&cell| volume(cell)).sum::<f64>();
        sum(&|cell| self.volumes[cell]) > 0.5 * sum(&|cell| self.mesh.volume(cell))
    }
}

impl<const D: usize> Tractions<D> {
    /// Something holds a facet, or lets it slide: t is not known there.
    pub fn hold(&mut self, facet: &BoundaryFacet<D>) {
        self.held.insert(place(facet));
    }

    /// A force per area more, which grows over the time `ramp` ≥ 0.
    pub fn add(&mut self, ramp: f64, facet: &BoundaryFacet<D>, traction: &[f64; D]) {
        let load = self.loads.entry(ramp.abs().to_bits()).or_default();
        algebra::accumulate(load.entry(place(facet)).or_insert([0.0; D]), 1.0, traction);
    }

    /// All of them, those that grow alike together.
    pub fn forces<E>(
        &self,
        basis: impl FnOnce() -> Result<MeshBasis<D>, E>,
        inner: &SimplexMesh<D>,
        whole: &SimplexMesh<D>,
    ) -> Result<Vec<NodeForces<D>>, E> {
        if self.loads.is_empty() {
            return Ok(Vec::new());
        }
        let (basis, boundary) = (basis()?, inner.boundary());
        let of_load = |(&ramp, tractions): (&u64, &BTreeMap<Place, [f64; D]>)| {
            let known =
                |facet: &&BoundaryFacet<D>| tractions.contains_key(&place(facet)) || !self.held.contains(&place(facet));
            let loaded = |facet: &BoundaryFacet<D>| LoadedFacet {
                facet: *facet,
                traction: tractions.get(&place(facet)).copied().unwrap_or([0.0; D]),
            };
            let facets: Vec<_> = boundary.iter().filter(known).map(loaded).collect();
            node_forces(&basis, (inner, whole), &facets, f64::from_bits(ramp))
        };
        Ok(self.loads.iter().map(of_load).collect())
    }
}

/// A facet of the boundary with the force per area that acts on it, 0 where it is free.
struct LoadedFacet<const D: usize> {
    facet: BoundaryFacet<D>,
    traction: [f64; D],
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

/// The tractions t of a boundary as σ̂ and forces at nodes: with any σ̂ that is continuous in Ω
///
/// ∫_∂Ω w_i t dA = ∫_Ω σ̂ ∇w_i dV + ∫_Ω w_i div σ̂ dV + ∫_∂Ω w_i (t − σ̂ n) dA.
///
/// The first term becomes a sum over particles, as the forces of their stresses are, so that errors cancel where σ̂ is their stress; the others are integrals, and the smaller the better σ̂ n is t. Given et al. (2024, doi 10.1007/s40571-024-00793-0) have a
/// virtual stress outside of the body. `facets` are those of the boundary of `inner` at which t is known; at the others what holds the body takes the third term up.
fn node_forces<const D: usize>(
    basis: &MeshBasis<D>,
    (inner, whole): (&SimplexMesh<D>, &SimplexMesh<D>),
    facets: &[LoadedFacet<D>],
    ramp: f64,
) -> NodeForces<D> {
    let stresses = virtual_stresses(whole, facets);
    let mut at_nodes: BTreeMap<u32, [f64; D]> = BTreeMap::new();
    let mut push = |x: &[f64; D], force: &[f64; D]| {
        for weight in basis.weights_at(x).unwrap_or_default() {
            let sum = at_nodes.entry(weight.vertex).or_insert([0.0; D]);
            algebra::accumulate(sum, weight.entry.weight, force);
        }
    };
    for LoadedFacet { facet, traction } in facets {
        let corners = facet.vertices;
        let missing =
            corners.map(|vertex| algebra::subtract(traction, &stresses[vertex as usize].apply(&facet.normal)));
        if missing.iter().all(|force| *force == [0.0; D]) {
            continue;
        }
        for (shares, weight) in simplex_rule(D - 1) {
            let x = mean(&shares, corners.map(|vertex| inner.vertices()[vertex as usize]));
            push(&x, &algebra::scale(&mean(&shares, missing), weight * facet.area));
        }
    }
    for cell in 0..inner.cell_count() {
        let (vertices, frame) = (inner.cell(cell), inner.frame(cell));
        let mut divergence = [0.0; D];
        for (k, &vertex) in vertices.iter().enumerate() {
            algebra::accumulate(
                &mut divergence,
                1.0,
                &stresses[vertex as usize].apply(&frame.gradient(k)),
            );
        }
        if divergence == [0.0; D] {
            continue;
        }
        for (shares, weight) in simplex_rule(D) {
            let x = mean(
                &shares,
                vertices.iter().map(|&vertex| inner.vertices()[vertex as usize]),
            );
            push(&x, &algebra::scale(&divergence, weight * inner.volume(cell)));
        }
    }
    let position = |vertex: u32| basis.mesh().vertices()[vertex as usize];
    let loaded = at_nodes.into_iter().filter(|(_, force)| *force != [0.0; D]);
    NodeForces {
        forces: loaded.map(|(vertex, force)| (position(vertex), force)).collect(),
        stress: Some(Box::new(in_cells(whole, stresses))),
        ramp,
    }
}

fn in_cells<const D: usize>(whole: &SimplexMesh<D>, stresses: Vec<Matrix<D>>) -> InCells<D> {
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
fn virtual_stresses<const D: usize>(whole: &SimplexMesh<D>, facets: &[LoadedFacet<D>]) -> Vec<Matrix<D>> {
    let mut at_vertices: BTreeMap<u32, Vec<&LoadedFacet<D>>> = BTreeMap::new();
    for loaded in facets {
        for vertex in loaded.facet.vertices {
            at_vertices.entry(vertex).or_default().push(loaded);
        }
    }
    let adapted = |vertex: u32, stress: Matrix<D>| match at_vertices.get(&vertex) {
        Some(facets) => with_tractions(stress, facets),
        None => stress,
    };
    let neighbours = whole.vertex_neighbours();
    let mut stresses = vec![Matrix::ZERO; whole.vertices().len()];
    let mut rings = vec![usize::MAX; whole.vertices().len()];
    let loaded = facets.iter().filter(|loaded| loaded.traction != [0.0; D]);
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

/// The symmetric stress nearest to `prior` with σ̂ n = t at these facets, in the mean where they contradict each other.
fn with_tractions<const D: usize>(prior: Matrix<D>, facets: &[&LoadedFacet<D>]) -> Matrix<D> {
    let total: f64 = facets.iter().map(|loaded| loaded.facet.area).sum();
    let (mut normals, mut tractions) = (Matrix::ZERO, Matrix::ZERO);
    for LoadedFacet { facet, traction } in facets.iter().copied() {
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

/// Σ_k λ_k c_k.
fn mean<const D: usize>(shares: &[f64], corners: impl IntoIterator<Item = [f64; D]>) -> [f64; D] {
    let mut sum = [0.0; D];
    for (share, corner) in shares.iter().zip(corners) {
        algebra::accumulate(&mut sum, *share, &corner);
    }
    sum
}

/// Barycentric coordinates and weights, of sum one, of points in a simplex of so many dimensions: three points of Gauss's along each axis of a cube that is folded to the simplex (conical product, Stroud 1971). Exact up to degree three.
fn simplex_rule(dimensions: usize) -> Vec<(Vec<f64>, f64)> {
    let lean = 0.5 * 0.6_f64.sqrt();
    let line = [(0.5 - lean, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.5 + lean, 5.0 / 18.0)];
    // Shares so far, and what they leave of one.
    let mut points = vec![(Vec::new(), 1.0, 1.0)];
    for axis in 0..dimensions {
        let rest = (dimensions - axis) as f64;
        let split = |(shares, left, weight): &(Vec<f64>, f64, f64)| {
            line.map(|(u, line_weight)| {
                let shares = shares.iter().copied().chain([left * u]).collect();
                let weight = weight * line_weight * rest * (1.0 - u).powi(dimensions as i32 - axis as i32 - 1);
                (shares, left * (1.0 - u), weight)
            })
        };
        points = points.iter().flat_map(split).collect();
    }
    let closed = |(mut shares, left, weight): (Vec<f64>, f64, f64)| {
        shares.push(left);
        (shares, weight)
    };
    points.into_iter().map(closed).collect()
}

#[cfg(test)]
mod tests {
    use mpm_mesh::KernelWidth;

    use super::super::held_facets::tests::with_rim;
    use super::*;

    fn under<const D: usize>(stress: Matrix<D>) -> impl Fn(BoundaryFacet<D>) -> LoadedFacet<D> {
        move |facet| LoadedFacet {
            facet,
            traction: stress.apply(&facet.normal),
        }
    }

    /// Patch test: under t = σ n on the whole boundary, forces and their first moments, those of ∫ σ̂ ∇w_i dV with them, are those of a constant stress, Σ f = 0 and Σ f xᵀ = V σ.
    #[test]
    #[allow(non_snake_case)]
    fn tractions_of_a_constant_stress_are_in_equilibrium() {
        let (inner, whole, _) = with_rim();
        let stress = Matrix([[2.0, -0.7], [-0.7, 0.5]]);
        let facets: Vec<_> = inner.boundary().into_iter().map(under(stress)).collect();
        for width in [KernelWidth::LongestEdge, KernelWidth::Local] {
            let basis = MeshBasis::new(&whole).expect("a basis").with_kernel_width(width);
            let (mut force, mut moment) = ([0.0; 2], Matrix::ZERO);
            for (x, f) in node_forces(&basis, (&inner, &whole), &facets, 0.0).forces {
                algebra::accumulate(&mut force, 1.0, &f);
                moment += Matrix::outer(&f, &x);
            }
            // Σ_i ∇w_i = 0 and Σ_i x_i ∇w_iᵀ = I.
            let stresses = virtual_stresses(&whole, &facets);
            for (number, vertices) in inner.cells().enumerate() {
                for &vertex in vertices {
                    moment += stresses[vertex as usize] * (inner.volume(number) / 3.0);
                }
            }
            let V = inner.total_volume();
            assert!(algebra::norm(&force) < 1e-12, "{force:?}");
            assert!((moment - stress * V).maximum_norm() < 1e-12, "{moment:?}");
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
        let all: Vec<&LoadedFacet<3>> = facets.iter().collect();
        assert!((with_tractions(prior, &all) - stress).maximum_norm() < 1e-12);
        for known in 1..3 {
            let found = with_tractions(prior, &all[..known]);
            assert!((found - found.transpose()).maximum_norm() < 1e-12);
            for loaded in &all[..known] {
                let error = algebra::distance(&found.apply(&loaded.facet.normal), &loaded.traction);
                assert!(error < 1e-12, "{error}");
            }
            let free = normals[2];
            let left = algebra::dot(&free, &found.apply(&free));
            assert!((left - algebra::dot(&free, &prior.apply(&free))).abs() < 1e-12);
        }
    }

    /// ∫ Π λ_k^{e_k} over a simplex of volume one is n! Π e_k! / (n + Σ e_k)!.
    #[test]
    fn the_rule_integrates_cubes() {
        let factorial = |n: usize| (1..=n).product::<usize>() as f64;
        for n in 0..4 {
            for degree in 0..4 {
                for (first, last) in [(degree, 0), (0, degree), (degree / 2, degree - degree / 2)] {
                    let exact = match n {
                        0 => 1.0,
                        _ => factorial(n) * factorial(first) * factorial(last) / factorial(n + degree),
                    };
                    let of_point = |(shares, weight): (Vec<f64>, f64)| {
                        weight * shares[0].powi(first as i32) * shares[n].powi(last as i32)
                    };
                    let sum: f64 = simplex_rule(n).into_iter().map(of_point).sum();
                    assert!((sum - exact).abs() < 1e-14, "{n}: {first}, {last}: {sum} for {exact}");
                }
            }
        }
    }
}
