//! Which node is at a position.

use hashbrown::HashMap;
use mpm_tensor::vector::distance;

use super::MeshBasis;
use super::activate::ACTIVE;
use crate::SimplexMesh;

/// A vertex this close to a position, in units of the shortest edge, is there.
const SAME_PLACE: f64 = 1e-6;

/// Edge of the boxes, in units of the shortest edge: their diagonals are shorter than it for D ≤ 3, so there is one vertex in a box at most.
const BOX: f64 = 0.5;

/// Vertices by the box of a uniform grid that they lie in. Walls that mirror ask for every node in every step: a hash that is quick on short keys.
#[derive(Clone, Debug)]
pub(super) struct VertexBoxes<const D: usize> {
    vertices: HashMap<[i64; D], u32>,
    /// Boxes per length.
    density: f64,
}

impl<const D: usize> VertexBoxes<D> {
    fn new(mesh: &SimplexMesh<D>, shortest_edge: f64) -> Self {
        let density = 1.0 / (BOX * shortest_edge);
        let vertices = mesh.vertices().iter().zip(0..);
        Self {
            vertices: vertices.map(|(x, vertex)| (box_of(x, density), vertex)).collect(),
            density,
        }
    }

    /// The vertex that `is_there`, in the boxes that a cube about `position` touches.
    fn find(&self, position: &[f64; D], reach: f64, is_there: impl Fn(u32) -> bool) -> Option<u32> {
        let [low, high] = [-reach, reach].map(|reach| box_of(&position.map(|c| c + reach), self.density));
        let corner = |set: usize| std::array::from_fn(|a| if set >> a & 1 == 1 { high[a] } else { low[a] });
        // Sets of axes on which the cube reaches into a second box.
        let is_new = |set: &usize| (0..D).all(|a| set >> a & 1 == 0 || low[a] != high[a]);
        let found = (0..1 << D)
            .filter(is_new)
            .filter_map(|set| self.vertices.get(&corner(set)));
        found.copied().find(|&vertex| is_there(vertex))
    }

    pub fn storage_bytes(&self) -> usize {
        self.vertices.capacity() * size_of::<([i64; D], u32)>()
    }
}

fn box_of<const D: usize>(x: &[f64; D], density: f64) -> [i64; D] {
    x.map(|c| (c * density).floor() as i64)
}

impl<const D: usize> MeshBasis<D> {
    /// Number of the active node at `position`.
    pub(super) fn node_at(&self, position: &[f64; D]) -> Option<u32> {
        let mesh = self.mesh();
        let boxes = self
            .vertex_boxes
            .get_or_init(|| VertexBoxes::new(mesh, self.shortest_edge));
        let close = SAME_PLACE * self.shortest_edge;
        let is_there = |vertex: u32| distance(position, &mesh.vertices()[vertex as usize]) <= close;
        let vertex = boxes.find(position, close, is_there)? as usize;
        let is_active = self.marks.get(vertex).is_some_and(|mark| mark & ACTIVE != 0);
        is_active.then(|| self.numbers[vertex])
    }
}
