//! The least squares fit of one particle.

use mpm_kernels::{Entry, LANES, Lanes};
use mpm_tensor::Matrix;
use mpm_tensor::vector::dot;

use super::definite::{LaneMatrix, inverse_of_definite};
use super::ring_lanes::{Group, Pending, RingLanes, SETS};
use super::spline::quadratic;
use super::{Floor, LARGEST_COUNT, Sums, sums};

/// D_p is used where each of its pivots is above this share of Σ_i |w_ip| r_ia², since weights of both signs may make it singular, and above
/// that share of Σ_i d′_ip r_ia², since it is also where a particle is at a vertex of the boundary (ours).
pub(super) const LEAST_SPREAD: f64 = 1.0 / 16.0;
pub(super) const LEAST_SAMPLED: f64 = 1e-3;

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
    pub fn entry(&self, floor: &Floor<D>, sample: f64, offset: [f64; D]) -> Entry<D> {
        let curved = self.curvature.apply(&offset);
        Entry {
            weight: sample * floor.factor(self.level + dot(&self.slope, &offset)),
            gradient: std::array::from_fn(|a| sample * (floor.slope[a] + curved[a])),
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
    /// The fits of all pending particles, which are no longer pending then; writes their d′_pi to their places in `samples`. Not finite where cells are
    /// degenerate. Without `spread` there is no D_p⁻¹.
    #[inline(always)]
    pub fn solve<'a>(&mut self, spread: bool, samples: &mut [Lanes], fits: impl IntoIterator<Item = &'a mut Fit<D>>) {
        for (sums, particle) in self.sums.iter_mut().zip(&self.pending[..self.count]) {
            let groups = &self.groups[particle.groups()];
            *sums = sample_ring(particle, groups, &mut samples[particle.samples()]);
        }
        let moments = Moments::<D>::side_by_side(&self.sums);
        let total = moments.zeroth;
        let mut centre = moments.first;
        for a in 0..D {
            centre[a] /= total;
        }
        let mut scatter = moments.second;
        for i in 0..D {
            for j in 0..=i {
                scatter[i][j] = (-total * centre[i]).mul_add(centre[j], scatter[i][j]);
            }
        }
        let (mut curvature, definite) = inverse_of_definite(&scatter, &[Lanes::ZERO; D]);
        let mut slope = [Lanes::ZERO; D];
        for a in 0..D {
            for b in 0..D {
                curvature[a][b] = definite.select(curvature[a][b], Lanes::splat(f64::NAN));
                slope[a] = (-curvature[a][b]).mul_add(centre[b], slope[a]);
            }
        }
        let mut level = Lanes::splat(1.0) / total;
        for a in 0..D {
            level = (-slope[a]).mul_add(centre[a], level);
        }
        let mut least = [Lanes::ZERO; D];
        for a in 0..D {
            least[a] = moments.second[a][a] * LEAST_SAMPLED;
        }
        let (inverse, definite) = if spread {
            self.inverse_spreads(&level, &slope, samples, &least)
        } else {
            ([[Lanes::ZERO; D]; D], 0)
        };
        for (k, fit) in fits.into_iter().take(self.count).enumerate() {
            fit.level = level.as_array()[k];
            for a in 0..D {
                fit.slope[a] = slope[a].as_array()[k];
            }
            fit.curvature = one_of(&curvature, k);
            fit.inverse_spread = (definite >> k & 1 == 1).then(|| one_of(&inverse, k));
        }
        self.count = 0;
    }

    /// D_p⁻¹, once the weights are known, and a bit per particle where its pivots are above `least`.
    #[inline(always)]
    fn inverse_spreads(
        &mut self,
        level: &Lanes,
        slope: &[Lanes; D],
        samples: &[Lanes],
        least: &[Lanes; D],
    ) -> (LaneMatrix<D>, u32) {
        let mut sizes = [[None; LANES]; D];
        for (k, particle) in self.pending[..self.count].iter().enumerate() {
            let weighting = Weighting::new(particle, level, slope, k);
            let ring = || self.groups[particle.groups()].iter().zip(&samples[particle.samples()]);
            let (mut second, mut lowest) = ([[Lanes::ZERO; D]; D], Lanes::ZERO);
            for (group, &sample) in ring() {
                let (weight, r) = weighting.of(group, sample);
                lowest = lowest.fast_min(weight);
                for i in 0..D {
                    let weighted = weight * r[i];
                    for j in 0..=i {
                        second[i][j] = weighted.mul_add(r[j], second[i][j]);
                    }
                }
            }
            for i in 0..D {
                for j in 0..=i {
                    self.sums[k][place_of(D, i, j)] = second[i][j];
                }
            }
            // Σ |w| r² is Σ w r² unless a weight is negative.
            if lowest.to_array().iter().any(|&weight| weight < 0.0) {
                let mut lanes = [Lanes::ZERO; D];
                for (group, &sample) in ring() {
                    let (weight, r) = weighting.of(group, sample);
                    for i in 0..D {
                        lanes[i] += (weight * r[i] * r[i]).abs();
                    }
                }
                for i in 0..D {
                    sizes[i][k] = Some(lanes[i].reduce_add());
                }
            }
        }
        let second = Moments::<D>::side_by_side(&self.sums).second;
        let mut floor = *least;
        for a in 0..D {
            let mut size = second[a][a].to_array();
            for k in 0..LANES {
                size[k] = sizes[a][k].unwrap_or(size[k]);
            }
            floor[a] = floor[a].fast_max(Lanes::new(size) * LEAST_SPREAD);
        }
        let (inverse, definite) = inverse_of_definite(&second, &floor);
        (inverse, definite.to_bitmask())
    }
}

