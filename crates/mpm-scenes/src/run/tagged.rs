//! Conditions on named facets of a mesh, as conditions on its vertices.

use std::collections::{BTreeMap, HashMap};

use mpm_core::{Contact, HeldNode, HeldSurface, ImageNode, NodeForces, Obstacle, SignedDistance};
use mpm_mesh::{BoundaryFacet, CellSearch, MeshBasis, SimplexMesh};
use mpm_tensor::vector as algebra;

use super::dispatch;
use crate::background::{Background, facet_keys, named_facets};
use crate::scene::{FacetCondition, FacetTable, ON_MESH, Scene};
use crate::shape::{MeshOutside, Shape};
use crate::values::{vector, within};
use crate::{SceneFault, velocity};

/// Vertices by the bits of their positions, which nodes have too.
type ByPosition<const D: usize> = HashMap<[u64; D], [f64; D]>;

fn bits<const D: usize>(x: &[f64; D]) -> [u64; D] {
    x.map(f64::to_bits)
}

/// A surface that stands at vertices and nowhere else, with a unit normal into the mesh at each. Particles meet the boundary of the mesh.
struct AtVertices<const D: usize> {
    normals: ByPosition<D>,
    /// The boundary, as far as particles of a cell's size can be and touch it.
    boundary: (MeshOutside<D>, f64),
}

impl<const D: usize> SignedDistance<D> for AtVertices<D> {
    fn distance(&self, x: &[f64; D]) -> f64 {
        if self.normals.contains_key(&bits(x)) {
            0.0
        } else {
            f64::INFINITY
        }
    }

    fn distance_of_particle(&self, x: &[f64; D]) -> f64 {
        let (boundary, reach) = &self.boundary;
        let near = boundary.closer_than(x, *reach);
        near.map_or(f64::INFINITY, |(distance, _)| distance)
    }

    fn normal(&self, x: &[f64; D]) -> [f64; D] {
        self.normals.get(&bits(x)).copied().unwrap_or([0.0; D])
    }
}

/// What the facets of a scene do.
pub(super) struct Tagged<const D: usize> {
    /// Those that hold, move, or let slide.
    pub surfaces: Vec<HeldSurface<D>>,
    /// Those that rub.
    pub obstacles: Vec<Obstacle<D>>,
    /// Tractions as forces at nodes.
    pub forces: Vec<NodeForces<D>>,
}

