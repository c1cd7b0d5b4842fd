//! The least squares fit of one particle.

use mpm_kernels::{Entry, LANES, Lanes};
use mpm_tensor::Matrix;
use mpm_tensor::vector::{dot, multiply_add};

use super::definite::inverse_of_definite;
use super::ring_lanes::RingLanes;
use super::spline::quadratic;

/// D_p is used where each of its pivots is above this share of Σ_i |w_ip| r_ia², since weights of both signs may make it singular, and above
/// that share of Σ_i d′_ip r_ia², since it is also where a particle is at a vertex of the boundary (ours).
const LEAST_SPREAD: f64 = 1.0 / 16.0;
const LEAST_SAMPLED: f64 = 1e-3;

/// What a particle needs, beside d′_pi, for its weights and gradients (Cao et al. 2024, Eqs. 22 and 29): M_p⁻¹ of
/// M_p = Σ_i d′_pi P_i P_iᵀ with P_i = [1, r_i], r_i = x_i − x_p, in blocks \[α, βᵀ; β, Γ\], so that
/// w_ip = d′_pi (α + β·r_i) and the diffuse gradient, which is not ∇ of the weight, is d′_pi (β + Γ r_i).
///
/// With s = Σ d′, c = Σ d′ r / s: Γ⁻¹ = Σ d′ r rᵀ − s c cᵀ, β = −Γ c, α = 1/s − β·c. Elimination in this order is indifferent to
/// the unit of length, so offsets need not be scaled by h.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fit<const D: usize> {
    /// α.
    pub level: f64,
    /// β; 1/length.
    pub slope: [f64; D],
    /// Γ; 1/length².
    pub curvature: Matrix<D>,
    /// D_p⁻¹ with D_p = Σ_i w_ip r_i r_iᵀ; `None` where it is not positive definite by a margin.
    pub inverse_spread: Option<Matrix<D>>,
}

impl<const D: usize> Fit<D> {
    /// No weights.
    pub const NOTHING: Self = Self {
        level: 0.0,
        slope: [0.0; D],
        curvature: Matrix::ZERO,
        inverse_spread: None,
    };

    /// Weight, gradient and offset of a node at offset r with sample weight d′.
    #[inline(always)]
    pub fn entry(&self, sample: f64, offset: [f64; D]) -> Entry<D> {
        let curved = self.curvature.apply(&offset);
        Entry {
            weight: sample * (self.level + dot(&self.slope, &offset)),
            gradient: std::array::from_fn(|a| sample * (self.slope[a] + curved[a])),
            offset,
        }
    }

    /// w_ip D_p⁻¹ r_i; the gradient where there is no D_p⁻¹. Either sums to zero over the nodes, and its products with r_iᵀ to I, which
    /// is all that momentum and angular momentum ask of it.
    #[inline(always)]
    pub fn direction(&self, entry: &Entry<D>) -> [f64; D] {
        match &self.inverse_spread {
            Some(inverse) => inverse.apply(&entry.offset).map(|c| entry.weight * c),
            None => entry.gradient,
        }
    }
}

impl<const D: usize> RingLanes<D> {
    /// Fit at `x`, whose barycentric coordinates in the cell are `barycentric` from vertex 1 on; writes d′_pi by place in the ring
    /// to `samples`, whose length is that of the ring rounded up to whole groups. Not finite where cells are degenerate.
    #[inline(always)]
    pub fn fit(&self, x: &[f64; D], barycentric: &[f64; D], inverse_h: f64, samples: &mut [f64]) -> Fit<D> {
        let (point, b) = (x.map(Lanes::splat), barycentric.map(Lanes::splat));
        let inverse_square = Lanes::splat(inverse_h * inverse_h);
        let (mut zeroth, mut first, mut second) = (Lanes::ZERO, [Lanes::ZERO; D], [[Lanes::ZERO; D]; D]);
        for (group, out) in self.groups.iter().zip(samples.chunks_exact_mut(LANES)) {
            let (mut square, mut share) = (Lanes::ZERO, group.base);
            let mut r = [Lanes::ZERO; D];
            for a in 0..D {
                r[a] = group.positions[a] - point[a];
                square = r[a].mul_add(r[a], square);
                share = group.slopes[a].mul_add(b[a], share);
            }
            let sample = share.fast_max(Lanes::ZERO) * quadratic(square * inverse_square);
            out.copy_from_slice(&sample.to_array());
            zeroth += sample;
            for i in 0..D {
                let weighted = sample * r[i];
                first[i] += weighted;
                for j in 0..=i {
                    second[i][j] = weighted.mul_add(r[j], second[i][j]);
                }
            }
        }
        let total = zeroth.reduce_add();
        let centre = first.map(|sum| sum.reduce_add() / total);
        let scatter = symmetric(|i, j| multiply_add(-total * centre[i], centre[j], second[i][j].reduce_add()));
        let curvature = inverse_of_definite(&scatter, &[0.0; D]).unwrap_or(Matrix([[f64::NAN; D]; D]));
        let slope = curvature.apply(&centre).map(|c| -c);
        let level = 1.0 / total - dot(&slope, &centre);
        let least = std::array::from_fn(|a| LEAST_SAMPLED * second[a][a].reduce_add());
        Fit {
            level,
            slope,
            curvature,
            inverse_spread: self.inverse_spread(&point, level, &slope, samples, &least),
        }
    }

    /// D_p⁻¹, once the weights are known; its pivots have to be above `least`.
    #[inline(always)]
    fn inverse_spread(
        &self,
        point: &[Lanes; D],
        level: f64,
        slope: &[f64; D],
        samples: &[f64],
        least: &[f64; D],
    ) -> Option<Matrix<D>> {
        let slope = slope.map(Lanes::splat);
        let (mut second, mut sizes) = ([[Lanes::ZERO; D]; D], [Lanes::ZERO; D]);
        for (group, samples) in self.groups.iter().zip(samples.chunks_exact(LANES)) {
            let mut weight = Lanes::splat(level);
            let mut r = [Lanes::ZERO; D];
            for a in 0..D {
                r[a] = group.positions[a] - point[a];
                weight = slope[a].mul_add(r[a], weight);
            }
            weight *= Lanes::new([samples[0], samples[1], samples[2], samples[3]]);
            for i in 0..D {
                let weighted = weight * r[i];
                sizes[i] += (weighted * r[i]).abs();
                for j in 0..=i {
                    second[i][j] = weighted.mul_add(r[j], second[i][j]);
                }
            }
        }
        let floor = std::array::from_fn(|a| least[a].max(LEAST_SPREAD * sizes[a].reduce_add()));
        inverse_of_definite(&symmetric(|i, j| second[i][j].reduce_add()), &floor)
    }
}

/// The symmetric matrix of a lower triangle.
#[inline(always)]
fn symmetric<const D: usize>(entry: impl Fn(usize, usize) -> f64) -> Matrix<D> {
    let mut matrix = Matrix::ZERO;
    for i in 0..D {
        for j in 0..=i {
            let value = entry(i, j);
            matrix.0[i][j] = value;
            matrix.0[j][i] = value;
        }
    }
    matrix
}
