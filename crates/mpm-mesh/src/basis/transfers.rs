//! What particles send to their nodes and read from them: factors of four nodes side by side in lanes, or mass and momentum of one.

use mpm_kernels::{Columns, Deposit, Interpolated, LANES, Lanes, NodeField, NodeSink, Packed, Wanted};
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
        let (tilted, mut pushes) = (affine.column(0).is_some(), flux.column(0).is_some());
        let mut tilt = [Pack::ZERO; D]; // columns of C
        let (mut push, mut bend) = (Pack::ZERO, [Pack::ZERO; D]); // S β, and columns of S Γ
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
                push = push.plus(Lanes::splat(fit.slope[b]), &column);
                for a in 0..D {
                    bend[a] = bend[a].plus(Lanes::splat(fit.curvature.0[b][a]), &column);
                }
            }
        }
        let (mass, value) = (Lanes::splat(value.scalar), splats::<D>(&Pack::new(0.0, &value.vector)));
        let (level, slope) = (Lanes::splat(fit.level), fit.slope.map(Lanes::splat));
        let (push, mut tilts, mut bends) = (splats::<D>(&push), [[Lanes::ZERO; D]; D], [[Lanes::ZERO; D]; D]);
        for a in 0..D {
            (tilts[a], bends[a]) = (splats::<D>(&tilt[a]), splats::<D>(&bend[a]));
        }
        self.for_each_group(particle, x, |first, sample, r| {
            let weight = weight_of(sample, level, &slope, r);
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
                if pushes {
                    let mut pushed = push[c];
                    for a in 0..D {
                        pushed = bends[a][c].mul_add(r[a], pushed);
                    }
                    sent[c + 1] = sample.mul_add(pushed, sent[c + 1]);
                }
            }
            let mut window = sink.window(first, LANES);
            for (lane, node) in Lanes::transpose(sent).iter().enumerate() {
                let node = Pack::read(std::slice::from_ref(node));
                window.update(lane, |sum: &Pack| sum.plus(Lanes::splat(1.0), &node));
            }
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
        let by_moment = wanted.gradient && wanted.least_squares && fit.inverse_spread.is_some();
        let by_gradient = wanted.gradient && !by_moment;
        let with_moment = wanted.moment || by_moment;
        let (level, slope) = (Lanes::splat(fit.level), fit.slope.map(Lanes::splat));
        // Σ w v or, with a gradient, Σ d′ v; Σ d′ v r_a; Σ w v r_a.
        let (mut zeroth, mut first, mut moment) = (Pack::ZERO, [Pack::ZERO; D], [Pack::ZERO; D]);
        self.for_each_group(particle, x, |place, sample, r| {
            let weight = weight_of(sample, level, &slope, r);
            let (mut sampled, mut weighted) = (*r, *r);
            for a in 0..D {
                sampled[a] *= sample;
                weighted[a] *= weight;
            }
            let window = nodes.window(place, LANES);
            let head = if by_gradient { sample } else { weight };
            for lane in 0..LANES {
                let v = Pack::read(&[window.lanes(lane)]);
                let of = |factors: &Lanes| Lanes::splat(factors.as_array()[lane]);
                zeroth = zeroth.plus(of(&head), &v);
                for a in 0..D {
                    if by_gradient {
                        first[a] = first[a].plus(of(&sampled[a]), &v);
                    }
                    if with_moment {
                        moment[a] = moment[a].plus(of(&weighted[a]), &v);
                    }
                }
            }
        });
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
        let moment = from_columns(&moment);
        Interpolated {
            value: value.deposit::<D>().vector,
            gradient: match &fit.inverse_spread {
                Some(inverse) if by_moment => moment * *inverse,
                _ => from_columns(&gradient),
            },
            moment: if wanted.moment { moment } else { Matrix::ZERO },
        }
    }
}

impl<const D: usize> MeshBasis<D> {
    /// Visit the weights of four nodes at a time, in order.
    #[inline(always)]
    fn for_each_weight_group(&self, particle: usize, x: &[f64; D], mut visit: impl FnMut(Lanes)) {
        let fit = &self.particles[particle].fit;
        let (level, slope) = (Lanes::splat(fit.level), fit.slope.map(Lanes::splat));
        self.for_each_group(particle, x, |_, sample, r| {
            visit(weight_of(sample, level, &slope, r));
        });
    }

    #[inline(always)]
    pub(super) fn deposit_scalars_in_lanes(
        &self,
        particle: usize,
        x: &[f64; D],
        scalars: [f64; 2],
        sums: [&mut [f64]; 2],
    ) {
        let scalars = scalars.map(Lanes::splat);
        let [mut first, mut second] = sums.map(|sums| sums.as_chunks_mut().0.iter_mut());
        self.for_each_weight_group(particle, x, |weight| {
            for (sums, scalar) in [&mut first, &mut second].into_iter().zip(scalars) {
                if let Some(sums) = sums.next() {
                    *sums = weight.mul_add(scalar, Lanes::new(*sums)).to_array();
                }
            }
        });
    }

    #[inline(always)]
    pub(super) fn interpolate_scalar_in_lanes(&self, particle: usize, x: &[f64; D], nodes: &[f64]) -> f64 {
        let (mut sum, mut nodes) = (Lanes::ZERO, nodes.as_chunks().0.iter());
        self.for_each_weight_group(particle, x, |weight| {
            if let Some(&nodes) = nodes.next() {
                sum = weight.mul_add(Lanes::new(nodes), sum);
            }
        });
        sum.reduce_add()
    }
}

/// d′ (α + β·r) of four nodes.
#[inline(always)]
fn weight_of<const D: usize>(sample: Lanes, level: Lanes, slope: &[Lanes; D], r: &[Lanes; D]) -> Lanes {
    let mut sum = level;
    for a in 0..D {
        sum = slope[a].mul_add(r[a], sum);
    }
    sum * sample
}

/// The components of a vector, each in all lanes.
#[inline(always)]
fn splats<const D: usize>(pack: &Pack) -> [Lanes; D] {
    let vector = pack.deposit::<D>().vector;
    let mut splats = [Lanes::ZERO; D];
    for c in 0..D {
        splats[c] = Lanes::splat(vector[c]);
    }
    splats
}

/// The matrix of the vectors of packed columns.
#[inline(always)]
fn from_columns<const D: usize>(columns: &[Pack; D]) -> Matrix<D> {
    let columns: [[f64; D]; D] = std::array::from_fn(|b| columns[b].deposit::<D>().vector);
    Matrix::from_fn(|a, b| columns[b][a])
}
