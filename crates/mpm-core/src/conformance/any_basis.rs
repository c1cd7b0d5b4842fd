//! A basis behind `dyn`.

use mpm_kernels::{Deposit, Entry, Interpolated, NodeField, NodeSink, Packed, Wanted};
use mpm_tensor::Matrix;

use crate::{Basis, Member, MpmError, NodeSums, Schedule, Sum};

/// A particle of a cell.
#[derive(Clone, Copy, Debug)]
pub struct Located<'a, const D: usize> {
    /// The cell of the schedule.
    pub cell: usize,
    /// Place in the schedule.
    pub particle: usize,
    /// The position that it was activated with.
    pub x: &'a [f64; D],
}

/// Value and scale of a particle, by its place in the schedule and its position.
pub type Sent<'a, const D: usize> = dyn Fn(usize, &[f64; D]) -> (Deposit<D>, f64) + Sync + 'a;

/// A [`Basis`] of which only the dimension is known: a test of many bases is compiled once per dimension and not once per basis. Methods
/// without a page of their own are those of the basis.
#[allow(missing_docs, reason = "they stand at the basis")]
pub trait AnyBasis<const D: usize> {
    fn rebuild(&mut self, positions: &[[f64; D]]) -> Result<Vec<[f64; D]>, MpmError>;
    fn schedule(&self) -> &Schedule;
    fn node_count(&self) -> usize;
    fn node_positions(&self, out: &mut Vec<[f64; D]>);
    fn spacing(&self) -> f64;
    fn stencil_size(&self) -> usize;
    fn cell_stencil_size(&self, cell: usize) -> usize;
    fn cell_nodes<'a>(&'a self, cell: usize, scratch: &'a mut Vec<u32>) -> &'a [u32];
    fn for_each_node(&self, particle: usize, x: &[f64; D], visit: &mut dyn FnMut(usize, &Entry<D>));
    fn for_each_deposit(
        &self,
        particle: usize,
        x: &[f64; D],
        value: &Deposit<D>,
        scale: f64,
        visit: &mut dyn FnMut(usize, f64, &Deposit<D>),
    );
    fn affine_direction(&self, particle: usize, x: &[f64; D], entry: &Entry<D>) -> [f64; D];

    /// [`Basis::deposit`] with a matrix for the affine part and one for the flux.
    fn deposit_matrices(
        &self,
        member: Located<D>,
        value: &Deposit<D>,
        affine: &Matrix<D>,
        flux: &Matrix<D>,
        nodes: &mut [Deposit<D>],
    );

    /// [`Basis::deposit`] without an affine part, and a pressure for the flux.
    fn deposit_pressure(&self, member: Located<D>, value: &Deposit<D>, pressure: f64, nodes: &mut [Deposit<D>]);

    fn deposit_scalars(&self, member: Located<D>, scalars: [f64; 2], sums: [&mut [f64]; 2]);
    fn interpolate_scalar(&self, member: Located<D>, nodes: &[f64]) -> f64;

    /// [`Basis::interpolate`] of the vectors of the nodes.
    fn interpolate(&self, member: Located<D>, wanted: Wanted, nodes: &[Deposit<D>]) -> Interpolated<D>;

    /// [`NodeSums::scatter`] of what [`for_each_deposit`](Self::for_each_deposit) gives for what each particle sends.
    fn scatter(&self, sorted: &[[f64; D]], value: &Sent<D>) -> Vec<Deposit<D>>;
}

impl<const D: usize, B: Basis<D>> AnyBasis<D> for B {
    fn rebuild(&mut self, positions: &[[f64; D]]) -> Result<Vec<[f64; D]>, MpmError> {
        Basis::rebuild(self, positions)
    }

    fn schedule(&self) -> &Schedule {
        Basis::schedule(self)
    }

    fn node_count(&self) -> usize {
        Basis::node_count(self)
    }

    fn node_positions(&self, out: &mut Vec<[f64; D]>) {
        Basis::node_positions(self, out);
    }

    fn spacing(&self) -> f64 {
        Basis::spacing(self)
    }

    fn stencil_size(&self) -> usize {
        Basis::stencil_size(self)
    }

    fn cell_stencil_size(&self, cell: usize) -> usize {
        Basis::cell_stencil_size(self, cell)
    }

    fn cell_nodes<'a>(&'a self, cell: usize, scratch: &'a mut Vec<u32>) -> &'a [u32] {
        Basis::cell_nodes(self, cell, scratch)
    }

