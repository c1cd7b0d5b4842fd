//! Particles whose weights are kept positive, node by node: they are few, and what the lanes do rests on weights that are affine in r but for d′.

use mpm_core::{Basis, Member};
use mpm_kernels::{Columns, Deposit, Interpolated, NodeField, NodeSink, Wanted};

use super::MeshBasis;
use super::cell_ring::CellRing;

impl<const D: usize> MeshBasis<D> {
    /// Whether the weights of a particle are other than those of least squares.
    #[inline(always)]
    pub(super) fn is_kept_positive(&self, particle: usize) -> bool {
        self.floors.get(particle).is_some_and(|floor| floor.is_reached())
    }

    /// As [`Basis::deposit`].
    #[cold]
    #[inline(never)]
    pub(super) fn deposit_one_by_one<A: Columns<D>, S: Columns<D>>(
        &self,
        Member { particle, x, .. }: Member<CellRing<D>, D>,
        value: &Deposit<D>,
        affine: &A,
        flux: &S,
        sink: &mut impl NodeSink<D>,
    ) {
        self.deposit_node_by_node((particle, x), value, affine, flux, sink);
    }

    /// As [`Basis::interpolate`].
    #[cold]
    #[inline(never)]
    pub(super) fn interpolate_one_by_one(
        &self,
        Member { particle, x, .. }: Member<CellRing<D>, D>,
        wanted: Wanted,
        nodes: &impl NodeField<D>,
    ) -> Interpolated<D> {
        self.interpolate_node_by_node((particle, x), wanted, nodes)
    }
}
