//! Conditions on named facets of a mesh, as conditions on its vertices.

use std::collections::{BTreeMap, HashMap, HashSet};

use mpm_core::{Contact, NodeForces, Obstacle, PrescribedVelocity, SignedDistance};
use mpm_mesh::{BoundaryFacet, MeshBasis, SimplexMesh};
use mpm_tensor::vector as algebra;

use super::dispatch;
use crate::background::Background;
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
    /// Where material may leave, as far as particles of a cell's size can be and touch it.
    boundary: Option<(MeshOutside<D>, f64)>,
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
        let near = self
            .boundary
            .as_ref()
            .and_then(|(boundary, reach)| boundary.closer_than(x, *reach));
        near.map_or(f64::INFINITY, |(distance, _)| distance)
    }

    fn normal(&self, x: &[f64; D]) -> [f64; D] {
        self.normals.get(&bits(x)).copied().unwrap_or([0.0; D])
    }
}

/// Velocities of vertices.
struct Given<const D: usize>(ByPosition<D>);

impl<const D: usize> PrescribedVelocity<D> for Given<D> {
    fn velocity(&self, x: &[f64; D], _: f64, _: f64) -> Option<[f64; D]> {
        self.0.get(&bits(x)).copied()
    }
}

/// What the facets of a scene do.
pub(super) struct Tagged<const D: usize> {
    /// Those that hold, let slide or rub.
    pub obstacles: Vec<Obstacle<D>>,
    /// Those that move the body.
    pub prescribed: Vec<Box<dyn PrescribedVelocity<D>>>,
    /// Tractions as forces at nodes.
    pub forces: Vec<NodeForces<D>>,
}

