//! Student kernels evaluated in vector instructions, as many points at a time as the machine has lanes for.

use mpm_tensor::{Matrix, vector};
use pulp::{Simd, WithSimd};

use crate::gamma::log_gamma_of_half;
use crate::lanes::{Group, LANES, Lanes};

/// Degrees of freedom ν of all kernels in so many dimensions: 16 or 17, so that (ν + D)/2 is an integer and no root has to be taken.
pub(crate) const fn freedom(dimension: usize) -> u32 {
    16 + dimension as u32 % 2
}

/// Most that (1 + |z|²/ν)^((ν+D)/2) counts for: so far away a kernel's density is of no account, and products of two of them do what is needed here.
const FARTHEST: f64 = 1e200;

/// Kernels that are kept at hand while points go by.
const BLOCK: usize = 32;

/// A kernel t_ν(centre, factor factorᵀ) with its share of the mixture.
#[derive(Clone, Copy, Debug)]
pub struct Kernel<const D: usize> {
    /// Centre c.
    pub centre: [f64; D],
    /// Lower triangular root L of the scale matrix.
    pub factor: Matrix<D>,
    /// Share of the mixture; the shares need not sum to one.
    pub share: f64,
}

/// What an evaluation needs of a kernel: z = A x − b, then height · (1 + |z|²/ν)^(−(ν+D)/2).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Student<const D: usize> {
    whitener: Matrix<D>,
    offset: [f64; D],
    /// Times the kernel's share, over the largest of a mixture.
    pub height: f64,
}

impl<const D: usize> Student<D> {
    /// Of a kernel, without its share; `None` where that is singular or not finite.
    pub fn of(kernel: &Kernel<D>) -> Option<Self> {
        let nu = freedom(D);
        let norm = log_gamma_of_half(nu + D as u32)
            - log_gamma_of_half(nu)
            - 0.5 * D as f64 * (f64::from(nu) * std::f64::consts::PI).ln();
        let whitener = kernel.factor.lower_triangular_inverse()?;
        let log_det: f64 = (0..D).map(|i| kernel.factor.0[i][i].ln()).sum();
        let (offset, height) = (whitener.apply(&kernel.centre), (norm - log_det).exp());
        let sound = vector::is_finite(&offset) && height > 0.0 && height.is_finite();
        sound.then_some(Self {
            whitener,
            offset,
            height,
        })
    }

    /// |z|² and (1 + |z|²/ν)^((ν+D)/2), z = A x − b.
    #[inline(always)]
    fn at<S: Simd>(&self, simd: S, x: &[S::f64s; D]) -> (S::f64s, S::f64s) {
        let mut square = simd.splat_f64s(0.0);
        for i in 0..D {
            let mut z = simd.splat_f64s(-self.offset[i]);
            for j in 0..=i {
                z = simd.mul_add_e_f64s(simd.splat_f64s(self.whitener.0[i][j]), x[j], z);
            }
            square = simd.mul_add_e_f64s(z, z, square);
        }
        let (one, scale) = (simd.splat_f64s(1.0), simd.splat_f64s(1.0 / f64::from(freedom(D))));
        let mut factor = simd.mul_add_e_f64s(square, scale, one);
        let mut power = one;
        let mut exponent = (freedom(D) + D as u32) / 2;
        while exponent > 0 {
            if exponent & 1 == 1 {
                power = simd.mul_f64s(power, factor);
            }
            factor = simd.mul_f64s(factor, factor);
            exponent >>= 1;
        }
        (square, simd.min_f64s(power, simd.splat_f64s(FARTHEST)))
    }
}

/// Adds `factor` times the densities of all kernels to `sums` for every point.
pub(crate) fn add_densities<const D: usize>(
    kernels: &[Student<D>],
    groups: &[Group<D>],
    factor: f64,
    sums: &mut [Lanes],
) {
    pulp::Arch::new().dispatch(Summed {
        kernels,
        groups,
        factor,
        sums,
    });
}

/// What some kernels are to the points of a group.
pub(crate) struct Responsible {
    /// Squared distance from every one of them, and its density.
    pub each: Vec<(Lanes, Lanes)>,
    /// Sums of the densities.
    pub totals: Lanes,
    /// Which of them have more than a given share of the density at any of the points.
    pub found: Vec<usize>,
}

impl Responsible {
    /// For at most so many kernels.
    pub fn new(count: usize) -> Self {
        Self {
            each: vec![([0.0; LANES], [0.0; LANES]); count],
            totals: [0.0; LANES],
            found: Vec::with_capacity(count),
        }
    }

    /// Of the kernels with these numbers for this group; shares up to `least` are none.
    pub fn find<const D: usize>(&mut self, kernels: &[Student<D>], numbers: &[u32], group: &Group<D>, least: f64) {
        pulp::Arch::new().dispatch(Find {
            responsible: self,
            kernels,
            numbers,
            group,
            least,
        });
    }
}

struct Summed<'a, const D: usize> {
    kernels: &'a [Student<D>],
    groups: &'a [Group<D>],
    factor: f64,
    sums: &'a mut [Lanes],
}

impl<const D: usize> WithSimd for Summed<'_, D> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let factor = simd.splat_f64s(self.factor);
        for kernels in self.kernels.chunks(BLOCK) {
            for (group, sums) in self.groups.iter().zip(&mut *self.sums) {
                let sums = S::as_mut_simd_f64s(sums).0;
                for (part, sum) in sums.iter_mut().enumerate() {
                    let density = density_of(simd, kernels, &part_of::<S, D>(group, part));
                    *sum = simd.mul_add_e_f64s(factor, density, *sum);
                }
            }
        }
    }
}

