//! Particle → nodes of a tensor-product stencil, at two fused products per node and component.

use crate::lanes::Lanes;
use crate::packed::groups_of;
use crate::walk::{Walker, walk};
use crate::{Columns, Deposit, NodeSink, Packed, Stencil};

impl<const W: usize, const D: usize> Stencil<W, D> {
    /// Add w_ip `value` + A w_ip D_p⁻¹ (x_i − x_p) + S ∇w_ip to all Wᴰ nodes, the last axis fastest, where A = `affine` and
    /// S = `flux` act on the vector alone. Hat functions have ∇w_ip for w_ip D_p⁻¹ (x_i − x_p).
    ///
    /// Sum factorisation: with N_a, N′_a the weights and derivatives along axis a, d_a = N_a r_a / m_a (r_a the offset, m_a the second
    /// moment), A_a and S_a the columns of A and S, and R_a = d_a A_a + N′_a S_a, the sum over the first a axes is
    /// P_a = N_a P_(a−1) + Π_(b<a) N_b R_a from P_0 = `value`. P_D is what the node gets; there are W D values of R.
    #[inline(always)]
    pub fn deposit<A: Columns<D>, S: Columns<D>>(
        &self,
        value: &Deposit<D>,
        affine: &A,
        flux: &S,
        sink: &mut impl NodeSink<D>,
    ) {
        match const { groups_of(D) } {
            1 => self.deposit_in::<1, A, S>(value, affine, flux, sink),
            2 => self.deposit_in::<2, A, S>(value, affine, flux, sink),
            3 => self.deposit_in::<3, A, S>(value, affine, flux, sink),
            _ => self.deposit_in::<4, A, S>(value, affine, flux, sink),
        }
    }

    #[inline(always)]
    fn deposit_in<const G: usize, A: Columns<D>, S: Columns<D>>(
        &self,
        value: &Deposit<D>,
        affine: &A,
        flux: &S,
        sink: &mut impl NodeSink<D>,
    ) {
        let mut own = [[Packed::<G>::ZERO; W]; D];
        for a in 0..D {
            let axis = &self.axes[a];
            let affine = affine.column(a).map(|column| Packed::new(0.0, &column));
            let flux = flux.column(a).map(|column| Packed::new(0.0, &column));
            for j in 0..W {
                let (direction, slope) = (Lanes::splat(axis.directions[j]), Lanes::splat(axis.derivatives[j]));
                own[a][j] = match (affine, flux) {
                    (Some(affine), Some(flux)) => affine.times(direction).plus(slope, &flux),
                    (Some(affine), None) => affine.times(direction),
                    (None, Some(flux)) => flux.times(slope),
                    (None, None) => Packed::ZERO,
                };
            }
        }
        let one = Carried {
            weight: Lanes::splat(1.0),
            sum: Packed::new(value.scalar, &value.vector),
        };
        let stencil = self;
        let layout = self.layout;
        let sink = &mut sink.window(layout.first(), layout.span());
        walk::<W, D, _>(one, &layout.from(0), &mut Depositor { stencil, own, sink });
    }
}

/// What has been taken along the outer axes.
#[derive(Clone, Copy)]
struct Carried<const G: usize> {
    /// Product of the weights.
    weight: Lanes,
    /// The sum so far.
    sum: Packed<G>,
}

struct Depositor<'a, V, const G: usize, const W: usize, const D: usize> {
    stencil: &'a Stencil<W, D>,
    /// R.
    own: [[Packed<G>; W]; D],
    sink: &'a mut V,
}

impl<V: NodeSink<D>, const G: usize, const W: usize, const D: usize> Walker<Carried<G>> for Depositor<'_, V, G, W, D> {
    #[inline(always)]
    fn extend(&self, axis: usize, j: usize, before: &Carried<G>) -> Carried<G> {
        let weight = Lanes::splat(self.stencil.axes[axis].weights[j]);
        Carried {
            weight: weight * before.weight,
            sum: before.sum.times(weight).plus(before.weight, &self.own[axis][j]),
        }
    }

    #[inline(always)]
    fn row(&mut self, first: usize, before: &Carried<G>) {
        for k in 0..W {
            let weight = Lanes::splat(self.stencil.axes[D - 1].weights[k]);
            let own = &self.own[D - 1][k];
            self.sink.update(first + k, |sum: &Packed<G>| {
                sum.plus(weight, &before.sum).plus(before.weight, own)
            });
        }
    }
}
