//! Tractions on facets of a mesh, as a [virtual stress](super::virtual_stress) of the particles and forces at nodes.

use std::collections::{BTreeMap, BTreeSet};

use mpm_core::{Amplitude, NodeForces};
use mpm_mesh::{BoundaryFacet, MeshBasis, SimplexMesh};
use mpm_tensor::vector as algebra;

use super::virtual_stress::{LoadedFacet, in_cells, virtual_stresses};

/// A facet by its cell and the place of the vertex opposite.
type Place = (u32, usize);

fn place<const D: usize>(facet: &BoundaryFacet<D>) -> Place {
    (facet.cell, facet.opposite)
}

/// t at the vertices of facets.
type AtFacets<const D: usize> = BTreeMap<Place, [[f64; D]; D]>;

/// The tractions of a scene.
#[derive(Default)]
pub(super) struct Tractions<const D: usize> {
    /// Those with one amplitude together: t at the vertices by facet.
    loads: Vec<(Amplitude, AtFacets<D>)>,
    /// Facets at which something else says what happens.
    held: BTreeSet<Place>,
}

impl<const D: usize> Tractions<D> {
    /// Something holds a facet, or lets it slide: t is not known there.
    pub fn hold(&mut self, facet: &BoundaryFacet<D>) {
        self.held.insert(place(facet));
    }

    /// A force per area more, by the vertices of a facet.
    pub fn add(&mut self, amplitude: &Amplitude, facet: &BoundaryFacet<D>, tractions: &[[f64; D]; D]) {
        let known = self.loads.iter().position(|(other, _)| other == amplitude);
        let number = known.unwrap_or_else(|| {
            self.loads.push((amplitude.clone(), BTreeMap::new()));
            self.loads.len() - 1
        });
        let sums = self.loads[number].1.entry(place(facet)).or_insert([[0.0; D]; D]);
        for (sum, traction) in sums.iter_mut().zip(tractions) {
            algebra::accumulate(sum, 1.0, traction);
        }
    }

