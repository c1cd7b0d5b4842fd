//! Particles → nodes: every particle adds to the nodes of its stencil, in an order that no thread count changes.

use std::marker::PhantomData;

use rayon::prelude::*;

use crate::Basis;

/// Below this many stencil visits a colour is worked off by one thread: waking others costs more.
const PARALLEL_THRESHOLD: usize = 1 << 14;

/// Call `deposit(p, x_p, stencil)` for every particle p (schedule order); it adds to the nodes of the particle's stencil.
///
/// `positions` are in schedule order and `nodes` has one entry per active node of the basis.
pub fn scatter<const D: usize, B, N>(
    basis: &B,
    positions: &[[f64; D]],
    nodes: &mut [N],
    deposit: impl Fn(usize, &[f64; D], &mut StencilNodes<N>) + Sync,
) where
    B: Basis<D>,
    N: Send,
{
    let schedule = basis.schedule();
    let shared = SharedNodes::new(nodes);
    let work = |cell_nodes: &mut Vec<u32>, group: usize| {
        for cell in schedule.group(group) {
            basis.cell_nodes(cell, cell_nodes);
            shared.check(cell_nodes);
            let mut stencil = StencilNodes {
                numbers: &cell_nodes[..basis.stencil_size()], // a constant length: no check per node
                nodes: &shared,
            };
            for particle in schedule.cell(cell) {
                deposit(particle, &positions[particle], &mut stencil);
            }
        }
    };
    let several_threads = rayon::current_num_threads() > 1;
    let mut own_cell_nodes = Vec::new();
    for groups in schedule.colours() {
        let particles: usize = groups
            .iter()
            .map(|&group| schedule.group_particles(group as usize).len())
            .sum();
        let visits = particles * basis.stencil_size();
        if several_threads && groups.len() > 1 && visits > PARALLEL_THRESHOLD {
            groups
                .par_iter()
                .for_each_init(Vec::new, |cell_nodes, &group| work(cell_nodes, group as usize));
        } else {
            for &group in groups {
                work(&mut own_cell_nodes, group as usize);
            }
        }
    }
}

/// The nodes of one cell's stencils.
pub struct StencilNodes<'a, N> {
    numbers: &'a [u32],
    nodes: &'a SharedNodes<'a, N>,
}

impl<N> StencilNodes<'_, N> {
    /// The node at a place of the stencil, as counted by [`Basis::for_each_node`].
    #[inline(always)]
    pub fn node(&mut self, index: usize) -> &mut N {
        // SAFETY: all numbers were checked against the slice. No other reference to the node lives: within the group the
        // result borrows `self`; other groups that run now have the same colour, hence other nodes (the contract of
        // `Basis`); colours follow one another.
        //
        // Gain: the safe alternative that threads can share, nodes of relaxed atomics under the same colouring, makes a step
        // 1.16, 1.27, 1.32 times as long for D = 2, 3 (M = 10⁵), 6 (M = 2·10⁴) on one thread, and as much on two. Two threads
        // take a step 1.5, 1.3, 1.6 times as fast as one (quadratic splines, PIC, minima on a shared machine of two cores;
        // `RAYON_NUM_THREADS=2 cargo bench -p parvi-benches --bench step` against `=1`).
        #[allow(unsafe_code)]
        unsafe {
            &mut *self.nodes.first.add(self.numbers[index] as usize)
        }
    }
}

/// A mutable slice that several threads write to at places that never coincide.
struct SharedNodes<'a, N> {
    first: *mut N,
    count: usize,
    borrow: PhantomData<&'a mut [N]>,
}

// SAFETY: nodes are reached through `StencilNodes::node` alone, which hands out each to one thread at a time.
#[allow(unsafe_code)]
unsafe impl<N: Send> Sync for SharedNodes<'_, N> {}

impl<'a, N> SharedNodes<'a, N> {
    fn new(nodes: &'a mut [N]) -> Self {
        Self {
            first: nodes.as_mut_ptr(),
            count: nodes.len(),
            borrow: PhantomData,
        }
    }

    /// Check, once per cell, that all node numbers are in range.
    #[inline]
    fn check(&self, numbers: &[u32]) {
        let largest = numbers.iter().fold(0, |largest, &number| largest.max(number));
        assert!(
            numbers.is_empty() || (largest as usize) < self.count,
            "a basis numbered a node {largest} of {}",
            self.count
        );
    }
}
