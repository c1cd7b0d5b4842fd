//! What a rigid surface gives the nodes at it, and when: bodies meet it where their material is, not where the nodes around them are.

use mpm_tensor::vector;

use super::{Contact, GridMotion};
use crate::{Basis, GridNode};

/// Nodes this close to a wall, to the surface of an obstacle or to a region whose velocity is given, in spacings, are on it: rounding is not to decide.
pub const ON_A_SURFACE: f64 = 1e-6;

/// Places and sizes of the particles, in the present order.
#[derive(Clone, Copy)]
pub struct Extents<'a, const D: usize> {
    /// x_p.
    pub positions: &'a [[f64; D]],
    /// V_p ≥ 0 by number; 0 of points.
    pub volume: &'a dyn Fn(usize) -> f64,
}

/// A rigid surface as the nodes see it.
pub(super) struct Surface<'a, const D: usize> {
    pub contact: Contact,
    /// Its velocity.
    pub velocity: &'a [f64; D],
    /// Distance d(x) of a particle.
    pub distance: &'a dyn Fn(&[f64; D]) -> f64,
    /// Unit normal at a node, towards the material.
    pub normal: &'a dyn Fn(&[f64; D]) -> [f64; D],
    /// The mirror image of a node behind it, where material may leave.
    pub image: &'a dyn Fn(&[f64; D]) -> Option<[f64; D]>,
}

impl<const D: usize> Surface<'_, D> {
    /// Change the velocities of the nodes that are `at` it, and of their images.
    ///
    /// Material that may leave meets the surface halfway between a node i and its image j: (v_i + v_j) / 2 obeys the condition, by the same impulse on both. Held alone, i would make what is pressed against the surface
    /// softer there.
    pub fn act<B: Basis<D>, N: GridNode<D>>(
        &self,
        basis: &B,
        motion: &GridMotion<D>,
        at: &[usize],
        (masses, gaps): (&[f64], &mut Vec<f64>),
        nodes: &mut [N],
    ) {
        if at.is_empty() {
            return;
        }
        gaps.clear();
        let separate = matches!(self.contact, Contact::Separate { .. });
        if separate {
            self.measure(basis, motion, gaps, nodes);
        }
        for &node in at {
            let closing = gaps.get(node).map_or(0.0, |gap| gap / motion.time_step);
            let x = &motion.positions[node];
            let normal = (self.normal)(x);
            let image = (self.image)(x).filter(|_| separate).and_then(|x| basis.node_number(&x));
            let other = image.map_or(node, |other| other as usize);
            // Negative weights make negative masses.
            let other = if masses[node].min(masses[other]) > 0.0 {
                other
            } else {
                node
            };
            let mean = vector::add_scaled(
                &vector::scale(nodes[node].velocity(), 0.5),
                0.5,
                nodes[other].velocity(),
            );
            let relative = vector::subtract(&mean, self.velocity);
            let left = self.contact.resolve_at(&normal, &relative, closing);
            if other == node {
                *nodes[node].velocity_mut() = vector::add(self.velocity, &left);
                continue;
            }
            let change = vector::scale(
                &vector::subtract(&left, &relative),
                2.0 / (masses[node] + masses[other]),
            );
            vector::accumulate(nodes[node].velocity_mut(), masses[other], &change);
            vector::accumulate(nodes[other].velocity_mut(), masses[node], &change);
        }
    }

    /// g_i ≥ 0 of all nodes: the least d(x_p) − r_p of the particles that node i has a share in, r_p = V_p^(1/D) / 2, ∞ where none can reach the surface in this step.
    fn measure<B: Basis<D>, N: GridNode<D>>(
        &self,
        basis: &B,
        motion: &GridMotion<D>,
        gaps: &mut Vec<f64>,
        nodes: &[N],
    ) {
        gaps.resize(nodes.len(), f64::INFINITY);
        let speeds = nodes
            .iter()
            .map(|node| vector::distance(node.velocity(), self.velocity));
        let reach = motion.time_step * speeds.fold(0.0, f64::max);
        let (extents, schedule, mut scratch) = (&motion.extents, basis.schedule(), Vec::new());
        for cell in 0..schedule.cell_count() {
            for p in schedule.cell(cell) {
                let (x, volume) = (&extents.positions[p], (extents.volume)(p));
                let distance = (self.distance)(x);
                if (2.0 * (distance - reach).max(0.0)).powi(D as i32) > volume {
                    continue;
                }
                let gap = (distance - 0.5 * volume.powf(1.0 / D as f64)).max(0.0);
                let numbers = basis.cell_nodes(cell, &mut scratch);
                basis.for_each_node(p, x, |index, entry| {
                    if entry.weight != 0.0 {
                        let least = &mut gaps[numbers[index] as usize];
                        *least = least.min(gap);
                    }
                });
            }
        }
    }
}