    /// All of them, those with one amplitude together.
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
        let of_load = |(amplitude, tractions): &(Amplitude, AtFacets<D>)| {
            let known =
                |facet: &&BoundaryFacet<D>| tractions.contains_key(&place(facet)) || !self.held.contains(&place(facet));
            let loaded = |facet: &BoundaryFacet<D>| LoadedFacet {
                facet: *facet,
                tractions: tractions.get(&place(facet)).copied().unwrap_or([[0.0; D]; D]),
            };
            let facets: Vec<_> = boundary.iter().filter(known).map(loaded).collect();
            node_forces(&basis, (inner, whole), &facets, amplitude.clone())
        };
        Ok(self.loads.iter().map(of_load).collect())
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
    amplitude: Amplitude,
) -> NodeForces<D> {
    let stresses = virtual_stresses(whole, facets);
    let (facet_rule, cell_rule) = (simplex_rule(D - 1), simplex_rule(D));
    let mut at_nodes: BTreeMap<u32, [f64; D]> = BTreeMap::new();
    let mut push = |x: &[f64; D], force: &[f64; D]| {
        for weight in basis.weights_at(x).unwrap_or_default() {
            let sum = at_nodes.entry(weight.vertex).or_insert([0.0; D]);
            algebra::accumulate(sum, weight.entry.weight, force);
        }
    };
    for LoadedFacet { facet, tractions } in facets {
        let corners = facet.vertices;
        let missing = std::array::from_fn(|k| {
            algebra::subtract(&tractions[k], &stresses[corners[k] as usize].apply(&facet.normal))
        });
        if missing == [[0.0; D]; D] {
            continue;
        }
        for (shares, weight) in &facet_rule {
            let x = mean(shares, corners.map(|vertex| inner.vertices()[vertex as usize]));
            push(&x, &algebra::scale(&mean(shares, missing), weight * facet.area));
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
        for (shares, weight) in &cell_rule {
            let x = mean(shares, vertices.iter().map(|&vertex| inner.vertices()[vertex as usize]));
            push(&x, &algebra::scale(&divergence, weight * inner.volume(cell)));
        }
    }
    let position = |vertex: u32| basis.mesh().vertices()[vertex as usize];
    let loaded = at_nodes.into_iter().filter(|(_, force)| *force != [0.0; D]);
    NodeForces {
        forces: loaded.map(|(vertex, force)| (position(vertex), force)).collect(),
        stress: Some(Box::new(in_cells(whole, stresses))),
        amplitude,
    }
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
    use mpm_tensor::Matrix;

    use super::super::held_facets::tests::with_rim;
    use super::super::virtual_stress::tests::under;
    use super::*;

    /// Σ f and Σ f xᵀ of the forces at nodes, those of ∫ σ̂ ∇w_i dV with them: Σ_i ∇w_i = 0 and Σ_i x_i ∇w_iᵀ = I leave ∫ σ̂ dV.
    fn force_and_moment(
        basis: &MeshBasis<2>,
        (inner, whole): (&SimplexMesh<2>, &SimplexMesh<2>),
        facets: &[LoadedFacet<2>],
    ) -> ([f64; 2], Matrix<2>) {
        let (mut force, mut moment) = ([0.0; 2], Matrix::ZERO);
        for (x, f) in node_forces(basis, (inner, whole), facets, Amplitude::default()).forces {
            algebra::accumulate(&mut force, 1.0, &f);
            moment += Matrix::outer(&f, &x);
        }
        let stresses = virtual_stresses(whole, facets);
        for (number, vertices) in inner.cells().enumerate() {
            for &vertex in vertices {
                moment += stresses[vertex as usize] * (inner.volume(number) / 3.0);
            }
        }
        (force, moment)
    }

    /// Σ f = ∮ t dA and Σ f xᵀ = ∮ t xᵀ dA, also where t is linear along facets.
    #[test]
    #[allow(non_snake_case)]
    fn linear_tractions_have_their_force_and_moments() {
        let (inner, whole, _) = with_rim();
        let basis = MeshBasis::new(&whole).expect("a basis");
        let L = Matrix([[0.3, -1.1], [2.0, 0.4]]);
        let position = |vertex: u32| inner.vertices()[vertex as usize];
        let at = |facet: &BoundaryFacet<2>| {
            facet
                .vertices
                .map(|vertex| algebra::add_scaled(&L.apply(&position(vertex)), 0.7, &facet.normal))
        };
        let loaded = |facet| LoadedFacet {
            tractions: at(&facet),
            facet,
        };
        let facets: Vec<_> = inner.boundary().into_iter().map(loaded).collect();
        let (mut force, mut moment) = force_and_moment(&basis, (&inner, &whole), &facets);
        // Simpson's rule.
        for LoadedFacet { facet, tractions } in &facets {
            let [a, b] = facet.vertices.map(position);
            let middle = |a: &[f64; 2], b: &[f64; 2]| algebra::scale(&algebra::add_scaled(a, 1.0, b), 0.5);
            let places = [(a, tractions[0], 1.0), (b, tractions[1], 1.0)];
            let half = (middle(&a, &b), middle(&tractions[0], &tractions[1]), 4.0);
            for (x, t, share) in places.into_iter().chain([half]) {
                algebra::accumulate(&mut force, -share * facet.area / 6.0, &t);
                moment += Matrix::outer(&t, &x) * (-share * facet.area / 6.0);
            }
        }
        assert!(algebra::norm(&force) < 1e-12, "{force:?}");
        assert!(moment.maximum_norm() < 1e-12, "{moment:?}");
    }

    /// Patch test: under t = σ n on the whole boundary, forces and their first moments are those of a constant stress, Σ f = 0 and Σ f xᵀ = V σ.
    #[test]
    #[allow(non_snake_case)]
    fn tractions_of_a_constant_stress_are_in_equilibrium() {
        let (inner, whole, _) = with_rim();
        let stress = Matrix([[2.0, -0.7], [-0.7, 0.5]]);
        let facets: Vec<_> = inner.boundary().into_iter().map(under(stress)).collect();
        for width in [KernelWidth::LongestEdge, KernelWidth::Local] {
            let basis = MeshBasis::new(&whole).expect("a basis").with_kernel_width(width);
            let (force, moment) = force_and_moment(&basis, (&inner, &whole), &facets);
            let V = inner.total_volume();
            assert!(algebra::norm(&force) < 1e-12, "{force:?}");
            assert!((moment - stress * V).maximum_norm() < 1e-12, "{moment:?}");
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
