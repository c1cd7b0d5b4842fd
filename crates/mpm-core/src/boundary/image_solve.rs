//! The nodes before a held surface take up what those behind it, their images, have: the linear system of docs/mechanics.md, section 7.

use mpm_tensor::vector;

use super::Contact;

/// What is unknown, and the vectors of the conjugate gradients. Unknowns are the velocities of all sources.
#[derive(Default)]
pub(super) struct Work<const D: usize> {
    /// Of every image that has its sources: its place in the list, its number, and the end of its sources in `sources`.
    pub(super) images: Vec<(usize, usize, usize)>,
    /// Unknown and share.
    pub(super) sources: Vec<(usize, f64)>,
    /// Number of the node of every unknown.
    pub(super) numbers: Vec<usize>,
    pub(super) free: Vec<Free<D>>,
    /// Unknown of every node.
    pub(super) places: Vec<u32>,
    diagonal: Vec<f64>,
    residual: Vec<[f64; D]>,
    direction: Vec<[f64; D]>,
    product: Vec<[f64; D]>,
    pub(super) change: Vec<[f64; D]>,
}

/// How the velocity of an unknown may change.
#[derive(Clone, Copy)]
pub(super) enum Free<const D: usize> {
    All,
    Along([f64; D]),
    Nothing,
}

impl<const D: usize> Free<D> {
    fn of(self, change: [f64; D]) -> [f64; D] {
        match self {
            Self::All => change,
            Self::Along(normal) => Contact::Slip.resolve(&normal, &change),
            Self::Nothing => [0.0; D],
        }
    }
}

pub(super) const NO_UNKNOWN: u32 = u32::MAX;

/// The residual, as a share of the first one, at which the iteration ends, and how many there are at most.
const TOLERANCE: f64 = 1e-13;
const MOST_ITERATIONS: usize = 100;

/// Σ_k b_k v_k over the sources of an image.
pub(super) fn at_mirror<const D: usize>(sources: &[(usize, f64)], velocity: impl Fn(usize) -> [f64; D]) -> [f64; D] {
    let mut sum = [0.0; D];
    for &(unknown, share) in sources {
        vector::accumulate(&mut sum, share, &velocity(unknown));
    }
    sum
}

impl<const D: usize> Work<D> {
    pub(super) fn unknown(&mut self, number: usize) -> usize {
        if self.places[number] == NO_UNKNOWN {
            self.places[number] = self.numbers.len() as u32;
            self.numbers.push(number);
            self.free.push(Free::All);
        }
        self.places[number] as usize
    }

    /// Place, number, and sources of every image that has them.
    pub(super) fn with_sources(&self) -> impl Iterator<Item = (usize, usize, &[(usize, f64)])> {
        let starts = std::iter::once(0).chain(self.images.iter().map(|image| image.2));
        let images = self.images.iter().zip(starts);
        images.map(|(&(image, number, end), start)| (image, number, &self.sources[start..end]))
    }

    /// The diagonal of A, and Bᵀ m (image of the node − velocity at its mirror point).
    pub(super) fn begin(
        &mut self,
        masses: &[f64],
        lacking: impl Fn(usize, usize, &[f64; D]) -> [f64; D],
        velocity: impl Fn(usize) -> [f64; D],
    ) {
        let (mut diagonal, mut residual) = (std::mem::take(&mut self.diagonal), std::mem::take(&mut self.residual));
        diagonal.clear();
        diagonal.extend(self.numbers.iter().map(|&number| masses[number]));
        residual.clear();
        residual.resize(diagonal.len(), [0.0; D]);
        for (image, number, sources) in self.with_sources() {
            let at_mirror = at_mirror(sources, |unknown| velocity(self.numbers[unknown]));
            let lacking = lacking(image, number, &at_mirror);
            for &(unknown, share) in sources {
                diagonal[unknown] += share * share * masses[number];
                vector::accumulate(&mut residual[unknown], share * masses[number], &lacking);
            }
        }
        (self.diagonal, self.residual) = (diagonal, residual);
    }

    /// A x = m x + Σ over images Bᵀ m B x.
    fn apply(&mut self, masses: &[f64]) {
        let mut product = std::mem::take(&mut self.product);
        product.clear();
        let own = self.numbers.iter().zip(&self.direction);
        product.extend(own.map(|(&number, x)| vector::scale(x, masses[number])));
        for (_, number, sources) in self.with_sources() {
            let at_mirror = at_mirror(sources, |unknown| self.direction[unknown]);
            for &(unknown, share) in sources {
                vector::accumulate(&mut product[unknown], share * masses[number], &at_mirror);
            }
        }
        self.product = product;
    }

    /// `change`, which solves A x = `residual` in what is free, by conjugate gradients over the diagonal. Negative masses may leave A without an inverse: it ends there.
    pub(super) fn solve(&mut self, masses: &[f64]) {
        let count = self.numbers.len();
        self.change.clear();
        self.change.resize(count, [0.0; D]);
        self.direction.clear();
        self.direction.resize(count, [0.0; D]);
        let (mut first, mut last) = (0.0, 0.0);
        for iteration in 0..MOST_ITERATIONS {
            let mut size = 0.0;
            for k in 0..count {
                self.residual[k] = self.free[k].of(self.residual[k]);
                if self.diagonal[k].is_normal() {
                    size += vector::dot(&self.residual[k], &self.residual[k]) / self.diagonal[k];
                }
            }
            if iteration == 0 {
                first = size;
            }
            let is_left = size > TOLERANCE * TOLERANCE * first;
            if !is_left {
                return;
            }
            let keep = if iteration == 0 { 0.0 } else { size / last };
            for k in 0..count {
                let scaled = if self.diagonal[k].is_normal() {
                    vector::scale(&self.residual[k], 1.0 / self.diagonal[k])
                } else {
                    [0.0; D]
                };
                self.direction[k] = vector::add_scaled(&scaled, keep, &self.direction[k]);
            }
            self.apply(masses);
            let curvature: f64 = self
                .direction
                .iter()
                .zip(&self.product)
                .map(|(x, y)| vector::dot(x, y))
                .sum();
            let is_definite = curvature > 0.0;
            if !is_definite {
                return;
            }
            let step = size / curvature;
            for k in 0..count {
                vector::accumulate(&mut self.change[k], step, &self.direction[k]);
                vector::accumulate(&mut self.residual[k], -step, &self.product[k]);
            }
            last = size;
        }
    }

    /// The masses that unknowns and images have together.
    pub(super) fn join(&self, masses: &mut [f64]) {
        for (_, number, sources) in self.with_sources() {
            for &(unknown, share) in sources {
                masses[self.numbers[unknown]] += share * masses[number];
            }
        }
        for (_, number, sources) in self.with_sources() {
            let joined = sources
                .iter()
                .map(|&(unknown, share)| share * masses[self.numbers[unknown]]);
            masses[number] = joined.sum();
        }
    }
}
