//! Particles whose weights are kept positive, node by node: they are few, and what the lanes do rests on weights that are affine in r but for d′.

use mpm_core::{Basis, Member};
use mpm_kernels::{Columns, Deposit, Interpolated, NodeField, NodeSink, Wanted};
use mpm_tensor::vector::accumulate;

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
        self.for_each_node(particle, x, |index, entry| {
            let direction = self.affine_direction(particle, x, entry);
            let mut sum = value.combine(entry.weight, &Deposit::ZERO, 0.0);
            for a in 0..D {
                let columns = [(affine.column(a), direction[a]), (flux.column(a), entry.gradient[a])];
                for (column, scale) in columns {
                    if let Some(column) = column {
                        accumulate(&mut sum.vector, scale, &column);
                    }
                }
            }
            sink.add(index, &sum);
        });
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
        let mut sum = Interpolated::ZERO;
        self.for_each_node(particle, x, |index, entry| {
            let direction = if wanted.least_squares {
                self.affine_direction(particle, x, entry)
            } else {
                entry.gradient
            };
            sum.add(wanted, entry, &direction, &nodes.vector(index));
        });
        sum
    }
}
