//! Walls so near to each other that the images of one are before or behind the other.

use std::ops::Range;

use mpm_tensor::vector;

use super::role::{Role, Roles};
use super::surface::ON_A_SURFACE;
use super::{GridMotion, Plane};
use crate::{Basis, GridNode};

/// Nodes that repeated reflection at walls maps to one, their source. With the reflections T_k u = V_k + R_k (u − V_k) at the walls on the way, first that at which the node itself is mirrored, the velocity of a
/// node is T v = T_1 T_2 … v, v that of the source. Of all such fields the source gets the one nearest to the velocities that the nodes would have without, by Σ m |·|²: v = Σ m T⁻¹ v_i / Σ m, T⁻¹ = … T_2 T_1. Then the walls act on the
/// source, and the nodes get T v.
///
/// That is for walls whose reflections do not commute, since they face each other or meet at less than a right angle, and where a source has images by both or is itself at the second. Elsewhere pairs are mirrored wall by wall
/// ([`mirror`](super::mirror::mirror)), which is the same.
#[derive(Default)]
pub(super) struct Folds {
    /// Source and node, and the places of the walls on the way in `walls`.
    images: Vec<(usize, usize, Range<usize>)>,
    walls: Vec<usize>,
    /// What walls do with the nodes.
    pub roles: Roles,
}

/// Reflections of a node at most.
const MOST_REFLECTIONS: usize = 64;

/// Parallel walls this many spacings apart have no images by both: far more than kernels reach.
const WIDE: f64 = 16.0;

/// Whether two walls are parallel and at least this far apart.
fn apart<const D: usize>(one: &Plane<D>, other: &Plane<D>, distance: f64) -> bool {
    vector::dot(&one.normal, &other.normal) < 1e-9 - 1.0 && one.height(&other.point) >= distance
}

/// Whether reflections at two walls do not commute, and the walls bound the same room.
pub(super) fn face_each_other<const D: usize>(one: &Plane<D>, other: &Plane<D>) -> bool {
    vector::dot(&one.normal, &other.normal) < -1e-9
}

impl Folds {
    /// Look for sources and images, and give the sources what all have together.
    pub fn fold<const D: usize, B: Basis<D>, N: GridNode<D>>(
        &mut self,
        walls: &[Plane<D>],
        basis: &B,
        motion: &GridMotion<D>,
        (masses, nodes): (&mut [f64], &mut [N]),
    ) {
        self.images.clear();
        self.roles.0.clear();
        let wide = WIDE * basis.spacing();
        let faces = |wall: &Plane<D>, other: &Plane<D>| face_each_other(wall, other) && !apart(wall, other, wide);
        let faced = |wall: &Plane<D>| walls.iter().any(|other| faces(wall, other));
        if !walls.iter().any(|wall| wall.mirrors() && faced(wall)) {
            return;
        }
        self.find(walls, basis, motion.positions);
        self.keep_entangled(walls, basis, motion.positions, masses);
        for sources in self.images.chunk_by(|a, b| a.0 == b.0) {
            let source = sources[0].0;
            let mut mass = masses[source];
            let mut momentum = vector::scale(nodes[source].velocity(), mass);
            for (_, node, way) in sources {
                let on_way = self.walls[way.clone()].iter();
                let seen = on_way.fold(*nodes[*node].velocity(), |v, &wall| walls[wall].reflect(&v));
                vector::accumulate(&mut momentum, masses[*node], &seen);
                mass += masses[*node];
            }
            if mass.abs() < f64::MIN_POSITIVE {
                continue; // all rest; negative weights make negative masses
            }
            *nodes[source].velocity_mut() = vector::scale(&momentum, 1.0 / mass);
            masses[source] = mass;
            for (_, node, _) in sources {
                masses[*node] = mass;
            }
        }
    }

    /// Give the images what their sources have.
    pub fn unfold<const D: usize, N: GridNode<D>>(&self, walls: &[Plane<D>], nodes: &mut [N]) {
        for (source, node, way) in &self.images {
            let back = self.walls[way.clone()].iter().rev();
            *nodes[*node].velocity_mut() = back.fold(*nodes[*source].velocity(), |v, &wall| walls[wall].reflect(&v));
        }
    }

    /// All nodes behind walls that mirror, and where repeated reflection takes them.
    fn find<const D: usize, B: Basis<D>>(&mut self, walls: &[Plane<D>], basis: &B, positions: &[[f64; D]]) {
        let close = ON_A_SURFACE * basis.spacing();
        self.walls.clear();
        self.roles.0.resize(positions.len(), Role::Own);
        for (node, start) in positions.iter().enumerate() {
            let (begin, mut x) = (self.walls.len(), *start);
            let behind = |x: &[f64; D]| walls.iter().position(|wall| wall.mirrors() && wall.height(x) < -close);
            while let Some(wall) = behind(&x)
                && self.walls.len() - begin < MOST_REFLECTIONS
            {
                x = vector::add_scaled(&x, -2.0 * walls[wall].height(&x), &walls[wall].normal);
                self.walls.push(wall);
            }
            let way = begin..self.walls.len();
            if way.is_empty() {
                continue;
            }
            match basis.node_number(&x).filter(|_| behind(&x).is_none()) {
                Some(source) => self.images.push((source as usize, node, way)),
                None => {
                    if any_face_each_other(walls, &self.walls[way]) {
                        self.roles.0[node] = Role::Held;
                    }
                    self.walls.truncate(begin);
                }
            }
        }
    }

    /// Leave what mirroring wall by wall does as well. Images without mass do not count: nothing is taken from them.
    fn keep_entangled<const D: usize, B: Basis<D>>(
        &mut self,
        walls: &[Plane<D>],
        basis: &B,
        positions: &[[f64; D]],
        masses: &[f64],
    ) {
        let close = ON_A_SURFACE * basis.spacing();
        let mut images = std::mem::take(&mut self.images);
        images.sort_by_key(|(source, node, _)| (*source, *node));
        let mut touched = Vec::new();
        for sources in images.chunk_by(|a, b| a.0 == b.0) {
            touched.clear();
            let with_mass = sources
                .iter()
                .filter(|(_, node, _)| masses[*node].abs() >= f64::MIN_POSITIVE);
            for (_, _, way) in with_mass {
                touched.extend_from_slice(&self.walls[way.clone()]);
            }
            if touched.is_empty() {
                continue;
            }
            let at = |wall: &usize| walls[*wall].height(&positions[sources[0].0]) <= close;
            touched.extend((0..walls.len()).filter(at));
            if any_face_each_other(walls, &touched) {
                for (_, node, _) in sources {
                    self.roles.0[*node] = Role::Image;
                }
                self.images.extend_from_slice(sources);
            }
        }
    }
}

fn any_face_each_other<const D: usize>(walls: &[Plane<D>], some: &[usize]) -> bool {
    let faces = |&one: &usize| some.iter().any(|&other| face_each_other(&walls[one], &walls[other]));
    some.iter().any(faces)
}