    fn for_each_node(&self, particle: usize, x: &[f64; D], visit: &mut dyn FnMut(usize, &Entry<D>)) {
        Basis::for_each_node(self, particle, x, visit);
    }

    fn for_each_deposit(
        &self,
        particle: usize,
        x: &[f64; D],
        value: &Deposit<D>,
        scale: f64,
        visit: &mut dyn FnMut(usize, f64, &Deposit<D>),
    ) {
        Basis::for_each_deposit(self, particle, x, value, scale, visit);
    }

    fn affine_direction(&self, particle: usize, x: &[f64; D], entry: &Entry<D>) -> [f64; D] {
        Basis::affine_direction(self, particle, x, entry)
    }

    fn deposit_matrices(
        &self,
        member: Located<D>,
        value: &Deposit<D>,
        affine: &Matrix<D>,
        flux: &Matrix<D>,
        nodes: &mut [Deposit<D>],
    ) {
        let cell = entered(self, member.cell);
        self.deposit(within(&cell, member), value, affine, flux, &mut Sums(nodes));
    }

    fn deposit_pressure(&self, member: Located<D>, value: &Deposit<D>, pressure: f64, nodes: &mut [Deposit<D>]) {
        let cell = entered(self, member.cell);
        self.deposit(within(&cell, member), value, &(), &pressure, &mut Sums(nodes));
    }

    fn deposit_scalars(&self, member: Located<D>, scalars: [f64; 2], sums: [&mut [f64]; 2]) {
        let cell = entered(self, member.cell);
        Basis::deposit_scalars(self, within(&cell, member), scalars, sums);
    }

    fn interpolate_scalar(&self, member: Located<D>, nodes: &[f64]) -> f64 {
        let cell = entered(self, member.cell);
        Basis::interpolate_scalar(self, within(&cell, member), nodes)
    }

    fn interpolate(&self, member: Located<D>, wanted: Wanted, nodes: &[Deposit<D>]) -> Interpolated<D> {
        let cell = entered(self, member.cell);
        Basis::interpolate(self, within(&cell, member), wanted, &Field(nodes))
    }

    fn scatter(&self, sorted: &[[f64; D]], value: &Sent<D>) -> Vec<Deposit<D>> {
        let mut sums = NodeSums::<NodeSum<D>>::default();
        sums.scatter(self, sorted, |particle, x, stencil| {
            let (value, scale) = value(particle, x);
            Basis::for_each_deposit(self, particle, x, &value, scale, |index, _, deposit| {
                stencil.node(index).0.add(deposit);
            });
        });
        sums.as_slice().iter().map(|sum| sum.0).collect()
    }
}

/// What the basis collects of a cell.
fn entered<const D: usize, B: Basis<D>>(basis: &B, cell: usize) -> B::Cell {
    let mut collected = B::Cell::default();
    basis.enter(cell, &mut collected);
    collected
}

fn within<'a, C, const D: usize>(cell: &'a C, Located { particle, x, .. }: Located<'a, D>) -> Member<'a, C, D> {
    Member { cell, particle, x }
}

/// Sums of the nodes of a stencil.
struct Sums<'a, const D: usize>(&'a mut [Deposit<D>]);

impl<const D: usize> NodeSink<D> for Sums<'_, D> {
    fn add(&mut self, index: usize, deposit: &Deposit<D>) {
        self.0[index].add(deposit);
    }

    fn update<const G: usize>(&mut self, index: usize, add: impl FnOnce(&Packed<G>) -> Packed<G>) {
        let before = &self.0[index];
        self.0[index] = add(&Packed::new(before.scalar, &before.vector)).deposit();
    }
}

/// Vectors of the nodes of a stencil.
struct Field<'a, const D: usize>(&'a [Deposit<D>]);

impl<const D: usize> NodeField<D> for Field<'_, D> {
    fn vector(&self, index: usize) -> [f64; D] {
        self.0[index].vector
    }

    fn packed<const G: usize>(&self, index: usize) -> Packed<G> {
        Packed::new(0.0, &self.0[index].vector)
    }
}

/// The sum at a node.
#[derive(Clone, Copy)]
struct NodeSum<const D: usize>(Deposit<D>);

impl<const D: usize> Default for NodeSum<D> {
    fn default() -> Self {
        Self(Deposit::ZERO)
    }
}

impl<const D: usize> Sum for NodeSum<D> {
    fn merge(&mut self, other: &Self) {
        self.0.add(&other.0);
    }
}