/// The conditions of `[[facets]]`.
///
/// # Errors
/// [`SceneFault::Value`] for a group that the mesh does not have, and for tables that [`Scene::read`] refuses.
pub(super) fn build<const D: usize>(scene: &Scene, background: &Background<D>) -> Result<Tagged<D>, SceneFault> {
    let mut tagged = Tagged {
        obstacles: Vec::new(),
        prescribed: Vec::new(),
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
        let outer = named(inner, facets).count();
        let expected = "a group with facets of the boundary: the others have no normal, and the condition acts on none";
        within(&field("group"), &table.group, holds || outer > 0, expected)?;
        let inside = keys::<D>(facets).len() - outer;
        let expected = format!(
            "a group of facets of the boundary alone: {inside} are inside the mesh, have no normal, and the condition does not act there"
        );
        within(&field("group"), &table.group, holds || inside == 0, &expected)?;
        let normals = || normals(inner, whole, facets);
        let contact = match table.condition {
            FacetCondition::Fixed => Contact::Stick,
            FacetCondition::Slip => Contact::Slip,
            FacetCondition::Friction => Contact::Separate {
                friction: table.friction.unwrap_or(0.0),
            },
            FacetCondition::Prescribed => {
                let velocity = velocity::build::<D>(&field("velocity"), table.velocity.as_ref(), scene)?;
                let normals = normals();
                let given = normals.keys().map(|key| (*key, velocity.at(&key.map(f64::from_bits))));
                tagged.prescribed.push(Box::new(Given(given.collect())));
                continue;
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
                continue;
            }
        };
        tagged.obstacles.push(Obstacle {
            shape: Box::new(AtVertices {
                normals: normals(),
                boundary: matches!(contact, Contact::Separate { .. }).then(|| {
                    let reach = 2.0 * inner.edge_lengths().longest;
                    (MeshOutside::new(inner, reach), reach)
                }),
            }),
            contact,
            velocity: [0.0; D],
        });
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

/// The vertices of a facet in ascending order.
fn key(facet: &[u32]) -> Vec<u32> {
    let mut facet = facet.to_vec();
    facet.sort_unstable();
    facet
}

/// The facets of a group, each once.
fn keys<const D: usize>(facets: &[u32]) -> HashSet<Vec<u32>> {
    facets.chunks_exact(D.max(1)).map(key).collect()
}

/// The facets of the boundary that a group names, by any order of their vertices.
fn named<const D: usize>(inner: &SimplexMesh<D>, facets: &[u32]) -> impl Iterator<Item = BoundaryFacet<D>> {
    let named = keys::<D>(facets);
    let boundary = inner.boundary().into_iter();
    boundary.filter(move |facet| named.contains(&key(&facet.vertices)))
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
    for facet in named(inner, facets) {
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

/// The unit normals into the mesh at the vertices of some facets, means of those of the facets there by area. Vertices of the layer around the mesh have that of the nearest
/// vertex of the mesh that they are joined to, if that is one of these.
fn normals<const D: usize>(inner: &SimplexMesh<D>, whole: &SimplexMesh<D>, facets: &[u32]) -> ByPosition<D> {
    let mut sums: HashMap<u32, [f64; D]> = facets.iter().map(|&vertex| (vertex, [0.0; D])).collect();
    for facet in named(inner, facets) {
        for vertex in facet.vertices {
            algebra::accumulate(sums.entry(vertex).or_insert([0.0; D]), -facet.area, &facet.normal);
        }
    }
    let unit = |sum: &[f64; D]| {
        let length = algebra::norm(sum);
        if length > 0.0 {
            sum.map(|c| c / length)
        } else {
            [0.0; D]
        }
    };
    let own = inner.vertices().len();
    let (vertices, neighbours) = (whole.vertices(), whole.vertex_neighbours());
    let mut normals: ByPosition<D> = HashMap::new();
    for (vertex, x) in (0u32..).zip(vertices) {
        let source = if (vertex as usize) < own {
            Some(vertex)
        } else {
            let joined = neighbours.get(vertex as usize).iter().copied();
            let distance = |other: &u32| algebra::distance_squared(&vertices[*other as usize], x);
            let joined = joined.filter(|&other| (other as usize) < own);
            joined.min_by(|a, b| distance(a).total_cmp(&distance(b)))
        };
        if let Some(sum) = source.and_then(|source| sums.get(&source)) {
            normals.insert(bits(x), unit(sum));
        }
    }
    normals
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

    /// A patch test: with a linear field at the nodes inside and prescribed at the rim, velocity and gradient are that field's at every point up to the curved
    /// boundary, since all nodes there are inside or at the rim or behind it.
    #[test]
    fn a_linear_field_is_exact_up_to_a_curved_boundary() {
        let (inner, whole, rim) = with_rim();
        let gradient = Matrix([[0.3, -1.2], [0.7, 0.4]]);
        let field = |x: &[f64; 2]| algebra::add(&gradient.apply(x), &[0.5, -0.25]);
        let keys = normals(&inner, &whole, &rim);
        let rim = Given(keys.keys().map(|key| (*key, field(&key.map(f64::from_bits)))).collect());
        let own: HashSet<[u64; 2]> = inner.vertices().iter().map(bits).collect();
        let basis = MeshBasis::new(&whole).expect("a basis");
        for k in 0..400 {
            let (radius, angle) = ((f64::from(k) / 400.0).sqrt() * 0.985, 2.4 * f64::from(k));
            let x = [radius * angle.cos(), radius * angle.sin()];
            let (mut velocity, mut rate) = ([0.0; 2], Matrix::ZERO);
            for weight in basis.weights_at(&x).expect("inside") {
                let node = basis.mesh().vertices()[weight.vertex as usize];
                let given = rim.velocity(&node, 0.0, 1.0);
                let v = given.unwrap_or_else(|| {
                    assert!(own.contains(&bits(&node)), "{node:?} is behind the rim");
                    field(&node)
                });
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
        let normals = normals(&inner, &whole, &rim);
        let outside = whole.vertices().len() - inner.vertices().len();
        assert_eq!(normals.len(), rim.len() / 2 + outside);
        for (key, normal) in &normals {
            let x = key.map(f64::from_bits);
            let cosine = -algebra::dot(normal, &x) / algebra::norm(&x);
            assert!(cosine > 0.98, "{x:?}: {normal:?}");
        }
    }
}
