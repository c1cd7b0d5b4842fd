//! Mixtures of Student kernels: drawn from by quasi-random points, evaluated eight points at a time.

use mpm_tensor::{Matrix, vector};
use parvi_targets::{SobolSequence, normal_quantile};

use crate::gamma::{gamma_quantile, log_gamma_of_half};
use crate::lanes::{Group, LANES, Lanes};

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
struct Coefficients<const D: usize> {
    whitener: Matrix<D>,
    offset: [f64; D],
    height: f64,
}

/// A normalised mixture of Student kernels with ν = 16 degrees of freedom.
///
/// t_ν(x; c, L Lᵀ) = Γ((ν+D)/2) / (Γ(ν/2) (πν)^{D/2} det L) · (1 + |L⁻¹(x − c)|²/ν)^{−(ν+D)/2}: polynomial in |z|², so that no exponential has to
/// be taken, and with tails that a target lighter than t_ν never outgrows.
#[derive(Clone, Debug)]
pub struct Mixture<const D: usize> {
    kernels: Vec<Kernel<D>>,
    coefficients: Vec<Coefficients<D>>,
    /// So many kernels, the first ones, are fitted; the others are there to be on the safe side.
    core: usize,
}

/// ν/2 of all kernels.
pub(super) const HALF_FREEDOM: u32 = 8;

/// Groups of points that one task evaluates.
const TILE: usize = 32;

impl<const D: usize> Mixture<D> {
    /// The mixture with shares scaled to one. Kernels that are not finite, singular or without share are left out; `None` if none is left.
    pub fn new(kernels: Vec<Kernel<D>>) -> Option<Self> {
        let nu = 2.0 * f64::from(HALF_FREEDOM);
        let d = D as f64;
        let norm = log_gamma_of_half(2 * HALF_FREEDOM + D as u32)
            - log_gamma_of_half(2 * HALF_FREEDOM)
            - 0.5 * d * (nu * std::f64::consts::PI).ln();
        let usable = |kernel: &Kernel<D>| {
            let whitener = kernel.factor.lower_triangular_inverse()?;
            let log_det: f64 = (0..D).map(|i| kernel.factor.0[i][i].ln()).sum();
            let height = (norm - log_det).exp();
            let sound = kernel.share > 0.0 && kernel.share.is_finite() && vector::is_finite(&kernel.centre);
            (sound && height > 0.0 && height.is_finite()).then(|| Coefficients {
                whitener,
                offset: whitener.apply(&kernel.centre),
                height,
            })
        };
        let (mut kept, mut coefficients) = (Vec::new(), Vec::new());
        for kernel in kernels {
            if let Some(found) = usable(&kernel).filter(|found| vector::is_finite(&found.offset)) {
                kept.push(kernel);
                coefficients.push(found);
            }
        }
        let total: f64 = kept.iter().map(|kernel| kernel.share).sum();
        if !(total > 0.0 && total.is_finite()) {
            return None;
        }
        for (kernel, coefficients) in kept.iter_mut().zip(&mut coefficients) {
            kernel.share /= total;
            coefficients.height *= kernel.share;
        }
        Some(Self {
            core: kept.len(),
            kernels: kept,
            coefficients,
        })
    }

    /// The first `count` kernels are the fitted ones.
    pub(crate) fn with_core(mut self, count: usize) -> Self {
        self.core = count.min(self.kernels.len());
        self
    }

    /// Number of the fitted kernels.
    pub(crate) fn core_count(&self) -> usize {
        self.core
    }

    /// The mixture of the fitted kernels alone.
    pub(crate) fn core(&self) -> Option<Self> {
        Self::new(self.kernels[..self.core].to_vec())
    }

    /// The kernels, shares summing to one.
    pub fn kernels(&self) -> &[Kernel<D>] {
        &self.kernels
    }

