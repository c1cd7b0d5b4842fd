//! What particles send to their nodes and read from them, four nodes side by side in lanes.

use std::hint::black_box;

use mpm_core::Member;
use mpm_kernels::{Columns, Deposit, Interpolated, LANES, Lanes, NodeField, NodeSink, Packed, Wanted};
use mpm_tensor::Matrix;

use super::MeshBasis;
use super::cell_ring::CellRing;
use crate::kernel::sums;

/// A mass and a vector of up to three components.
type Pack = Packed<1>;

impl<const D: usize> MeshBasis<D> {
    /// w (value + C r) + S g at every node, with C = A D_p⁻¹; where there is no D_p⁻¹, C = 0 and S + A in the place of S. With diffuse gradients that is
    /// d′ [(α + β·r) (value + C r) + S β + S Γ r].
    #[inline(always)]
    pub(super) fn deposit_in_lanes<const EXACT: bool, A: Columns<D>, S: Columns<D>>(
        &self,
        member: Member<CellRing<D>, D>,
        value: &Deposit<D>,
        affine: &A,
        flux: &S,
        sink: &mut impl NodeSink<D>,
    ) {
        let fit = &self.particles[member.particle].fit;
        let pack = |column: Option<[f64; D]>| column.map(|column| Pack::new(0.0, &column));
        let (tilted, mut pushes) = (affine.column(0).is_some(), flux.column(0).is_some());
        let mut tilt = [Pack::ZERO; D]; // columns of C
        let (mut push, mut bend) = (Pack::ZERO, [Pack::ZERO; D]); // S β, and columns of S Γ
        let mut fluxes = [Pack::ZERO; D]; // columns of S
        for b in 0..D {
            let mut flux = pack(flux.column(b));
            match (pack(affine.column(b)), &fit.inverse_spread) {
                (None, _) => {}
                (Some(column), Some(inverse)) => {
                    for a in 0..D {
                        tilt[a] = tilt[a].plus(Lanes::splat(inverse.0[b][a]), &column);
                    }
                }
                (Some(column), None) => {
                    pushes = true;
                    flux = Some(column.plus(Lanes::splat(1.0), &flux.unwrap_or(Pack::ZERO)));
                }
            }
            if let Some(column) = flux {
                if EXACT {
                    fluxes[b] = column;
                    continue;
                }
                push = push.plus(Lanes::splat(fit.slope[b]), &column);
                for a in 0..D {
                    bend[a] = bend[a].plus(Lanes::splat(fit.curvature.0[b][a]), &column);
                }
            }
        }
        let (mass, value) = (Lanes::splat(value.scalar), splats::<D>(&Pack::new(0.0, &value.vector)));
        let (level, slope) = (Lanes::splat(fit.level), in_all_lanes(&fit.slope));
        let (push, mut tilts, mut bends) = (splats::<D>(&push), [[Lanes::ZERO; D]; D], [[Lanes::ZERO; D]; D]);
        for a in 0..D {
            (tilts[a], bends[a]) = (splats::<D>(&tilt[a]), splats::<D>(&bend[a]));
        }
        let gradients = self.gradients_of(member.particle).filter(|_| EXACT).unwrap_or_default();
        let fluxes = if EXACT {
            fluxes.map(|column| splats::<D>(&column))
        } else {
            [[Lanes::ZERO; D]; D]
        };
        for (group, (sample, r)) in self.groups(member).enumerate() {
            let weight = weight_of(sample, level, &slope, &r);
            let mut sent = [Lanes::ZERO; LANES];
            sent[0] = weight * mass;
            for c in 0..D {
                let mut carried = value[c];
                if tilted {
                    for a in 0..D {
                        carried = tilts[a][c].mul_add(r[a], carried);
                    }
                }
                sent[c + 1] = weight * carried;
                if EXACT {
                    for a in 0..D {
                        sent[c + 1] = fluxes[a][c].mul_add(gradients[group][a], sent[c + 1]);
                    }
                } else if pushes {
                    let mut pushed = push[c];
                    for a in 0..D {
                        pushed = bends[a][c].mul_add(r[a], pushed);
                    }
                    sent[c + 1] = sample.mul_add(pushed, sent[c + 1]);
                }
            }
            sink.add_rows(group * LANES, &Lanes::transpose(sent));
        }
    }

