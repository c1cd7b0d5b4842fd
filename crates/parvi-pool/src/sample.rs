//! Weighted points that a proposal is fitted to.

use mpm_tensor::{Cholesky, Matrix, vector};

use crate::weights::{runs, systematic};

/// Points with weights, and the logarithm of the density that they follow, up to a constant.
#[derive(Clone, Debug, Default)]
pub(super) struct Sample<const D: usize> {
    pub points: Vec<[f64; D]>,
    pub weights: Vec<f64>,
    pub logs: Vec<f64>,
    /// What curvature adds to the precision of a kernel there; no kernel begins where there is `None`.
    pub precisions: Vec<Option<Matrix<D>>>,
}

impl<const D: usize> Sample<D> {
    /// `count` of these points by systematic resampling, each with the number of times that it was chosen.
    pub fn resampled(&self, count: usize, offset: f64) -> Self {
        let chosen = runs(systematic(&self.weights, count, offset));
        Self {
            points: chosen.iter().map(|&(i, _)| self.points[i]).collect(),
            weights: chosen.iter().map(|&(_, times)| times).collect(),
            logs: chosen.iter().map(|&(i, _)| self.logs[i]).collect(),
            precisions: chosen.iter().map(|&(i, _)| self.precisions[i]).collect(),
        }
    }

    /// Takes the points of another sample in.
    pub fn join(&mut self, other: Self) {
        self.points.extend(other.points);
        self.weights.extend(other.weights);
        self.logs.extend(other.logs);
        self.precisions.extend(other.precisions);
    }

    /// The points about which kernels may begin.
    pub fn seats(&self) -> Self {
        self.part(|i| self.precisions[i].is_some())
    }

    /// Every third point for a check, the others to learn from.
    pub fn split(&self) -> [Self; 2] {
        [false, true].map(|checks| self.part(|i| (i % 3 == 1) == checks))
    }

    /// The points that `is_taken` takes.
    fn part(&self, is_taken: impl Fn(usize) -> bool) -> Self {
        let taken: Vec<usize> = (0..self.points.len()).filter(|&i| is_taken(i)).collect();
        Self {
            points: taken.iter().map(|&i| self.points[i]).collect(),
            weights: taken.iter().map(|&i| self.weights[i]).collect(),
            logs: taken.iter().map(|&i| self.logs[i]).collect(),
            precisions: taken.iter().map(|&i| self.precisions[i]).collect(),
        }
    }

    /// Mean and covariance.
    pub fn moments(&self) -> ([f64; D], Matrix<D>) {
        moments(&self.points, &self.weights)
    }
}

/// Mean and covariance of weighted points.
pub(super) fn moments<const D: usize>(points: &[[f64; D]], weights: &[f64]) -> ([f64; D], Matrix<D>) {
    let total: f64 = weights.iter().sum();
    let weighted = || points.iter().zip(weights).filter(|(_, w)| **w > 0.0);
    let mut mean = [0.0; D];
    for (x, w) in weighted() {
        vector::accumulate(&mut mean, w / total, x);
    }
    let mut covariance = Matrix::ZERO;
    for (x, w) in weighted() {
        let x = vector::subtract(x, &mean);
        for i in 0..D {
            vector::accumulate(&mut covariance.0[i], x[i] * w / total, &x);
        }
    }
    (mean, covariance)
}

/// The Cholesky factor of a covariance, with as little of its diagonal added as makes it definite.
pub(super) fn root<const D: usize>(covariance: &Matrix<D>) -> Matrix<D> {
    let variance = |i: usize| {
        Some(covariance.0[i][i])
            .filter(|v| (1e-200..1e200).contains(v))
            .unwrap_or(1e-200)
    };
    let mut ridge = 1e-12;
    while ridge < 1.0 {
        let mut matrix = *covariance;
        for i in 0..D {
            matrix.0[i][i] = (1.0 + ridge) * variance(i);
        }
        if let Ok(factor) = Cholesky::new(&matrix) {
            return *factor.lower();
        }
        ridge *= 100.0;
    }
    Matrix::diagonal(&std::array::from_fn(|i| variance(i).sqrt()))
}