    /// `count` draws: a scrambled Sobol' sequence whose first coordinate picks the kernel (in the order of the kernels), whose second its radius
    /// and whose others its direction.
    pub fn draws(&self, count: usize, seed: u64) -> Vec<[f64; D]> {
        let Ok(sequence) = SobolSequence::scrambled(D + 2, seed) else {
            return Vec::new();
        };
        let mut cumulated = Vec::with_capacity(self.kernels.len());
        let mut sum = 0.0;
        for kernel in &self.kernels {
            sum += kernel.share;
            cumulated.push(sum);
        }
        let draw = |index: u32| {
            // Twenty-one coordinates are the most that the sequence has.
            let mut u = [0.0; 21];
            sequence.write(index, &mut u);
            let last = self.kernels.len() - 1;
            let kernel = &self.kernels[cumulated.partition_point(|&c| c < u[0] * sum).min(last)];
            let m = f64::from(HALF_FREEDOM);
            let stretch = (m / gamma_quantile(HALF_FREEDOM, u[1])).sqrt();
            let z = std::array::from_fn(|axis| stretch * normal_quantile(u[axis + 2]));
            vector::add(&kernel.centre, &kernel.factor.apply(&z))
        };
        mpm_parallel::collect(count, TILE, &|index| draw(index as u32))
    }

    /// Adds `factor` · q(x) to `sums` for every point.
    pub(super) fn add_density(&self, groups: &[Group<D>], factor: f64, sums: &mut [Lanes]) {
        let tiles = groups.chunks(TILE).zip(sums.chunks_mut(TILE));
        mpm_parallel::each(tiles, &|(groups, sums): (&[Group<D>], &mut [Lanes])| {
            for (group, sum) in groups.iter().zip(sums) {
                let mut density = [0.0; LANES];
                for kernel in &self.coefficients {
                    let value = self.kernel_density(kernel, group);
                    for lane in 0..LANES {
                        density[lane] += value[lane];
                    }
                }
                for lane in 0..LANES {
                    sum[lane] += factor * density[lane];
                }
            }
        });
    }

    /// q(x) for every point.
    pub(super) fn densities(&self, groups: &[Group<D>]) -> Vec<Lanes> {
        let mut sums = vec![[0.0; LANES]; groups.len()];
        self.add_density(groups, 1.0, &mut sums);
        sums
    }

    /// share · t_ν(x) of every kernel for one group, handed to `take` with the kernel's number, its squared distance and its density.
    pub(super) fn each_kernel(&self, group: &Group<D>, mut take: impl FnMut(usize, &Lanes, &Lanes)) {
        for (k, kernel) in self.coefficients.iter().enumerate() {
            let squares = squared_distances(kernel, group);
            let density = self.profile(kernel.height, &squares);
            take(k, &squares, &density);
        }
    }

    #[inline]
    fn kernel_density(&self, kernel: &Coefficients<D>, group: &Group<D>) -> Lanes {
        self.profile(kernel.height, &squared_distances(kernel, group))
    }

    /// height · (1 + r²/ν)^(−(ν+D)/2).
    #[inline]
    fn profile(&self, height: f64, squares: &Lanes) -> Lanes {
        let scale = 0.5 / f64::from(HALF_FREEDOM);
        let base = squares.map(|r2| 1.0 + r2 * scale);
        let mut power = if D % 2 == 1 { base.map(f64::sqrt) } else { [1.0; LANES] };
        let mut exponent = HALF_FREEDOM + D as u32 / 2;
        let mut factor = base;
        while exponent > 0 {
            if exponent & 1 == 1 {
                for lane in 0..LANES {
                    power[lane] *= factor[lane];
                }
            }
            for lane in 0..LANES {
                factor[lane] *= factor[lane];
            }
            exponent >>= 1;
        }
        power.map(|p| height / p)
    }
}

/// |A x − b|² of the points of a group.
#[inline]
fn squared_distances<const D: usize>(kernel: &Coefficients<D>, group: &Group<D>) -> Lanes {
    let mut squares = [0.0; LANES];
    for i in 0..D {
        let mut z = [-kernel.offset[i]; LANES];
        for j in 0..=i {
            let a = kernel.whitener.0[i][j];
            for lane in 0..LANES {
                z[lane] = vector::multiply_add(a, group[j][lane], z[lane]);
            }
        }
        for lane in 0..LANES {
            squares[lane] = vector::multiply_add(z[lane], z[lane], squares[lane]);
        }
    }
    squares
}
