//! The nodes that a run can touch, and whether a shape comes near one.

use mpm_mesh::SimplexMesh;

use crate::background::Background;
use crate::scene::Scene;
use crate::shape::{Bounds, Shape};

/// Boxes of nodes that are looked at before a search is given up.
const MOST_BOXES: usize = 200_000;

/// The nodes of a background.
pub(super) enum Nodes<'a, const D: usize> {
    /// Those of a grid, up to one beyond the domain: particles at its border have weights there.
    Grid {
        spacing: f64,
        domain: Bounds<D>,
        /// The box around them.
        room: Bounds<D>,
    },
    /// The vertices of a mesh with its layer.
    Mesh {
        whole: &'a SimplexMesh<D>,
        spacing: f64,
        /// The box around them and the places where particles may be.
        room: Bounds<D>,
    },
}

impl<'a, const D: usize> Nodes<'a, D> {
    pub fn of(scene: &Scene, background: &'a Background<D>) -> Self {
        let spacing = background.spacing();
        match background {
            Background::Grid { room, .. } => Self::Grid {
                spacing,
                domain: *room,
                room: grown(room, spacing),
            },
            Background::Mesh { whole, room, .. } => {
                let reach = scene.mesh.as_ref().map_or(0.0, |mesh| mesh.reach);
                Self::Mesh {
                    whole,
                    spacing,
                    room: grown(&Bounds::around(whole.vertices()), reach).hull(room),
                }
            }
        }
    }

    /// The box around all of them.
    pub fn room(&self) -> &Bounds<D> {
        match self {
            Self::Grid { room, .. } | Self::Mesh { room, .. } => room,
        }
    }

    /// h, or the mean edge.
    pub fn spacing(&self) -> f64 {
        match self {
            Self::Grid { spacing, .. } | Self::Mesh { spacing, .. } => *spacing,
        }
    }

    /// No place where particles may be is farther than this from a node.
    pub fn cell(&self) -> f64 {
        match self {
            Self::Grid { spacing, .. } => spacing * (D as f64).sqrt(),
            Self::Mesh { room, whole, .. } => {
                let inner = Bounds::around(whole.vertices());
                let beyond = (0..D).map(|a| (inner.lower[a] - room.lower[a]).max(room.upper[a] - inner.upper[a]));
                beyond.fold(whole.edge_lengths().longest, |sum, beyond| sum + beyond)
            }
        }
    }

    /// What they are, for messages.
    pub fn described(&self) -> String {
        match self {
            Self::Grid { spacing, domain, .. } => {
                let Bounds { lower, upper } = domain;
                format!("the grid of spacing {spacing:?} on the domain {lower:?} to {upper:?}")
            }
            Self::Mesh { room, .. } => {
                let Bounds { lower, upper } = room;
                format!("the mesh and its layer, {lower:?} to {upper:?}")
            }
        }
    }

    /// Whether a box has something in common with the one around the nodes.
    pub fn meet(&self, bounds: &Bounds<D>) -> bool {
        let common = self.room().overlap(bounds);
        (0..D).all(|a| common.lower[a] <= common.upper[a])
    }

    /// Whether a node is in a shape, or within a distance of it. Thin plates between the nodes of a large grid are taken for shapes that have one.
    pub fn come_as_near(&self, shape: &dyn Shape<D>, distance: f64) -> bool {
        self.found(&|x| shape.distance(x), distance).unwrap_or(true)
    }

    /// Whether there is a node with a function of at most a limit, no steeper than a distance; `None` where it has not been found out.
    pub fn found(&self, shape: &dyn Fn(&[f64; D]) -> f64, distance: f64) -> Option<bool> {
        match self {
            Self::Mesh { whole, .. } => Some(whole.vertices().iter().any(|x| shape(x) <= distance)),
            Self::Grid { spacing, domain, .. } => Lattice {
                origin: domain.lower.map(|c| c - spacing),
                spacing: *spacing,
                shape,
                distance,
            }
            .has_node(domain),
        }
    }
}

fn grown<const D: usize>(bounds: &Bounds<D>, by: f64) -> Bounds<D> {
    Bounds {
        lower: bounds.lower.map(|c| c - by),
        upper: bounds.upper.map(|c| c + by),
    }
}

/// A search for a node of a grid. Since no distance is more than the true one, the middle of a box tells of boxes that have none.
struct Lattice<'a, const D: usize> {
    origin: [f64; D],
    spacing: f64,
    shape: &'a dyn Fn(&[f64; D]) -> f64,
    distance: f64,
}

/// Nodes from `lower` to `upper`, and how far the shape is from their middle.
#[derive(Clone, Copy)]
struct Part<const D: usize> {
    lower: [u64; D],
    upper: [u64; D],
    distance: f64,
}

impl<const D: usize> Lattice<'_, D> {
    fn part(&self, lower: [u64; D], upper: [u64; D]) -> Part<D> {
        let middle = std::array::from_fn(|a| self.origin[a] + 0.5 * (lower[a] + upper[a]) as f64 * self.spacing);
        let distance = (self.shape)(&middle) - self.distance;
        Part { lower, upper, distance }
    }

    fn has_node(&self, domain: &Bounds<D>) -> Option<bool> {
        let upper = std::array::from_fn(|a| {
            let count = ((domain.upper[a] - domain.lower[a]) / self.spacing).ceil();
            (count.max(0.0) as u64).min(1 << 48) + 2
        });
        let mut parts = vec![self.part([0; D], upper)];
        for _ in 0..MOST_BOXES {
            let Some(part) = parts.pop() else { return Some(false) };
            let sides = (0..D).map(|a| ((part.upper[a] - part.lower[a]) as f64 * self.spacing).powi(2));
            let radius = 0.5 * sides.sum::<f64>().sqrt();
            if part.distance > radius {
                continue;
            }
            // No number at all is what the step will say something about.
            if part.distance <= -radius || part.distance.is_nan() {
                return Some(true);
            }
            let Some(axis) = (0..D).max_by_key(|&a| part.upper[a] - part.lower[a]) else {
                return Some(false);
            };
            let middle = part.lower[axis] + (part.upper[axis] - part.lower[axis]) / 2;
            let (mut left, mut right) = (part, part);
            left.upper[axis] = middle;
            right.lower[axis] = middle + 1;
            let halves = [left, right].map(|half| self.part(half.lower, half.upper));
            // The nearer one first.
            let last = usize::from(halves[1].distance < halves[0].distance);
            parts.extend([halves[1 - last], halves[last]]);
        }
        None
    }
}
