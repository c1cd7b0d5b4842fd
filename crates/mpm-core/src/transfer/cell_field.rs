//! Vector fields at the nodes, as the particles of a cell read them.

use mpm_kernels::{LANES, Lanes, NodeField, Packed, groups_of};

use super::GridNode;
use crate::NO_NODE;

/// A vector field by number of the node.
pub(crate) trait GridField<const D: usize>: Copy {
    /// The vector at a node.
    fn vector(&self, number: usize) -> [f64; D];

    /// The same as the vector of a deposit, whose scalar has no meaning.
    #[inline(always)]
    fn packed<const G: usize>(&self, number: usize) -> Packed<G> {
        Packed::new(0.0, &self.vector(number))
    }
}

/// v_i.
#[derive(Debug)]
pub(crate) struct Velocities<'a, N, const D: usize>(pub &'a [N]);

/// v_iⁿ⁺¹ − damping v_iⁿ.
#[derive(Debug)]
pub(crate) struct Changes<'a, N, const D: usize> {
    pub nodes: &'a [N],
    pub damping: f64,
}

impl<N, const D: usize> Clone for Velocities<'_, N, D> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<N, const D: usize> Copy for Velocities<'_, N, D> {}

impl<N, const D: usize> Clone for Changes<'_, N, D> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<N, const D: usize> Copy for Changes<'_, N, D> {}

impl<N: GridNode<D>, const D: usize> GridField<D> for Velocities<'_, N, D> {
    #[inline(always)]
    fn vector(&self, number: usize) -> [f64; D] {
        *self.0[number].velocity()
    }

    #[inline(always)]
    fn packed<const G: usize>(&self, number: usize) -> Packed<G> {
        self.0[number].packed_velocity()
    }
}

impl<N: GridNode<D>, const D: usize> GridField<D> for Changes<'_, N, D> {
    #[inline(always)]
    fn vector(&self, number: usize) -> [f64; D] {
        self.nodes[number].change(self.damping)
    }
}

/// A field read through the node numbers of a cell.
pub(crate) struct Numbered<'a, F> {
    pub field: F,
    pub numbers: &'a [u32],
}

impl<F: GridField<D>, const D: usize> NodeField<D> for Numbered<'_, F> {
    #[inline(always)]
    fn vector(&self, index: usize) -> [f64; D] {
        self.field.vector(self.numbers[index] as usize)
    }

    #[inline(always)]
    fn packed<const G: usize>(&self, index: usize) -> Packed<G> {
        self.field.packed(self.numbers[index] as usize)
    }
}

/// A field collected at the nodes of a cell with several particles: no look-up and no check per particle and node.
#[derive(Default)]
pub(crate) struct CellField(Vec<Lanes>);

impl CellField {
    /// Collect the field at the nodes of a cell.
    #[inline(always)]
    pub fn collect<const D: usize>(&mut self, numbers: &[u32], field: impl GridField<D>) {
        match const { groups_of(D) } {
            1 => self.collect_in::<1, D>(numbers, field),
            2 => self.collect_in::<2, D>(numbers, field),
            3 => self.collect_in::<3, D>(numbers, field),
            _ => self.collect_in::<4, D>(numbers, field),
        }
    }

    #[inline(always)]
    fn collect_in<const G: usize, const D: usize>(&mut self, numbers: &[u32], field: impl GridField<D>) {
        self.0.resize(numbers.len() * G, Lanes::ZERO);
        for (lanes, &number) in self.0.chunks_exact_mut(G).zip(numbers) {
            if number != NO_NODE {
                field.packed::<G>(number as usize).write(lanes);
            }
        }
    }

    /// The field at the `size` nodes.
    #[inline(always)]
    pub fn nodes<const D: usize>(&self, size: usize) -> impl NodeField<D> {
        Collected(&self.0[..size * groups_of(D)])
    }
}

struct Collected<'a>(&'a [Lanes]);

impl<const D: usize> NodeField<D> for Collected<'_> {
    #[inline(always)]
    fn vector(&self, index: usize) -> [f64; D] {
        let at = |component: usize| self.0[index * groups_of(D) + component / LANES].to_array()[component % LANES];
        std::array::from_fn(|a| at(a + 1))
    }

    #[inline(always)]
    fn packed<const G: usize>(&self, index: usize) -> Packed<G> {
        Packed::read(&self.0[index * G..][..G])
    }

    #[inline(always)]
    fn window(&self, first: usize, length: usize) -> impl NodeField<D> {
        Collected(&self.0[first * groups_of(D)..][..length * groups_of(D)])
    }
}