/// The conditions of `[[facets]]`.
///
/// # Errors
/// [`SceneFault::Value`] for a group that the mesh does not have, and for tables that [`Scene::read`] refuses.
pub(super) fn build<const D: usize>(scene: &Scene, background: &Background<D>) -> Result<Tagged<D>, SceneFault> {
    let mut tagged = Tagged {
        surfaces: Vec::new(),
        obstacles: Vec::new(),
        forces: Vec::new(),
    };
    for (index, table) in scene.facets.iter().enumerate() {
        let field = |key: &str| format!("facets[{index}].{key}");
        let Background::Mesh {
            inner, whole, groups, ..
        } = background
        else {
            return Err(SceneFault::value(field("group"), &table.group, ON_MESH));
        };
        let facets = group(field("group"), table, groups)?;
        let expected = "a group with facets: the file names this one, and no element is in it";
        within(&field("group"), &table.group, !facets.is_empty(), expected)?;
        let holds = matches!(table.condition, FacetCondition::Fixed | FacetCondition::Prescribed);
        let outer = named_facets(inner, facets).count();
        let expected = "a group with facets of the boundary: the others have no normal, and the condition acts on none";
        within(&field("group"), &table.group, holds || outer > 0, expected)?;
        let inside = facet_keys::<D>(facets).len() - outer;
        let expected = format!(
            "a group of facets of the boundary alone: {inside} are inside the mesh, have no normal, and the condition does not act there"
        );
        within(&field("group"), &table.group, holds || inside == 0, &expected)?;
        let normals = vertex_normals(inner, facets);
        let mut surface = |slides, velocity: &dyn Fn(&[f64; D]) -> [f64; D]| {
            tagged
                .surfaces
                .push(held(inner.vertices().len(), whole, &normals, slides, velocity));
        };
        match table.condition {
            FacetCondition::Fixed => surface(false, &|_| [0.0; D]),
            FacetCondition::Slip => surface(true, &|_| [0.0; D]),
            FacetCondition::Prescribed => {
                let velocity = velocity::build::<D>(&field("velocity"), table.velocity.as_ref(), scene)?;
                surface(false, &|x| velocity.at(x));
            }
            FacetCondition::Friction => {
                let friction = table.friction.unwrap_or(0.0);
                let reach = 2.0 * inner.edge_lengths().longest;
                let own = normals.iter().map(|(&vertex, normal)| (vertex, *normal));
                let behind = behind(whole, inner.vertices().len(), &normals);
                let all = own.chain(behind.into_iter().map(|(vertex, base)| (vertex, normals[&base])));
                let position = |vertex: u32| bits(&whole.vertices()[vertex as usize]);
                tagged.obstacles.push(Obstacle {
                    shape: Box::new(AtVertices {
                        normals: all.map(|(vertex, normal)| (position(vertex), normal)).collect(),
                        boundary: (MeshOutside::new(inner, reach), reach),
                    }),
                    contact: Contact::Separate { friction },
                    velocity: [0.0; D],
                });
            }
            FacetCondition::Traction => {
                let traction = table
                    .traction
                    .as_ref()
                    .map(|list| vector::<D>(&field("traction"), list));
                let (traction, pressure) = (traction.transpose()?, table.pressure.unwrap_or(0.0));
                let load = |facet: &BoundaryFacet<D>| traction.unwrap_or_else(|| facet.normal.map(|c| -pressure * c));
                tagged.forces.push(NodeForces {
                    forces: forces(&dispatch::mesh_basis(scene, whole)?, inner, facets, load),
                    ramp: table.ramp.unwrap_or(0.0),
                });
            }
        }
    }
    Ok(tagged)
}

/// The facets of a group.
fn group<'a>(
    field: String,
    table: &FacetTable,
    groups: &'a BTreeMap<String, Vec<u32>>,
) -> Result<&'a [u32], SceneFault> {
    let known: Vec<&str> = groups.keys().map(String::as_str).collect();
    let expected = format!("one of the groups of the mesh: {}", known.join(", "));
    let facets = groups.get(&table.group);
    facets
        .map(Vec::as_slice)
        .ok_or_else(|| SceneFault::value(field, &table.group, expected))
}

/// f_i = Σ_v w_i(x_v) Σ_f t_f A_f / D over the vertices v of facets f with tractions t: ∫ w_i t dA with w_i between vertices by the hat functions of the boundary. Since Σ w_i = 1 and
/// Σ w_i x_i = x_v, the force and its moments of first order are those of the facets.
fn forces<const D: usize>(
    basis: &MeshBasis<D>,
    inner: &SimplexMesh<D>,
    facets: &[u32],
    load: impl Fn(&BoundaryFacet<D>) -> [f64; D],
) -> Vec<([f64; D], [f64; D])> {
    let mut at_vertices: BTreeMap<u32, [f64; D]> = BTreeMap::new();
    for facet in named_facets(inner, facets) {
        let load = load(&facet);
        for vertex in facet.vertices {
            algebra::accumulate(
                at_vertices.entry(vertex).or_insert([0.0; D]),
                facet.area / D as f64,
                &load,
            );
        }
    }
    let mut at_nodes: BTreeMap<u32, [f64; D]> = BTreeMap::new();
    for (vertex, force) in at_vertices {
        for weight in basis.weights_at(&inner.vertices()[vertex as usize]).unwrap_or_default() {
            algebra::accumulate(
                at_nodes.entry(weight.vertex).or_insert([0.0; D]),
                weight.entry.weight,
                &force,
            );
        }
    }
    let position = |vertex: u32| basis.mesh().vertices()[vertex as usize];
    let loaded = at_nodes.into_iter().filter(|(_, force)| *force != [0.0; D]);
    loaded.map(|(vertex, force)| (position(vertex), force)).collect()
}

