//! Facets that hold, move or let slide, as surfaces with the nodes behind them.

use std::collections::BTreeMap;

use mpm_core::{HeldNode, HeldSurface, ImageNode};
use mpm_mesh::{CellSearch, SimplexMesh};
use mpm_tensor::vector as algebra;

use crate::background::named_facets;

/// The unit normals into the mesh at the vertices of some facets, means of those of the facets there by area; 0 where all facets are inside the mesh.
pub(super) fn vertex_normals<const D: usize>(inner: &SimplexMesh<D>, facets: &[u32]) -> BTreeMap<u32, [f64; D]> {
    let mut normals: BTreeMap<u32, [f64; D]> = facets.iter().map(|&vertex| (vertex, [0.0; D])).collect();
    for facet in named_facets(inner, facets) {
        for vertex in facet.vertices {
            algebra::accumulate(normals.entry(vertex).or_insert([0.0; D]), -facet.area, &facet.normal);
        }
    }
    for normal in normals.values_mut() {
        let length = algebra::norm(normal);
        if length > 0.0 {
            *normal = algebra::scale(normal, 1.0 / length);
        }
    }
    normals
}

/// The vertices of the layer, from number `own` on, whose nearest vertex of the mesh that they are joined to is one of these; with that one.
pub(super) fn behind<const D: usize>(
    whole: &SimplexMesh<D>,
    own: usize,
    bases: &BTreeMap<u32, [f64; D]>,
) -> Vec<(u32, u32)> {
    let (vertices, neighbours) = (whole.vertices(), whole.vertex_neighbours());
    let base = |vertex: u32| {
        let distance = |other: &u32| algebra::distance_squared(&vertices[*other as usize], &vertices[vertex as usize]);
        let joined = neighbours.get(vertex as usize).iter().copied();
        let joined = joined.filter(|&other| (other as usize) < own);
        let nearest = joined.min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        bases.contains_key(&nearest).then_some((vertex, nearest))
    };
    (own as u32..vertices.len() as u32).filter_map(base).collect()
}

/// A node of the layer this near to the plane of facets, as a share of its distance from their vertex, is in it; above it is beside the facets, not behind.
const IN_THE_PLANE: f64 = 1e-6;

/// Barycentric coordinates below are those of a point on a face.
const ON_A_FACE: f64 = 1e-9;

/// The vertices around a point with their barycentric coordinates, those of a face where it is on one; none outside of the mesh.
fn shares<const D: usize>(mesh: &SimplexMesh<D>, search: &CellSearch<D>, x: &[f64; D]) -> Vec<(u32, f64)> {
    let Some(place) = search.locate(x, None) else {
        return Vec::new();
    };
    let first = 1.0 - place.barycentric.iter().sum::<f64>();
    let all = mesh
        .cell(place.cell as usize)
        .iter()
        .copied()
        .zip(std::iter::once(first).chain(place.barycentric));
    let kept: Vec<(u32, f64)> = all.filter(|&(_, share)| share > ON_A_FACE).collect();
    let total: f64 = kept.iter().map(|(_, share)| share).sum();
    kept.into_iter()
        .map(|(vertex, share)| (vertex, share / total))
        .collect()
}

/// The surface of facets with these normals at their vertices, and the nodes of the layer behind them as images of what is before.
pub(super) fn held<const D: usize>(
    own: usize,
    whole: &SimplexMesh<D>,
    normals: &BTreeMap<u32, [f64; D]>,
    slides: bool,
    velocity: &dyn Fn(&[f64; D]) -> [f64; D],
) -> HeldSurface<D> {
    let position = |vertex: u32| whole.vertices()[vertex as usize];
    let node = |position: [f64; D], normal: &[f64; D], surface: &[f64; D]| HeldNode {
        position,
        normal: *normal,
        velocity: velocity(surface),
    };
    let mut on_surface: Vec<_> = normals
        .iter()
        .map(|(&vertex, normal)| node(position(vertex), normal, &position(vertex)))
        .collect();
    let height = |vertex: u32, base: u32| {
        let offset = algebra::subtract(&position(vertex), &position(base));
        (algebra::dot(&offset, &normals[&base]), algebra::norm(&offset))
    };
    let mut outside = behind(whole, own, normals);
    outside.retain(|&(vertex, base)| {
        let (height, distance) = height(vertex, base);
        if height.abs() <= IN_THE_PLANE * distance {
            on_surface.push(node(position(vertex), &normals[&base], &position(vertex)));
        }
        height < -IN_THE_PLANE * distance
    });
    let search = CellSearch::new(whole.clone());
    let images = outside.iter().map(|&(vertex, base)| {
        let (x, normal) = (position(vertex), &normals[&base]);
        let (height, _) = height(vertex, base);
        let mut sources = shares(whole, &search, &algebra::add_scaled(&x, -2.0 * height, normal));
        // What is an image itself says nothing.
        let is_image = |vertex: u32| outside.binary_search_by_key(&vertex, |&(vertex, _)| vertex).is_ok();
        if sources.iter().any(|&(vertex, _)| is_image(vertex)) {
            sources.clear();
        }
        ImageNode {
            node: node(x, normal, &algebra::add_scaled(&x, -height, normal)),
            sources: sources
                .into_iter()
                .map(|(vertex, share)| (position(vertex), share))
                .collect(),
        }
    });
    HeldSurface::new(on_surface, images.collect(), slides)
}

