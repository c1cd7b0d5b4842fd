//! Which nodes a contact acts on, and what it gives them.

use mpm_tensor::vector;

use super::minimum::{NodeProblem, Share};
use super::{ContactPoint, ContactPotential};
use crate::counting_sort::counting_sort;
use crate::{Basis, GridNode, MpmError, Sites};

/// The particles in contact by the nodes around them; the memory is kept between steps.
#[derive(Debug)]
pub(crate) struct NodalContact<const D: usize> {
    points: Vec<ContactPoint<D>>,
    /// Node, point and weight of every pair of them, in the order of the particles.
    nodes: Vec<u32>,
    pairs: Vec<(u32, f64)>,
    /// The pairs in the order of their nodes, and the first of every node.
    order: Vec<u32>,
    starts: Vec<u32>,
    cursors: Vec<u32>,
    /// Nodes with a pair.
    touched: Vec<u32>,
}

impl<const D: usize> Default for NodalContact<D> {
    fn default() -> Self {
        Self {
            points: Vec::new(),
            nodes: Vec::new(),
            pairs: Vec::new(),
            order: Vec::new(),
            starts: Vec::new(),
            cursors: Vec::new(),
            touched: Vec::new(),
        }
    }
}

/// Nodes of one piece of work.
const PIECE: usize = 1 << 6;

impl<const D: usize> NodalContact<D> {
    /// Change the velocities of the nodes as [`ContactPotential`] says, with e^(−γΔt) = `damping`. No particle goes farther than `reach`. `given(node, m_i Δv_i)` is told the impulse of
    /// every node that gets some.
    /// Nodes of no mass and of negative mass, which negative weights may leave, are left alone.
    ///
    /// # Errors
    /// [`MpmError::Penetration`] with the particle's place in the present order.
    pub fn act<B: Basis<D>, N: GridNode<D>>(
        &mut self,
        basis: &B,
        potential: &dyn ContactPotential<D>,
        sites: &Sites<D>,
        (time_step, damping, reach): (f64, f64, f64),
        nodes: &mut [N],
        given: &mut dyn FnMut(usize, [f64; D]),
    ) -> Result<(), MpmError> {
        self.points.clear();
        potential.points(sites, reach, &mut self.points);
        let is_outside = |point: &&ContactPoint<D>| point.distance > 0.0;
        if let Some(point) = self.points.iter().find(|point| !is_outside(point)) {
            return Err(MpmError::Penetration {
                particle: point.particle,
                distance: point.distance,
            });
        }
        self.pair(basis, potential, sites.positions, &|node, normal| {
            time_step * vector::dot(normal, nodes[node].velocity())
        });
        self.sort(nodes.len(), &|node| nodes[node].mass() >= f64::MIN_POSITIVE);
        let free = self.touched.iter().map(|&node| nodes[node as usize]);
        let free: Vec<(f64, [f64; D])> = free.map(|node| (node.mass(), *node.velocity())).collect();
        let solved = mpm_parallel::collect(free.len(), PIECE, &|k| {
            self.velocity(self.touched[k] as usize, &free[k], (time_step, damping), potential)
        });
        for ((&node, (mass, before)), after) in self.touched.iter().zip(&free).zip(solved) {
            *nodes[node as usize].velocity_mut() = after;
            given(node as usize, vector::scale(&vector::subtract(&after, before), *mass));
        }
        Ok(())
    }

    /// List the nodes of all points of which one comes so near by `approach`, its way along a normal, that the potential begins.
    fn pair<B: Basis<D>>(
        &mut self,
        basis: &B,
        potential: &dyn ContactPotential<D>,
        positions: &[[f64; D]],
        approach: &dyn Fn(usize, &[f64; D]) -> f64,
    ) {
        let Self {
            points, nodes, pairs, ..
        } = self;
        nodes.clear();
        pairs.clear();
        let (schedule, mut cell, mut scratch) = (basis.schedule(), 0, Vec::new());
        for (number, point) in points.iter().enumerate() {
            let p = point.particle;
            if p < schedule.cell(cell).start {
                cell = 0;
            }
            while schedule.cell(cell).end <= p {
                cell += 1;
            }
            let (numbers, first) = (basis.cell_nodes(cell, &mut scratch), nodes.len());
            let mut nearest = point.distance;
            basis.for_each_node(p, &positions[p], |index, entry| {
                if entry.weight != 0.0 {
                    let node = numbers[index];
                    nearest = nearest.min(point.distance + approach(node as usize, &point.normal));
                    nodes.push(node);
                    pairs.push((number as u32, entry.weight));
                }
            });
            if nearest > 0.0 && potential.pressure_and_stiffness(nearest).0 == 0.0 {
                nodes.truncate(first);
                pairs.truncate(first);
            }
        }
    }

    /// Sort the pairs by node, and list the nodes that have some and can be pushed.
    fn sort(&mut self, node_count: usize, can_be_pushed: &dyn Fn(usize) -> bool) {
        let Self {
            starts, order, cursors, ..
        } = self;
        counting_sort(&self.nodes, node_count, starts, order, cursors);
        let some = (0..node_count).filter(|&node| starts[node] < starts[node + 1] && can_be_pushed(node));
        self.touched.clear();
        self.touched.extend(some.map(|node| node as u32));
    }

    /// The velocity of a node of this mass and velocity without contact.
    fn velocity(
        &self,
        node: usize,
        (mass, velocity): &(f64, [f64; D]),
        (time_step, damping): (f64, f64),
        potential: &dyn ContactPotential<D>,
    ) -> [f64; D] {
        let pairs = self.order[self.starts[node] as usize..self.starts[node + 1] as usize].iter();
        let shares = pairs.map(|&pair| {
            let (point, weight) = self.pairs[pair as usize];
            (&self.points[point as usize], weight)
        });
        let shares: Vec<Share<D>> = shares.collect();
        let problem = NodeProblem {
            inertia: mass / (time_step * time_step * damping),
            free: vector::scale(velocity, time_step),
            shares: &shares,
            potential,
        };
        vector::scale(&problem.minimum(), 1.0 / time_step)
    }

    /// Bytes held.
    pub fn storage_bytes(&self) -> usize {
        let numbers = [&self.nodes, &self.order, &self.starts, &self.cursors, &self.touched];
        numbers.map(Vec::capacity).iter().sum::<usize>() * size_of::<u32>()
            + self.pairs.capacity() * size_of::<(u32, f64)>()
            + self.points.capacity() * size_of::<ContactPoint<D>>()
    }
}