    /// From m = Σ d′ v and m_a = Σ d′ v r_a: Σ w v = α m + Σ_a β_a m_a, and columns b of Σ v gᵀ = β_b m + Σ_a Γ_ab m_a.
    #[inline(always)]
    pub(super) fn interpolate_in_lanes<const EXACT: bool>(
        &self,
        member: Member<CellRing<D>, D>,
        wanted: Wanted,
        nodes: &impl NodeField<D>,
    ) -> Interpolated<D> {
        let fit = &self.particles[member.particle].fit;
        let by_moment = wanted.gradient && wanted.least_squares && fit.inverse_spread.is_some();
        let by_gradient = wanted.gradient && !by_moment && !EXACT;
        let with_moment = wanted.moment || by_moment;
        let (level, slope) = (Lanes::splat(fit.level), in_all_lanes(&fit.slope));
        let (mut zeroth, mut first, mut moment) = (Pack::ZERO, [Pack::ZERO; D], [Pack::ZERO; D]);
        // One after the other, since all sums together do not fit into registers: the box keeps those of one loop out of them in the next.
        if by_gradient {
            let of_samples = |sample, _: &[Lanes; D]| sample;
            (zeroth, first) = if D > 2 {
                let zeroth = self.moments::<true, false>(member, nodes, of_samples).0;
                (zeroth, self.moments::<false, true>(member, nodes, of_samples).1)
            } else {
                self.moments::<true, true>(member, nodes, of_samples)
            };
            (zeroth, first) = black_box((zeroth, first));
        }
        let weight = |sample, r: &[Lanes; D]| weight_of(sample, level, &slope, r);
        match (by_gradient, with_moment) {
            (true, true) => moment = self.moments::<false, true>(member, nodes, weight).1,
            (true, false) => {}
            (false, true) => (zeroth, moment) = self.moments::<true, true>(member, nodes, weight),
            (false, false) => zeroth = self.moments::<true, false>(member, nodes, weight).0,
        }
        let (mut value, mut gradient) = (zeroth, [Pack::ZERO; D]);
        if by_gradient {
            value = zeroth.times(level);
            for a in 0..D {
                value = value.plus(slope[a], &first[a]);
                gradient[a] = zeroth.times(slope[a]);
                for b in 0..D {
                    gradient[a] = gradient[a].plus(Lanes::splat(fit.curvature.0[b][a]), &first[b]);
                }
            }
        }
        let moment = Pack::matrix(&moment);
        Interpolated {
            value: value.deposit::<D>().vector,
            gradient: match &fit.inverse_spread {
                Some(inverse) if by_moment => moment * *inverse,
                _ if EXACT && wanted.gradient => self.gradient_in_lanes(member, nodes),
                _ => Pack::matrix(&gradient),
            },
            moment: if wanted.moment { moment } else { Matrix::ZERO },
        }
    }
}

