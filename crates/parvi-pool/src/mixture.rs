//! Mixtures of Student kernels: drawn from by quasi-random points, evaluated eight points at a time.

use mpm_tensor::vector;
use parvi_targets::{SobolSequence, normal_quantile};

use crate::lanes::{Group, LANES, Lanes};
use crate::stretch::Stretch;
use crate::student::{Kernel, Responsible, Student, add_densities, freedom};

/// A normalised mixture of Student kernels with ν = 16 degrees of freedom, 17 where D is odd.
///
/// t_ν(x; c, L Lᵀ) = Γ((ν+D)/2) / (Γ(ν/2) (πν)^{D/2} det L) · (1 + |L⁻¹(x − c)|²/ν)^{−(ν+D)/2}: polynomial in |z|², so that no exponential has to
/// be taken, and with tails that a target lighter than t_ν never outgrows.
#[derive(Clone, Debug)]
pub struct Mixture<const D: usize> {
    kernels: Vec<Kernel<D>>,
    students: Vec<Student<D>>,
    /// The largest height of the kernels times their shares.
    height: f64,
    /// So many kernels, the first ones, are fitted; the others are there to be on the safe side.
    core: usize,
}

/// The farthest that a kernel may be away, and the widest that it may be.
const LARGEST_LENGTH: f64 = 1e150;

/// Groups of points that one task evaluates.
const TILE: usize = 32;

impl<const D: usize> Mixture<D> {
    /// The mixture with shares scaled to one. Kernels that are singular, without share, or farther away or wider than 1e150, where squares of distances are not finite, are left
    /// out; `None` if none is left.
    pub fn new(kernels: Vec<Kernel<D>>) -> Option<Self> {
        let (mut kept, mut students) = (Vec::new(), Vec::new());
        for kernel in kernels {
            let mut lengths = kernel.centre.iter().chain(kernel.factor.0.as_flattened());
            let within = lengths.all(|c| c.abs() <= LARGEST_LENGTH);
            let sound = kernel.share > 0.0 && kernel.share.is_finite() && within;
            if let Some(student) = Student::of(&kernel).filter(|_| sound) {
                kept.push(kernel);
                students.push(student);
            }
        }
        let total: f64 = kept.iter().map(|kernel| kernel.share).sum();
        if !(total > 0.0 && total.is_finite()) {
            return None;
        }
        for (kernel, student) in kept.iter_mut().zip(&mut students) {
            kernel.share /= total;
            student.height *= kernel.share;
        }
        let height = students.iter().map(|student| student.height).fold(0.0, f64::max);
        for student in &mut students {
            student.height /= height;
        }
        Some(Self {
            core: kept.len(),
            height,
            kernels: kept,
            students,
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

    /// The kernels as this share of another mixture.
    pub(crate) fn shared(&self, share: f64) -> impl Iterator<Item = Kernel<D>> {
        self.kernels.iter().map(move |kernel| Kernel {
            share: share * kernel.share,
            ..*kernel
        })
    }

    /// `count` draws: a scrambled Sobol' sequence whose first coordinate picks the kernel (in the order of the kernels), whose second its radius
    /// and whose others its direction.
    pub fn draws(&self, count: usize, seed: u64) -> Vec<[f64; D]> {
        self.drawn(seed).map_or_else(Vec::new, |draw| {
            mpm_parallel::collect(count, TILE, &|index| draw(index as u32))
        })
    }

    /// The draw of every number in [`draws`](Self::draws), for whoever does not know how many are wanted.
    pub(super) fn drawn(&self, seed: u64) -> Option<impl Fn(u32) -> [f64; D] + Sync> {
        let stretch = Stretch::of(freedom(D));
        self.placed(seed, move |u, z| vector::scale(z, stretch.at(u)))
    }

    /// As [`draws`](Self::draws), in all directions at the distances `radius`(u) in standard deviations of the kernels, u even in [0, 1).
    pub(super) fn about(&self, count: usize, seed: u64, radius: impl Fn(f64) -> f64 + Sync) -> Vec<[f64; D]> {
        let placed = self.placed(seed, |u, z| {
            vector::scale(z, radius(u) / vector::norm(z).max(f64::MIN_POSITIVE))
        });
        placed.map_or_else(Vec::new, |place| {
            mpm_parallel::collect(count, TILE, &|index| place(index as u32))
        })
    }

    /// Places c + L y of kernels picked by their shares, by their numbers, y by `place` of a number even in [0, 1) and of a normal law's draw.
    fn placed(
        &self,
        seed: u64,
        place: impl Fn(f64, &[f64; D]) -> [f64; D] + Sync,
    ) -> Option<impl Fn(u32) -> [f64; D] + Sync> {
        let sequence = SobolSequence::scrambled(D + 2, seed).ok()?;
        let mut cumulated = Vec::with_capacity(self.kernels.len());
        let mut sum = 0.0;
        for kernel in &self.kernels {
            sum += kernel.share;
            cumulated.push(sum);
        }
        let last = self.kernels.len() - 1;
        Some(move |index: u32| {
            // Twenty-one coordinates are the most that the sequence has.
            let mut u = [0.0; 21];
            sequence.write(index, &mut u);
            let kernel = &self.kernels[cumulated.partition_point(|&c| c < u[0] * sum).min(last)];
            let z = std::array::from_fn(|axis| normal_quantile(u[axis + 2]));
            vector::add(&kernel.centre, &kernel.factor.apply(&place(u[1], &z)))
        })
    }

    /// Adds `factor` · q(x) to `sums` for every point.
    pub(super) fn add_density(&self, groups: &[Group<D>], factor: f64, sums: &mut [Lanes]) {
        let tiles = groups.chunks(TILE).zip(sums.chunks_mut(TILE));
        mpm_parallel::each(tiles, &|(groups, sums): (&[Group<D>], &mut [Lanes])| {
            add_densities(&self.students, groups, factor * self.height, sums);
        });
    }

    /// q(x) for every point.
    pub(super) fn densities(&self, groups: &[Group<D>]) -> Vec<Lanes> {
        let mut sums = vec![[0.0; LANES]; groups.len()];
        self.add_density(groups, 1.0, &mut sums);
        sums
    }

    /// Which of the kernels with these numbers the points of a group are due to.
    pub(super) fn responsible(&self, numbers: &[u32], group: &Group<D>, least: f64, found: &mut Responsible) {
        found.find(&self.students, numbers, group, least);
    }
}
