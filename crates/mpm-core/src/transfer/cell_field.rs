//! Vector fields at the nodes, as the particles of a cell read them.

use std::marker::PhantomData;

use mpm_kernels::{LANES, Lanes, NodeField, Packed, groups_of};

use super::GridNode;
use crate::{Basis, NO_NODE};

/// A vector field by number of the node.
pub(crate) trait GridField<const D: usize>: Copy {
    /// Number of nodes.
    fn node_count(&self) -> usize;

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
    fn node_count(&self) -> usize {
        self.0.len()
    }

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
    fn node_count(&self) -> usize {
        self.nodes.len()
    }

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
    /// Collect the field at the nodes of a cell of a basis.
    #[inline(always)]
    pub fn collect<const D: usize, B: Basis<D>>(&mut self, _: &B, numbers: &[u32], field: impl GridField<D>) {
        match const { groups_of(D) } {
            1 if B::NODES_SIDE_BY_SIDE => {
                self.0.resize(numbers.len(), Lanes::ZERO);
                let mut places = self.0.as_chunks_mut().0.iter_mut();
                numbers
                    .as_chunks()
                    .0
                    .iter()
                    .for_each(|&four| write_four(&mut places, four, field));
            }
            1 => self.collect_in::<1, D>(numbers, field),
            2 => self.collect_in::<2, D>(numbers, field),
            3 => self.collect_in::<3, D>(numbers, field),
            _ => self.collect_in::<4, D>(numbers, field),
        }
    }

    /// [`Basis::enter`] and [`collect`](Self::collect), in one go over the nodes where they are side by side.
    #[inline(always)]
    pub fn collect_entering<const D: usize, B: Basis<D>>(
        &mut self,
        basis: &B,
        (cell, collected): (usize, &mut B::Cell),
        numbers: &[u32],
        field: impl GridField<D>,
    ) {
        if B::NODES_SIDE_BY_SIDE {
            self.0.resize(numbers.len(), Lanes::ZERO);
            let mut places = self.0.as_chunks_mut().0.iter_mut();
            basis.enter_by_fours(cell, collected, field.node_count(), |four| {
                write_four(&mut places, four, field)
            });
        } else {
            basis.enter(cell, collected);
            self.collect(basis, numbers, field);
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

    /// The field at the `size` nodes of the cell.
    #[inline(always)]
    pub fn nodes<const D: usize, B: Basis<D>>(&self, _: &B, size: usize) -> Collected<'_, B> {
        Collected(&self.0[..size * groups_of(D)], PhantomData)
    }
}

/// The field at the next four nodes, side by side.
#[inline(always)]
fn write_four<'a, const D: usize>(
    places: &mut impl Iterator<Item = &'a mut [Lanes; LANES]>,
    [a, b, c, d]: [u32; LANES],
    field: impl GridField<D>,
) {
    let at = |number: u32| field.packed::<1>(number as usize).lanes()[0];
    if let Some(lanes) = places.next() {
        // What has no meaning is not written.
        lanes[1..].copy_from_slice(&Lanes::transpose([at(a), at(b), at(c), at(d)])[1..]);
    }
}

/// A collected field; `B` says how it lies in memory.
pub(crate) struct Collected<'a, B>(&'a [Lanes], PhantomData<B>);

impl<const D: usize, B: Basis<D>> NodeField<D> for Collected<'_, B> {
    #[inline(always)]
    fn vector(&self, index: usize) -> [f64; D] {
        let place = |component: usize| match B::NODES_SIDE_BY_SIDE {
            true => (index / LANES * LANES + component, index % LANES),
            false => (index * groups_of(D) + component / LANES, component % LANES),
        };
        let mut vector = [0.0; D];
        for a in 0..D {
            let (lanes, lane) = place(a + 1);
            vector[a] = self.0[lanes].as_array()[lane];
        }
        vector
    }

    #[inline(always)]
    fn packed<const G: usize>(&self, index: usize) -> Packed<G> {
        if B::NODES_SIDE_BY_SIDE {
            return Packed::new(0.0, &NodeField::<D>::vector(self, index));
        }
        Packed::read(&self.0[index * G..][..G])
    }

    #[inline(always)]
    fn by_fours(&self) -> impl Iterator<Item = [Lanes; LANES]> {
        let side_by_side = |four: &[Lanes; LANES]| match B::NODES_SIDE_BY_SIDE {
            true => *four,
            false => Lanes::transpose(*four),
        };
        self.0.as_chunks().0.iter().map(side_by_side)
    }

    #[inline(always)]
    fn window(&self, first: usize, length: usize) -> impl NodeField<D> {
        Collected(&self.0[first * groups_of(D)..][..length * groups_of(D)], self.1)
    }
}
