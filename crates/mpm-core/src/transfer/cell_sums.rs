//! The nodes of one cell in lanes, shared by all its particles: no look-up and no check per particle and node. A particle that has a cell for itself adds to the nodes
//! at once where four are added to side by side: from zero, its sums are what it adds.

use std::marker::PhantomData;

use mpm_kernels::{Deposit, LANES, Lanes, NodeSink, Packed, groups_of};

use super::{GridNode, StencilNodes};
use crate::Basis;

/// What the particles of one cell add to its nodes. Where every particle is a cell, the nodes are added to at once.
pub(crate) struct CellSums<'a, 'b, B, N, const D: usize> {
    stencil: &'a mut StencilNodes<'b, N>,
    /// Mass and momentum at the nodes, by place in the stencil.
    sums: &'a mut [Lanes],
    /// Impulses, where they are kept apart.
    impulses: &'a mut [Lanes],
    /// Whether there are no sums here, and nodes are added to at once.
    at_once: bool,
    basis: PhantomData<B>,
}

impl<'a, 'b, B: Basis<D>, N: GridNode<D>, const D: usize> CellSums<'a, 'b, B, N, D> {
    /// Nothing yet. `lanes` is memory to work in; `alone`: one particle will add, and once to all sums.
    #[inline(always)]
    pub fn new(
        stencil: &'a mut StencilNodes<'b, N>,
        lanes: &'a mut Vec<Lanes>,
        with_impulses: bool,
        alone: bool,
    ) -> Self {
        let (mut sums, mut impulses) = (&mut [][..], &mut [][..]);
        let at_once = B::LONE_PARTICLES || (B::NODES_SIDE_BY_SIDE && alone);
        if !at_once {
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
            at_once,
            basis: PhantomData,
        }
    }

    /// Where mass and momentum go.
    #[inline(always)]
    pub fn sums(&mut self) -> impl NodeSink<D> {
        Sums::<B, N, D, false> {
            stencil: self.stencil.all(),
            lanes: self.sums,
            at_once: self.at_once,
            basis: PhantomData,
        }
    }

    /// Where impulses go; only `with_impulses`.
    #[inline(always)]
    pub fn impulses(&mut self) -> impl NodeSink<D> {
        Sums::<B, N, D, true> {
            stencil: self.stencil.all(),
            lanes: self.impulses,
            at_once: self.at_once,
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

struct Sums<'a, B, N, const D: usize, const IMPULSES: bool> {
    /// By value, so that what is written to the nodes cannot change where they are.
    stencil: StencilNodes<'a, N>,
    /// None with lone particles.
    lanes: &'a mut [Lanes],
    at_once: bool,
    basis: PhantomData<B>,
}

impl<B: Basis<D>, N, const D: usize, const IMPULSES: bool> Sums<'_, B, N, D, IMPULSES> {
    /// Whether nodes are added to at once: known when this is compiled unless nodes are added to side by side.
    #[inline(always)]
    fn at_once(&self) -> bool {
        B::LONE_PARTICLES || (B::NODES_SIDE_BY_SIDE && self.at_once)
    }
}

impl<B: Basis<D>, N: GridNode<D>, const D: usize, const IMPULSES: bool> NodeSink<D> for Sums<'_, B, N, D, IMPULSES> {
    #[inline(always)]
    fn add(&mut self, index: usize, deposit: &Deposit<D>) {
        if !self.at_once() {
            match const { groups_of(D) } {
                1 => self.update(index, |sum: &Packed<1>| sum.plus_deposit(deposit)),
                2 => self.update(index, |sum: &Packed<2>| sum.plus_deposit(deposit)),
                3 => self.update(index, |sum: &Packed<3>| sum.plus_deposit(deposit)),
                _ => self.update(index, |sum: &Packed<4>| sum.plus_deposit(deposit)),
            }
        } else if IMPULSES {
            self.stencil.node(index).add_impulse(&deposit.vector);
        } else {
            self.stencil.node(index).add(deposit);
        }
    }

    #[inline(always)]
    fn update<const G: usize>(&mut self, index: usize, add: impl FnOnce(&Packed<G>) -> Packed<G>) {
        if self.at_once() {
            self.add(index, &add(&Packed::ZERO).deposit());
        } else {
            let sum = &mut self.lanes[index * G..][..G];
            add(&Packed::read(sum)).write(sum);
        }
    }

    #[inline(always)]
    fn add_rows(&mut self, first: usize, rows: &[Lanes; LANES]) {
        if self.at_once() {
            self.stencil.part(first, LANES).for_each_with(rows.iter(), |node, row| {
                let deposit = Packed::<1>::read(std::slice::from_ref(row)).deposit();
                if IMPULSES {
                    node.add_impulse(&deposit.vector);
                } else {
                    node.add(&deposit);
                }
            });
        } else {
            for (sum, row) in self.lanes[first..first + LANES].iter_mut().zip(rows) {
                *sum += *row;
            }
        }
    }

    #[inline(always)]
    fn window(&mut self, first: usize, length: usize) -> impl NodeSink<D> {
        Sums::<B, N, D, IMPULSES> {
            at_once: self.at_once,
            lanes: if self.at_once() {
                &mut []
            } else {
                &mut self.lanes[first * groups_of(D)..][..length * groups_of(D)]
            },
            stencil: self.stencil.part(first, length),
            basis: PhantomData,
        }
    }
}