/// The unit normals into the mesh at the vertices of some facets, means of those of the facets there by area; 0 where all facets are inside the mesh.
fn vertex_normals<const D: usize>(inner: &SimplexMesh<D>, facets: &[u32]) -> BTreeMap<u32, [f64; D]> {
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
fn behind<const D: usize>(whole: &SimplexMesh<D>, own: usize, bases: &BTreeMap<u32, [f64; D]>) -> Vec<(u32, u32)> {
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
fn held<const D: usize>(
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
mod tests {
    use mpm_mesh::MeshBasis;
    use mpm_mesh::generate::{EdgeTarget, disk, with_outer_layer};
    use mpm_tensor::Matrix;

    use super::*;

    /// A disk, the same with its layer, and the vertices of its boundary facets.
    fn with_rim() -> (SimplexMesh<2>, SimplexMesh<2>, Vec<u32>) {
        let target = EdgeTarget {
            length: 0.2,
            angle: 0.1,
        };
        let inner = disk([0.0; 2], 1.0, &target).expect("a disk");
        let whole = with_outer_layer(&inner).expect("a layer").0;
        let rim = inner.boundary().iter().flat_map(|facet| facet.vertices).collect();
        (inner, whole, rim)
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
        let mut nodes: ByPosition<2> = inner.vertices().iter().map(|x| (bits(x), field(x))).collect();
        nodes.extend(surface.held.iter().map(|held| (bits(&held.position), held.velocity)));
        let behind = surface.images.iter().map(|ImageNode { node, sources }| {
            assert!(!sources.is_empty(), "{:?} has no mirror point", node.position);
            let mut image = algebra::scale(&node.velocity, 2.0);
            for (x, share) in sources {
                algebra::accumulate(&mut image, -share, &nodes[&bits(x)]);
            }
            (bits(&node.position), image)
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
                let v = nodes[&bits(&basis.mesh().vertices()[weight.vertex as usize])];
                algebra::accumulate(&mut velocity, weight.entry.weight, &v);
                rate += Matrix::outer(&v, &weight.entry.gradient);
            }
            assert!(algebra::distance(&velocity, &field(&x)) < 1e-12, "{x:?}: {velocity:?}");
            assert!((rate - gradient).maximum_norm() < 1e-11, "{x:?}: {rate:?}");
        }
    }

    /// Patch test of a traction: under t = σ n on the whole boundary, forces and their first moments are those of a constant stress, Σ f = 0 and Σ f xᵀ = V σ.
    #[test]
    #[allow(non_snake_case)]
    fn tractions_of_a_constant_stress_are_in_equilibrium() {
        let (inner, whole, rim) = with_rim();
        let stress = Matrix([[2.0, -0.7], [-0.7, 0.5]]);
        for width in [mpm_mesh::KernelWidth::LongestEdge, mpm_mesh::KernelWidth::Local] {
            let basis = MeshBasis::new(&whole).expect("a basis").with_kernel_width(width);
            let (mut force, mut moment) = ([0.0; 2], Matrix::ZERO);
            for (x, f) in forces(&basis, &inner, &rim, |facet| stress.apply(&facet.normal)) {
                algebra::accumulate(&mut force, 1.0, &f);
                moment += Matrix::outer(&f, &x);
            }
            let V = inner.total_volume();
            assert!(algebra::norm(&force) < 1e-12, "{force:?}");
            assert!((moment - stress * V).maximum_norm() < 1e-12, "{moment:?}");
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