impl<const D: usize> MeshBasis<D> {
    /// Σ f v and, if they are asked for, Σ f v r_a, with f from d′ and r of every node.
    #[inline(always)]
    fn moments<const ZEROTH: bool, const FIRST: bool>(
        &self,
        member: Member<CellRing<D>, D>,
        nodes: &impl NodeField<D>,
        factor: impl Fn(Lanes, &[Lanes; D]) -> Lanes,
    ) -> (Pack, [Pack; D]) {
        let (mut zeroth, mut first) = ([Lanes::ZERO; D], [[Lanes::ZERO; D]; D]);
        for ((sample, r), [_, v @ ..]) in self.groups(member).zip(nodes.by_fours()) {
            let factor = factor(sample, &r);
            let mut factors = r;
            for a in 0..D {
                factors[a] *= factor;
            }
            for c in 0..D {
                if ZEROTH {
                    zeroth[c] = factor.mul_add(v[c], zeroth[c]);
                }
                if FIRST {
                    for a in 0..D {
                        first[a][c] = factors[a].mul_add(v[c], first[a][c]);
                    }
                }
            }
        }
        let mut packed = [Pack::ZERO; D];
        if FIRST {
            for a in 0..D {
                packed[a] = pack_of_sums(&first[a]);
            }
        }
        (if ZEROTH { pack_of_sums(&zeroth) } else { Pack::ZERO }, packed)
    }

    /// The weights of four nodes at a time, in order.
    #[inline(always)]
    fn weights_by_fours(&self, member: Member<CellRing<D>, D>) -> impl Iterator<Item = Lanes> {
        let (fit, twice) = (&self.particles[member.particle].fit, self.floor(member.particle).twice);
        let (level, slope) = (Lanes::splat(fit.level), in_all_lanes(&fit.slope));
        let twice = Lanes::splat(twice);
        self.groups(member).map(move |(sample, r)| {
            let s = affine(level, &slope, &r);
            s.fast_max(twice - s) * sample
        })
    }

    #[inline(always)]
    pub(super) fn deposit_scalars_in_lanes<const N: usize>(
        &self,
        member: Member<CellRing<D>, D>,
        scalars: [f64; N],
        sums: [&mut [f64]; N],
    ) {
        let scalars = scalars.map(Lanes::splat);
        let mut sums = sums.map(|sums| sums.as_chunks_mut().0.iter_mut());
        for weight in self.weights_by_fours(member) {
            for (sums, scalar) in sums.iter_mut().zip(scalars) {
                if let Some(sums) = sums.next() {
                    *sums = weight.mul_add(scalar, Lanes::new(*sums)).to_array();
                }
            }
        }
    }

    #[inline(always)]
    pub(super) fn interpolate_scalar_in_lanes(&self, member: Member<CellRing<D>, D>, nodes: &[f64]) -> f64 {
        let mut sum = Lanes::ZERO;
        for (weight, &nodes) in self.weights_by_fours(member).zip(nodes.as_chunks().0) {
            sum = weight.mul_add(Lanes::new(nodes), sum);
        }
        sum.reduce_add()
    }
}

/// d′ (α + β·r) of four nodes.
#[inline(always)]
fn weight_of<const D: usize>(sample: Lanes, level: Lanes, slope: &[Lanes; D], r: &[Lanes; D]) -> Lanes {
    affine(level, slope, r) * sample
}

/// α + β·r of four nodes.
#[inline(always)]
fn affine<const D: usize>(level: Lanes, slope: &[Lanes; D], r: &[Lanes; D]) -> Lanes {
    let mut sum = level;
    for a in 0..D {
        sum = slope[a].mul_add(r[a], sum);
    }
    sum
}

/// The vector of the sums over the lanes of each component; the scalar has no meaning.
#[inline(always)]
fn pack_of_sums<const D: usize>(components: &[Lanes; D]) -> Pack {
    let mut rows = [Lanes::ZERO; LANES];
    rows[1..=D].copy_from_slice(components);
    Pack::read(&[sums(&rows)])
}

/// The components of a packed vector, each in all lanes.
#[inline(always)]
fn splats<const D: usize>(pack: &Pack) -> [Lanes; D] {
    in_all_lanes(&pack.deposit().vector)
}

/// The components of a vector, each in all lanes.
#[inline(always)]
fn in_all_lanes<const D: usize>(vector: &[f64; D]) -> [Lanes; D] {
    let mut lanes = [Lanes::ZERO; D];
    for c in 0..D {
        lanes[c] = Lanes::splat(vector[c]);
    }
    lanes
}
