//! What particles send to their nodes and read from them, mass and momentum side by side in lanes.

use mpm_kernels::{Columns, Deposit, Interpolated, Lanes, NodeField, NodeSink, Packed, Wanted};
use mpm_tensor::Matrix;

use super::MeshBasis;

/// A mass and a vector of up to three components.
type Pack = Packed<1>;

impl<const D: usize> MeshBasis<D> {
    /// d′ [(α + β·r) (value + C r) + S β + S Γ r] at every node, with C = A D_p⁻¹; where there is no D_p⁻¹, C = 0 and S + A in the place of S.
    #[inline(always)]
    pub(super) fn deposit_in_lanes<A: Columns<D>, S: Columns<D>>(
        &self,
        particle: usize,
        x: &[f64; D],
        value: &Deposit<D>,
        affine: &A,
        flux: &S,
        sink: &mut impl NodeSink<D>,
    ) {
        let fit = &self.particles[particle].fit;
        let pack = |column: Option<[f64; D]>| column.map(|column| Pack::new(0.0, &column));
        let flux: [Option<Pack>; D] = std::array::from_fn(|b| pack(flux.column(b)));
        let affine: [Option<Pack>; D] = std::array::from_fn(|b| pack(affine.column(b)));
        let mut tilt = [Pack::ZERO; D]; // columns of C
        let (mut push, mut bend) = (Pack::ZERO, [Pack::ZERO; D]); // S β, and columns of S Γ
        for b in 0..D {
            let mut flux = flux[b];
            match (&affine[b], &fit.inverse_spread) {
                (None, _) => {}
                (Some(column), Some(inverse)) => {
                    for a in 0..D {
                        tilt[a] = tilt[a].plus(Lanes::splat(inverse.0[b][a]), column);
                    }
                }
                (Some(column), None) => flux = Some(column.plus(Lanes::splat(1.0), &flux.unwrap_or(Pack::ZERO))),
            }
            if let Some(column) = flux {
                push = push.plus(Lanes::splat(fit.slope[b]), &column);
                for a in 0..D {
                    bend[a] = bend[a].plus(Lanes::splat(fit.curvature.0[b][a]), &column);
                }
            }
        }
        let value = Pack::new(value.scalar, &value.vector);
        let (level, slope) = (Lanes::splat(fit.level), fit.slope.map(Lanes::splat));
        let point = x.map(Lanes::splat);
        self.for_each_sample(particle, |index, sample, node| {
            let (mut weight, mut carried, mut pushed) = (level, value, push);
            for a in 0..D {
                let r = Lanes::splat(node[a]) - point[a];
                weight = slope[a].mul_add(r, weight);
                carried = carried.plus(r, &tilt[a]);
                pushed = pushed.plus(r, &bend[a]);
            }
            let sample = Lanes::splat(sample);
            sink.update(index, |sum: &Pack| sum.plus(sample, &pushed.plus(weight, &carried)));
        });
    }

    /// From m = Σ d′ v and m_a = Σ d′ v r_a: Σ w v = α m + Σ_a β_a m_a, and columns b of Σ v gᵀ = β_b m + Σ_a Γ_ab m_a.
    #[inline(always)]
    pub(super) fn interpolate_in_lanes(
        &self,
        particle: usize,
        x: &[f64; D],
        wanted: Wanted,
        nodes: &impl NodeField<D>,
    ) -> Interpolated<D> {
        let fit = &self.particles[particle].fit;
        let by_gradient = wanted.gradient && !(wanted.least_squares && fit.inverse_spread.is_some());
        let with_moment = wanted.moment || (wanted.gradient && !by_gradient);
        let (level, slope) = (Lanes::splat(fit.level), fit.slope.map(Lanes::splat));
        let point = x.map(Lanes::splat);
        let (mut zeroth, mut first, mut moment) = (Pack::ZERO, [Pack::ZERO; D], [Pack::ZERO; D]);
        self.for_each_sample(particle, |index, sample, node| {
            let carried = nodes.packed::<1>(index).times(Lanes::splat(sample));
            let mut weight = level;
            let mut r = [Lanes::ZERO; D];
            for a in 0..D {
                r[a] = Lanes::splat(node[a]) - point[a];
                weight = slope[a].mul_add(r[a], weight);
                first[a] = first[a].plus(r[a], &carried);
            }
            zeroth = zeroth.plus(Lanes::splat(1.0), &carried);
            if with_moment {
                for a in 0..D {
                    moment[a] = moment[a].plus(weight * r[a], &carried);
                }
            }
        });
        let mut value = zeroth.times(level);
        let mut gradient = [Pack::ZERO; D];
        for a in 0..D {
            value = value.plus(slope[a], &first[a]);
            gradient[a] = zeroth.times(slope[a]);
            for b in 0..D {
                gradient[a] = gradient[a].plus(Lanes::splat(fit.curvature.0[b][a]), &first[b]);
            }
        }
        let moment = from_columns(&moment);
        Interpolated {
            value: value.deposit::<D>().vector,
            gradient: match &fit.inverse_spread {
                _ if !wanted.gradient => Matrix::ZERO,
                Some(inverse) if wanted.least_squares => moment * *inverse,
                _ => from_columns(&gradient),
            },
            moment: if wanted.moment { moment } else { Matrix::ZERO },
        }
    }
}

/// The matrix of the vectors of packed columns.
#[inline(always)]
fn from_columns<const D: usize>(columns: &[Pack; D]) -> Matrix<D> {
    let columns: [[f64; D]; D] = std::array::from_fn(|b| columns[b].deposit::<D>().vector);
    Matrix::from_fn(|a, b| columns[b][a])
}
