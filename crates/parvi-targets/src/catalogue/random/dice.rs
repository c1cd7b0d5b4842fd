//! The choices that a seed makes.

use mpm_tensor::Matrix;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use rand_distr::{Distribution, StandardNormal};

/// A stream of choices.
pub(crate) struct Dice(ChaCha8Rng);

impl Dice {
    /// The stream of a seed; streams of one seed are independent.
    pub fn new(seed: u64, stream: u64) -> Self {
        let mut generator = ChaCha8Rng::seed_from_u64(seed);
        generator.set_stream(stream);
        Self(generator)
    }

    /// The generator itself.
    pub fn generator(&mut self) -> &mut ChaCha8Rng {
        &mut self.0
    }

    /// Uniform between two numbers.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.random::<f64>()
    }

    /// Uniform in the logarithm between two positive numbers.
    pub fn scale(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }

    /// As [`between`](Self::between), with a sign that is as often minus as plus.
    pub fn signed(&mut self, low: f64, high: f64) -> f64 {
        let size = self.between(low, high);
        if self.chance(0.5) { -size } else { size }
    }

    /// True with a probability.
    pub fn chance(&mut self, probability: f64) -> bool {
        self.0.random::<f64>() < probability
    }

    /// One of `low`, …, `high`.
    pub fn whole(&mut self, low: usize, high: usize) -> usize {
        self.0.random_range(low..=high)
    }

    /// One of a list that is not empty.
    pub fn pick<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.whole(0, list.len() - 1)]
    }

    /// A standard normal vector.
    pub fn normal<const D: usize>(&mut self) -> [f64; D] {
        std::array::from_fn(|_| StandardNormal.sample(&mut self.0))
    }

    /// `count` unequal masses, none below a fifteenth of the mean before they are divided by their sum.
    pub fn masses(&mut self, count: usize) -> Vec<f64> {
        (0..count)
            .map(|_| 0.07 - self.0.random::<f64>().max(1e-9).ln())
            .collect()
    }

    /// A uniformly distributed orthogonal matrix (rotations and reflections): Gram–Schmidt of standard normal vectors.
    pub fn orthogonal<const D: usize>(&mut self) -> Matrix<D> {
        Matrix::orthogonal(1e-3, || self.normal())
    }
}