/// The matrix in a lane.
#[inline(always)]
fn one_of<const D: usize>(matrix: &LaneMatrix<D>, lane: usize) -> Matrix<D> {
    let mut one = Matrix::ZERO;
    for a in 0..D {
        for b in 0..D {
            one.0[a][b] = matrix[a][b].as_array()[lane];
        }
    }
    one
}

/// The place of entry i, j of the triangle.
pub(super) const fn place_of(dimension: usize, i: usize, j: usize) -> usize {
    1 + dimension + i * (i + 1) / 2 + j
}

/// Σ d′, Σ d′ r and the lower triangle of Σ d′ r rᵀ of four particles side by side.
struct Moments<const D: usize> {
    zeroth: Lanes,
    first: [Lanes; D],
    second: LaneMatrix<D>,
}

impl<const D: usize> Moments<D> {
    /// From the lanes of each particle by themselves.
    #[inline(always)]
    fn side_by_side([a, b, c, d]: &[Sums; LANES]) -> Self {
        let sum = |place: usize| sums(&[a[place], b[place], c[place], d[place]]);
        let (mut first, mut second) = ([Lanes::ZERO; D], [[Lanes::ZERO; D]; D]);
        for i in 0..D {
            first[i] = sum(1 + i);
            for j in 0..=i {
                second[i][j] = sum(place_of(D, i, j));
            }
        }
        Self {
            zeroth: sum(0),
            first,
            second,
        }
    }
}

/// d′ of the nodes of a particle, and their moments.
#[inline(always)]
fn sample_ring<const D: usize>(particle: &Pending<D>, groups: &[Group<D>], samples: &mut [Lanes]) -> Sums {
    let point = particle.point.map(Lanes::splat);
    let inverse_square = Lanes::splat(particle.inverse_h * particle.inverse_h);
    for (group, out) in groups.iter().zip(samples.iter_mut()) {
        let mut square = Lanes::ZERO;
        for a in 0..D {
            let r = group.positions[a] - point[a];
            square = r.mul_add(r, square);
        }
        let [a, b, c, d] = group.joined;
        let share = |set: u8| particle.shares[set as usize % SETS];
        let share = Lanes::new([share(a), share(b), share(c), share(d)]);
        *out = share * quadratic(square * inverse_square);
    }
    // In a loop of its own, since all sums together fill the registers.
    let (mut zeroth, mut first, mut second) = (Lanes::ZERO, [Lanes::ZERO; D], [[Lanes::ZERO; D]; D]);
    for (group, &sample) in groups.iter().zip(samples.iter()) {
        let mut r = [Lanes::ZERO; D];
        for a in 0..D {
            r[a] = group.positions[a] - point[a];
        }
        zeroth += sample;
        for i in 0..D {
            let weighted = sample * r[i];
            first[i] += weighted;
            for j in 0..=i {
                second[i][j] = weighted.mul_add(r[j], second[i][j]);
            }
        }
    }
    let mut row = [Lanes::ZERO; LARGEST_COUNT];
    row[0] = zeroth;
    for i in 0..D {
        row[1 + i] = first[i];
        for j in 0..=i {
            row[place_of(D, i, j)] = second[i][j];
        }
    }
    row
}

/// w = d′ (α + β·r) of one particle.
struct Weighting<const D: usize> {
    point: [Lanes; D],
    level: Lanes,
    slope: [Lanes; D],
}

impl<const D: usize> Weighting<D> {
    #[inline(always)]
    fn new(particle: &Pending<D>, level: &Lanes, slope: &[Lanes; D], lane: usize) -> Self {
        let of = |lanes: &Lanes| Lanes::splat(lanes.as_array()[lane]);
        let (mut point, mut own) = ([Lanes::ZERO; D], [Lanes::ZERO; D]);
        for a in 0..D {
            (point[a], own[a]) = (Lanes::splat(particle.point[a]), of(&slope[a]));
        }
        Self {
            point,
            level: of(level),
            slope: own,
        }
    }

    /// w and r of four nodes.
    #[inline(always)]
    fn of(&self, group: &Group<D>, sample: Lanes) -> (Lanes, [Lanes; D]) {
        let (mut weight, mut r) = (self.level, [Lanes::ZERO; D]);
        for a in 0..D {
            r[a] = group.positions[a] - self.point[a];
            weight = self.slope[a].mul_add(r[a], weight);
        }
        (weight * sample, r)
    }
}