/// Σ h/p of some kernels at some points. Two kernels share a division: h₁/p₁ + h₂/p₂ = (h₁p₂ + h₂p₁)/(p₁p₂).
#[inline(always)]
fn density_of<S: Simd, const D: usize>(simd: S, kernels: &[Student<D>], x: &[S::f64s; D]) -> S::f64s {
    let mut density = simd.splat_f64s(0.0);
    let (pairs, last) = kernels.as_chunks::<2>();
    for pair in pairs {
        let [first, second] = pair.map(|kernel| simd.splat_f64s(kernel.height));
        let [p, q] = [pair[0].at(simd, x).1, pair[1].at(simd, x).1];
        let sum = simd.mul_add_e_f64s(first, q, simd.mul_f64s(second, p));
        density = simd.add_f64s(density, simd.div_f64s(sum, simd.mul_f64s(p, q)));
    }
    for kernel in last {
        let quotient = simd.div_f64s(simd.splat_f64s(kernel.height), kernel.at(simd, x).1);
        density = simd.add_f64s(density, quotient);
    }
    density
}

struct Find<'a, const D: usize> {
    responsible: &'a mut Responsible,
    kernels: &'a [Student<D>],
    numbers: &'a [u32],
    group: &'a Group<D>,
    least: f64,
}

impl<const D: usize> WithSimd for Find<'_, D> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Responsible { each, totals, found } = self.responsible;
        let each = &mut each[..self.numbers.len()];
        let parts = LANES / S::F64_LANES;
        let totals = S::as_mut_simd_f64s(totals).0;
        totals.fill(simd.splat_f64s(f64::MIN_POSITIVE));
        for (number, (squares, densities)) in self.numbers.iter().zip(each.iter_mut()) {
            let kernel = &self.kernels[*number as usize];
            let (squares, densities) = (S::as_mut_simd_f64s(squares).0, S::as_mut_simd_f64s(densities).0);
            for part in 0..parts {
                let power;
                (squares[part], power) = kernel.at(simd, &part_of::<S, D>(self.group, part));
                densities[part] = simd.div_f64s(simd.splat_f64s(kernel.height), power);
                totals[part] = simd.add_f64s(totals[part], densities[part]);
            }
        }
        found.clear();
        let least = simd.splat_f64s(self.least);
        for (place, (_, densities)) in each.iter().enumerate() {
            let densities = S::as_simd_f64s(densities).0;
            let is_found = |part: usize| {
                let more = simd.greater_than_f64s(densities[part], simd.mul_f64s(least, totals[part]));
                simd.first_true_m64s(more) < S::F64_LANES
            };
            if (0..parts).any(is_found) {
                found.push(place);
            }
        }
    }
}

/// Some points of a group, as many as there are lanes.
#[inline(always)]
fn part_of<S: Simd, const D: usize>(group: &Group<D>, part: usize) -> [S::f64s; D] {
    std::array::from_fn(|axis| S::as_simd_f64s(&group[axis]).0[part])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::packed;

    #[test]
    fn densities_are_the_formula() {
        let kernel = |k: f64| Kernel {
            centre: [0.3 * k, -0.1, 0.2],
            factor: Matrix([[1.0 + k, 0.0, 0.0], [0.4, 0.7, 0.0], [-0.2, k, 2.0]]),
            share: 1.0,
        };
        let kernels = [kernel(0.0), kernel(1.5), kernel(0.7)];
        let students = kernels.map(|kernel| Student::of(&kernel).unwrap());
        let points: Vec<[f64; 3]> = (0..8)
            .map(|n| [0.1, 0.5, 0.9].map(|rate| (rate * f64::from(n)).sin()))
            .collect();
        let group = &packed(&points)[0];
        let mut responsible = Responsible::new(3);
        responsible.find(&students, &[0, 1, 2], group, 1e-4);
        let mut sums = [[1.0; LANES]];
        add_densities(&students, &packed(&points), 2.0, &mut sums);
        for (lane, x) in points.iter().enumerate() {
            let mut total = 0.0;
            for (kernel, (squares, densities)) in kernels.iter().zip(&responsible.each) {
                let z = kernel
                    .factor
                    .lower_triangular_inverse()
                    .unwrap()
                    .apply(&vector::subtract(x, &kernel.centre));
                let square = vector::norm_squared(&z);
                // Γ(10)/Γ(17/2) (17 π)^(−3/2) (1 + r²/17)^(−10)/det L.
                let constant =
                    (log_gamma_of_half(20) - log_gamma_of_half(17) - 1.5 * (17.0 * std::f64::consts::PI).ln()).exp();
                let determinant: f64 = (0..3).map(|i| kernel.factor.0[i][i]).product();
                let wanted = constant / determinant * (1.0 + square / 17.0).powi(-10);
                assert!((squares[lane] - square).abs() < 1e-12 * (1.0 + square));
                assert!(
                    (densities[lane] / wanted - 1.0).abs() < 1e-12,
                    "{} {wanted}",
                    densities[lane]
                );
                total += wanted;
            }
            assert!((responsible.totals[lane] / total - 1.0).abs() < 1e-12);
            assert!((sums[0][lane] - 1.0 - 2.0 * total).abs() < 1e-12);
        }
        assert_eq!(responsible.found, [0, 1, 2]);
        // No kernel has all of the density, where there are two.
        responsible.find(&students, &[0, 1, 2], group, 1.0);
        assert!(responsible.found.is_empty());
    }
}
