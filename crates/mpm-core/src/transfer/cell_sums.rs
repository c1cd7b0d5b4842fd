//! The nodes of one cell in lanes, shared by all its particles: no look-up and no check per particle and node.

use std::marker::PhantomData;

use mpm_kernels::{Deposit, Lanes, NodeSink, Packed, groups_of};

use super::{GridNode, StencilNodes};
use crate::Basis;

/// What the particles of one cell add to its nodes. Where every particle is a cell, the nodes are added to at once.
pub(crate) struct CellSums<'a, 'b, B, N, const D: usize> {
    stencil: &'a mut StencilNodes<'b, N>,
    /// Mass and momentum at the nodes, by place in the stencil.
    sums: &'a mut [Lanes],
    /// Impulses, where they are kept apart.
    impulses: &'a mut [Lanes],
    basis: PhantomData<B>,
}

impl<'a, 'b, B: Basis<D>, N: GridNode<D>, const D: usize> CellSums<'a, 'b, B, N, D> {
    /// Nothing yet. `lanes` is memory to work in.
    #[inline(always)]
    pub fn new(stencil: &'a mut StencilNodes<'b, N>, lanes: &'a mut Vec<Lanes>, with_impulses: bool) -> Self {
        let (mut sums, mut impulses) = (&mut [][..], &mut [][..]);
        if !B::LONE_PARTICLES {
            let size = stencil.numbers.len() * groups_of(D);
            let both = if with_impulses { 2 * size } else { size };
            lanes.clear();
            lanes.resize(both, Lanes::ZERO);
            (sums, impulses) = lanes[..both].split_at_mut(size);
        }
        Self {
            stencil,
            sums,
            impulses,
            basis: PhantomData,
        }
    }

    /// Where mass and momentum go.
    #[inline(always)]
    pub fn sums(&mut self) -> impl NodeSink<D> {
        Sums::<B, N, D, false> {
            stencil: self.stencil,
            lanes: self.sums,
            first: 0,
            basis: PhantomData,
        }
    }

    /// Where impulses go; only `with_impulses`.
    #[inline(always)]
    pub fn impulses(&mut self) -> impl NodeSink<D> {
        Sums::<B, N, D, true> {
            stencil: self.stencil,
            lanes: self.impulses,
            first: 0,
            basis: PhantomData,
        }
    }

    /// Hand everything to the nodes.
    #[inline(always)]
    pub fn close(self) {
        let Self {
            stencil,
            sums,
            impulses,
            ..
        } = self;
        match const { groups_of(D) } {
            1 => close::<1, D, N>(stencil, sums, impulses),
            2 => close::<2, D, N>(stencil, sums, impulses),
            3 => close::<3, D, N>(stencil, sums, impulses),
            _ => close::<4, D, N>(stencil, sums, impulses),
        }
    }
}

#[inline(always)]
fn close<const G: usize, const D: usize, N: GridNode<D>>(
    stencil: &mut StencilNodes<N>,
    sums: &[Lanes],
    impulses: &[Lanes],
) {
    stencil.for_each_with(sums.chunks_exact(G), |node, sum| {
        node.add(&Packed::<G>::read(sum).deposit());
    });
    stencil.for_each_with(impulses.chunks_exact(G), |node, sum| {
        node.add_impulse(&Packed::<G>::read(sum).deposit().vector);
    });
}

struct Sums<'a, 'b, B, N, const D: usize, const IMPULSES: bool> {
    stencil: &'a mut StencilNodes<'b, N>,
    /// Those of the places from `first` on; none with lone particles.
    lanes: &'a mut [Lanes],
    /// Place that counts as 0.
    first: usize,
    basis: PhantomData<B>,
}

impl<B: Basis<D>, N: GridNode<D>, const D: usize, const IMPULSES: bool> NodeSink<D>
    for Sums<'_, '_, B, N, D, IMPULSES>
{
    #[inline(always)]
    fn add(&mut self, index: usize, deposit: &Deposit<D>) {
        if !B::LONE_PARTICLES {
            match const { groups_of(D) } {
                1 => self.update(index, |sum: &Packed<1>| sum.plus_deposit(deposit)),
                2 => self.update(index, |sum: &Packed<2>| sum.plus_deposit(deposit)),
                3 => self.update(index, |sum: &Packed<3>| sum.plus_deposit(deposit)),
                _ => self.update(index, |sum: &Packed<4>| sum.plus_deposit(deposit)),
            }
        } else if IMPULSES {
            self.stencil.node(self.first + index).add_impulse(&deposit.vector);
        } else {
            self.stencil.node(self.first + index).add(deposit);
        }
    }

    #[inline(always)]
    fn update<const G: usize>(&mut self, index: usize, add: impl FnOnce(&Packed<G>) -> Packed<G>) {
        if B::LONE_PARTICLES {
            self.add(index, &add(&Packed::ZERO).deposit());
        } else {
            let sum = &mut self.lanes[index * G..][..G];
            add(&Packed::read(sum)).write(sum);
        }
    }

    #[inline(always)]
    fn window(&mut self, first: usize, length: usize) -> impl NodeSink<D> {
        Sums::<B, N, D, IMPULSES> {
            lanes: if B::LONE_PARTICLES {
                &mut []
            } else {
                &mut self.lanes[first * groups_of(D)..][..length * groups_of(D)]
            },
            stencil: self.stencil,
            first: self.first + first,
            basis: PhantomData,
        }
    }
}
