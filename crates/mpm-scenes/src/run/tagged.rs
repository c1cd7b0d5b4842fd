//! Conditions on named facets of a mesh, as conditions on its vertices.

use std::collections::{BTreeMap, HashMap};

use mpm_core::{Contact, HeldSurface, NodeForces, Obstacle, SignedDistance};
use mpm_mesh::BoundaryFacet;
use mpm_tensor::vector as algebra;

use super::dispatch;
use super::filled::Filled;
use super::held_facets::{behind, held, vertex_normals};
use super::tractions::Tractions;
use crate::background::{Background, facet_keys, named_facets, smooth_parts};
use crate::population::Population;
use crate::scene::{FacetCondition, FacetTable, ON_MESH, PressureTable, Scene, amplitude};
use crate::shape::{MeshOutside, Shape};
use crate::values::within;
use crate::{SceneFault, facet_traction, vector_field};

/// Normals, and mirror images of what is behind, at vertices by the bits of their positions, which nodes have too.
type ByPosition<const D: usize> = HashMap<[u64; D], ([f64; D], Option<[f64; D]>)>;

fn bits<const D: usize>(x: &[f64; D]) -> [u64; D] {
    x.map(f64::to_bits)
}

/// A surface that stands at vertices and nowhere else, with a unit normal into the mesh at each. Particles meet its facets.
struct AtVertices<const D: usize> {
    normals: ByPosition<D>,
    /// The facets, as far as particles of a cell's size can be and touch them.
    facets: (MeshOutside<D>, f64),
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
        let (facets, reach) = &self.facets;
        let distance = facets.distance(x);
        if distance.abs() < *reach {
            distance
        } else {
            f64::INFINITY
        }
    }

    fn normal(&self, x: &[f64; D]) -> [f64; D] {
        self.normals.get(&bits(x)).map_or([0.0; D], |(normal, _)| *normal)
    }

    fn image(&self, x: &[f64; D]) -> Option<[f64; D]> {
        self.normals.get(&bits(x)).and_then(|(_, image)| *image)
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

/// The conditions of `[[facets]]`, for these particles.
///
/// # Errors
/// [`SceneFault::Value`] for a group that the mesh does not have, for a traction on facets that no body touches, for a fluid that is below those that some do, and for tables that [`Scene::read`] refuses.
pub(super) fn build<const D: usize>(
    scene: &Scene,
    background: &Background<D>,
    population: &Population<D>,
) -> Result<Tagged<D>, SceneFault> {
    let mut tagged = Tagged {
        surfaces: Vec::new(),
        obstacles: Vec::new(),
        forces: Vec::new(),
    };
    let (mut tractions, mut filled) = (Tractions::default(), None);
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
        if table.condition != FacetCondition::Traction {
            named_facets(inner, facets).for_each(|facet| tractions.hold(&facet));
        }
        let normals = vertex_normals(inner, facets);
        let own = inner.vertices().len();
        match table.condition {
            FacetCondition::Fixed => tagged.surfaces.push(held(own, whole, &normals, false, &|_| [0.0; D])),
            FacetCondition::Slip => {
                let parts = smooth_parts(inner, facets).into_iter();
                let normals = parts.map(|part| vertex_normals(inner, &part));
                tagged
                    .surfaces
                    .extend(normals.map(|normals| held(own, whole, &normals, true, &|_| [0.0; D])));
            }
            FacetCondition::Prescribed => {
                let velocity = vector_field::build::<D>(&field("velocity"), table.velocity.as_ref(), scene)?;
                let across = |(&vertex, normal): (&u32, &[f64; D])| {
                    algebra::dot(&velocity.at(&inner.vertices()[vertex as usize]), normal).abs()
                };
                let way = normals.iter().map(across).fold(0.0, f64::max) * scene.time.end;
                let expected = "along the facets, or across them by an edge at most until time.end: they stay where they are, [[obstacles]] and [[held]] move";
                let stays = way <= inner.edge_lengths().longest;
                within(&field("velocity"), &table.velocity, stays, expected)?;
                tagged
                    .surfaces
                    .push(held(own, whole, &normals, false, &|x| velocity.at(x)));
            }
            FacetCondition::Friction => {
                let friction = table.friction.unwrap_or(0.0);
                let reach = 2.0 * inner.edge_lengths().longest;
                for part in smooth_parts(inner, facets) {
                    let normals = vertex_normals(inner, &part);
                    let position = |vertex: u32| whole.vertices()[vertex as usize];
                    let image = |vertex: u32, base: u32| {
                        let (x, normal) = (position(vertex), &normals[&base]);
                        let height = algebra::dot(&algebra::subtract(&x, &position(base)), normal);
                        let image = (height < 0.0).then(|| algebra::add_scaled(&x, -2.0 * height, normal));
                        (bits(&x), (*normal, image))
                    };
                    let behind = behind(whole, own, &normals).into_iter();
                    let behind = behind.map(|(vertex, base)| image(vertex, base));
                    let on = normals
                        .iter()
                        .map(|(&vertex, normal)| (bits(&position(vertex)), (*normal, None)));
                    tagged.obstacles.push(Obstacle {
                        shape: Box::new(AtVertices {
                            normals: on.chain(behind).collect(),
                            facets: (MeshOutside::of(inner, named_facets(inner, &part), reach), reach),
                        }),
                        contact: Contact::Separate { friction },
                        velocity: [0.0; D],
                    });
                }
            }
            FacetCondition::Traction => {
                let traction = facet_traction::build::<D>(&field, table, scene)?;
                let filled = filled.get_or_insert_with(|| Filled::new(inner, population));
                let position = |vertex: u32| &inner.vertices()[vertex as usize];
                let at_vertices = |facet: BoundaryFacet<D>| {
                    let at = |vertex| traction(position(vertex), &facet.normal);
                    (facet, facet.vertices.map(at))
                };
                let touched = named_facets(inner, facets).filter(|facet| filled.is_touched(facet));
                let loaded: Vec<_> = touched.map(at_vertices).collect();
                let expected = "a group with a facet that a body touches: the traction acts on none";
                within(&field("group"), &table.group, !loaded.is_empty(), expected)?;
                let is_fluid = matches!(table.pressure, Some(PressureTable::Field(_)));
                let acts = loaded.iter().flat_map(|(_, at)| at).any(|t| *t != [0.0; D]);
                let expected =
                    "that of a fluid whose surface is above a facet of the group that a body touches: it acts on none";
                within(&field("pressure"), &table.pressure, !is_fluid || acts, expected)?;
                let amplitude = amplitude(&field, table.ramp, table.amplitude.as_ref())?;
                for (facet, at_vertices) in &loaded {
                    tractions.add(&amplitude, facet, at_vertices);
                }
            }
        }
    }
    if let Background::Mesh { inner, whole, .. } = background {
        tagged.forces = tractions.forces(|| dispatch::mesh_basis(scene, whole), inner, whole)?;
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