#[cfg(test)]
pub(super) mod tests {
    use std::collections::HashMap;

    use mpm_mesh::MeshBasis;
    use mpm_mesh::generate::{EdgeTarget, disk, with_outer_layer};
    use mpm_tensor::Matrix;

    use super::*;

    /// A disk, the same with its layer, and the vertices of its boundary facets.
    pub fn with_rim() -> (SimplexMesh<2>, SimplexMesh<2>, Vec<u32>) {
        let target = EdgeTarget {
            length: 0.2,
            angle: 0.1,
        };
        let inner = disk([0.0; 2], 1.0, &target).expect("a disk");
        let whole = with_outer_layer(&inner).expect("a layer").0;
        let rim = inner.boundary().iter().flat_map(|facet| facet.vertices).collect();
        (inner, whole, rim)
    }

    fn x_bits(x: &[f64; 2]) -> [u64; 2] {
        x.map(f64::to_bits)
    }

    /// A patch test: with a linear field at the nodes inside, prescribed at the rim and by images behind it, velocity and gradient are that field's at every point up to the curved
    /// boundary.
    #[test]
    fn a_linear_field_is_exact_up_to_a_curved_boundary() {
        let (inner, whole, rim) = with_rim();
        let gradient = Matrix([[0.3, -1.2], [0.7, 0.4]]);
        let field = |x: &[f64; 2]| algebra::add(&gradient.apply(x), &[0.5, -0.25]);
        let surface = held(
            inner.vertices().len(),
            &whole,
            &vertex_normals(&inner, &rim),
            false,
            &field,
        );
        let mut nodes: HashMap<[u64; 2], [f64; 2]> = inner.vertices().iter().map(|x| (x_bits(x), field(x))).collect();
        nodes.extend(surface.held.iter().map(|held| (x_bits(&held.position), held.velocity)));
        let behind = surface.images.iter().map(|ImageNode { node, sources }| {
            assert!(!sources.is_empty(), "{:?} has no mirror point", node.position);
            let mut image = algebra::scale(&node.velocity, 2.0);
            for (x, share) in sources {
                algebra::accumulate(&mut image, -share, &nodes[&x_bits(x)]);
            }
            (x_bits(&node.position), image)
        });
        let behind: Vec<_> = behind.collect();
        assert_eq!(behind.len(), whole.vertices().len() - inner.vertices().len());
        nodes.extend(behind);
        let basis = MeshBasis::new(&whole).expect("a basis");
        for k in 0..400 {
            let (radius, angle) = ((f64::from(k) / 400.0).sqrt() * 0.985, 2.4 * f64::from(k));
            let x = [radius * angle.cos(), radius * angle.sin()];
            let (mut velocity, mut rate) = ([0.0; 2], Matrix::ZERO);
            for weight in basis.weights_at(&x).expect("inside") {
                let v = nodes[&x_bits(&basis.mesh().vertices()[weight.vertex as usize])];
                algebra::accumulate(&mut velocity, weight.entry.weight, &v);
                rate += Matrix::outer(&v, &weight.entry.gradient);
            }
            assert!(algebra::distance(&velocity, &field(&x)) < 1e-12, "{x:?}: {velocity:?}");
            assert!((rate - gradient).maximum_norm() < 1e-11, "{x:?}: {rate:?}");
        }
    }

    #[test]
    fn normals_of_a_disk_point_at_its_centre_also_in_the_layer() {
        let (inner, whole, rim) = with_rim();
        let surface = held(
            inner.vertices().len(),
            &whole,
            &vertex_normals(&inner, &rim),
            true,
            &|_| [0.0; 2],
        );
        assert_eq!(surface.held.len(), rim.len() / 2);
        for node in surface
            .held
            .iter()
            .chain(surface.images.iter().map(|image| &image.node))
        {
            let cosine = -algebra::dot(&node.normal, &node.position) / algebra::norm(&node.position);
            assert!(cosine > 0.98, "{node:?}");
        }
    }
}
