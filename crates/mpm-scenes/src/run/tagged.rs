//! Conditions on named facets of a mesh, as conditions on its vertices.

use std::collections::{BTreeMap, HashMap};

use mpm_core::{Contact, Obstacle, PrescribedVelocity, SignedDistance};
use mpm_mesh::SimplexMesh;
use mpm_tensor::vector as algebra;

use crate::background::Background;
use crate::scene::{FacetTable, Scene, WallCondition};
use crate::{SceneFault, velocity};

/// Vertices by the bits of their positions, which nodes have too.
type ByPosition<const D: usize> = HashMap<[u64; D], [f64; D]>;

fn bits<const D: usize>(x: &[f64; D]) -> [u64; D] {
    x.map(f64::to_bits)
}

/// A surface that stands at vertices and nowhere else, with a unit normal into the mesh at each.
struct AtVertices<const D: usize>(ByPosition<D>);

impl<const D: usize> SignedDistance<D> for AtVertices<D> {
    fn distance(&self, x: &[f64; D]) -> f64 {
        if self.0.contains_key(&bits(x)) {
            0.0
        } else {
            f64::INFINITY
        }
    }

    fn normal(&self, x: &[f64; D]) -> [f64; D] {
        self.0.get(&bits(x)).copied().unwrap_or([0.0; D])
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
}

/// The conditions of `[[facets]]`.
///
/// # Errors
/// [`SceneFault::Value`] for a group that the mesh does not have, and for tables that [`Scene::read`] refuses.
pub(super) fn build<const D: usize>(scene: &Scene, background: &Background<D>) -> Result<Tagged<D>, SceneFault> {
    let mut tagged = Tagged {
        obstacles: Vec::new(),
        prescribed: Vec::new(),
    };
    for (index, table) in scene.facets.iter().enumerate() {
        let field = |key: &str| format!("facets[{index}].{key}");
        let Background::Mesh {
            inner, whole, groups, ..
        } = background
        else {
            return Err(SceneFault::value(
                field("group"),
                &table.group,
                "left out without a mesh.file",
            ));
        };
        let facets = group(field("group"), table, groups)?;
        let normals = normals(inner, whole, facets);
        if table.condition == WallCondition::Prescribed {
            let velocity = velocity::build::<D>(&field("velocity"), table.velocity.as_ref(), scene)?;
            let given = normals.keys().map(|key| (*key, velocity.at(&key.map(f64::from_bits))));
            tagged.prescribed.push(Box::new(Given(given.collect())));
            continue;
        }
        let contact = match table.condition {
            WallCondition::Slip => Contact::Slip,
            WallCondition::Friction => Contact::Separate {
                friction: table.friction.unwrap_or(0.0),
            },
            WallCondition::Fixed | WallCondition::Prescribed => Contact::Stick,
        };
        tagged.obstacles.push(Obstacle {
            shape: Box::new(AtVertices(normals)),
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
    let expected = if known.is_empty() {
        "a physical group of facets, of which mesh.file has none".to_owned()
    } else {
        format!("one of the physical groups of mesh.file: {}", known.join(", "))
    };
    let facets = groups.get(&table.group);
    facets
        .map(Vec::as_slice)
        .ok_or_else(|| SceneFault::value(field, &table.group, expected))
}

/// The unit normals into the mesh at the vertices of some facets, means of those of the facets there by area. Vertices of the layer around the mesh have that of the nearest
/// vertex of the mesh that they are joined to, if that is one of these.
fn normals<const D: usize>(inner: &SimplexMesh<D>, whole: &SimplexMesh<D>, facets: &[u32]) -> ByPosition<D> {
    let key = |facet: &[u32]| {
        let mut facet = facet.to_vec();
        facet.sort_unstable();
        facet
    };
    let named: std::collections::HashSet<Vec<u32>> = facets.chunks_exact(D.max(1)).map(key).collect();
    let mut sums: HashMap<u32, [f64; D]> = facets.iter().map(|&vertex| (vertex, [0.0; D])).collect();
    for facet in inner.boundary() {
        if named.contains(&key(&facet.vertices)) {
            for vertex in facet.vertices {
                algebra::accumulate(sums.entry(vertex).or_insert([0.0; D]), -facet.area, &facet.normal);
            }
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
        let own: std::collections::HashSet<[u64; 2]> = inner.vertices().iter().map(bits).collect();
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
