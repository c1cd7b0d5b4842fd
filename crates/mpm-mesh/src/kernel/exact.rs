//! The gradients of the weights themselves, ∇ of w, in the place of diffuse ones.

use mpm_kernels::Lanes;
use mpm_tensor::Matrix;

use super::fit::Fit;
use super::positive::Floor;
use super::ring_lanes::{RingLanes, SETS};
use super::spline::quadratic_and_slope;

/// What a particle needs for ∇ d, beside what it needs for d.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slopes<const D: usize> {
    /// ∇ of the share of each set of the cell's vertices, by component.
    pub shares: [[f64; SETS]; D],
    /// ∇ h.
    pub width: [f64; D],
}

impl<const D: usize> Slopes<D> {
    /// Of shares and a width that do not vary: outside of the mesh, where ∇ w is that of the fit at the nearest point.
    pub const NOTHING: Self = Self {
        shares: [[0.0; SETS]; D],
        width: [0.0; D],
    };
}

/// ∇ of one function of the nodes, four of them side by side.
pub(crate) type Gradients<const D: usize> = [Lanes; D];

impl<const D: usize> RingLanes<D> {
    /// ∇ w of the nodes of the particle that was solved at place `k`, in the groups of its ring.
    ///
    /// With w = d ψ(α + β·r), Σ w = 1 and Σ w r = 0, of which least squares are ψ(s) = s, differentiated in x_p:
    ///
    /// ∂_a w = d ψ′ P·M⁻¹(e_a − S_a) + q_a, S_a = Σ q_a P, M = Σ d ψ′ P Pᵀ, P = \[1, r\], q_a = ψ ∂_a d + d ∂ψ/∂θ ∂_a θ.
    ///
    /// Without S and q it is the diffuse gradient. Σ ∇w = 0 and Σ ∇w rᵀ = I hold of both; that ∫ ∇w dV = 0 over the support of a node in a body, so that a constant stress pulls at no node, of this one alone.
    /// d = η̃ N₂(|r| / h): ∇ d has terms of η̃, of the distance, and of h where it varies.
    #[inline(never)]
    pub fn exact_gradients(
        &self,
        k: usize,
        slopes: &Slopes<D>,
        (fit, floor): (&Fit<D>, &Floor<D>),
        samples: &[Lanes],
        out: &mut [Gradients<D>],
    ) {
        let particle = &self.pending[k];
        let groups = &self.groups[particle.groups()];
        let (samples, out) = (&samples[particle.samples()], &mut out[particle.samples()]);
        let point = particle.point.map(Lanes::splat);
        let offsets = |positions: &[Lanes; D]| -> [Lanes; D] { std::array::from_fn(|a| positions[a] - point[a]) };
        let inverse_h = Lanes::splat(particle.inverse_h);
        let width = slopes.width.map(Lanes::splat);
        let mut total = [Lanes::ZERO; D];
        for (group, out) in groups.iter().zip(out.iter_mut()) {
            let r = offsets(&group.positions);
            let mut square = Lanes::ZERO;
            for a in 0..D {
                square = r[a].mul_add(r[a], square);
            }
            let ratio = square * inverse_h * inverse_h;
            let (spline, over_distance) = quadratic_and_slope(ratio);
            let of_sets = |table: &[f64; SETS]| Lanes::new(group.joined.map(|set| table[set as usize % SETS]));
            // N₂(ρ) with ∇ρ = −r / (h² ρ) − ρ ∇h / h.
            let inward = of_sets(&particle.shares) * over_distance * inverse_h;
            for a in 0..D {
                let along = (r[a] * inverse_h + ratio * width[a]) * inward;
                out[a] = of_sets(&slopes.shares[a]) * spline - along;
                total[a] += out[a];
            }
        }
        let total = total.map(|sum| Lanes::splat(sum.reduce_add()));
        let (level, slope) = (Lanes::splat(fit.level), fit.slope.map(Lanes::splat));
        let (mut zeroth, mut first) = ([Lanes::ZERO; D], [[Lanes::ZERO; D]; D]);
        for ((group, &sample), out) in groups.iter().zip(samples).zip(out.iter_mut()) {
            let (r, mut s) = (offsets(&group.positions), level);
            for a in 0..D {
                s = slope[a].mul_add(r[a], s);
            }
            let (value, lowered) = (floor.value(s), floor.lowering(s) * sample);
            for a in 0..D {
                out[a] = out[a] * value - lowered * total[a];
                zeroth[a] += out[a];
                for b in 0..D {
                    first[a][b] = out[a].mul_add(r[b], first[a][b]);
                }
            }
        }
        let zeroth = zeroth.map(Lanes::reduce_add);
        let first = Matrix(first.map(|row| row.map(Lanes::reduce_add)));
        // P·M⁻¹(e_a − S_a) is affine in r.
        let mut constant = [Lanes::ZERO; D];
        for a in 0..D {
            let pulled = floor.level * zeroth[a] + (0..D).map(|b| floor.slope[b] * first.0[a][b]).sum::<f64>();
            constant[a] = Lanes::splat(floor.slope[a] - pulled);
        }
        let linear = fit.curvature - Matrix::outer(&zeroth, &floor.slope) - first * fit.curvature;
        let linear = linear.0.map(|row| row.map(Lanes::splat));
        for ((group, &sample), out) in groups.iter().zip(samples).zip(out.iter_mut()) {
            let r = offsets(&group.positions);
            for a in 0..D {
                let mut fitted = constant[a];
                for b in 0..D {
                    fitted = linear[a][b].mul_add(r[b], fitted);
                }
                out[a] = sample.mul_add(fitted, out[a]);
            }
        }
    }
}
