//! min_w ½ wᵀ Q w − qᵀ w over w ≥ 0.

use mpm_dense::{Cholesky, DenseMatrix};

/// min_w ½ wᵀ Q w − qᵀ w over w ≥ 0 with Q positive definite, by the active sets of Lawson & Hanson (*Solving least squares problems*, 1974, algorithm 23.10), one entry at a time, so that it can be
/// ended while few entries are positive.
pub struct NonNegative {
    matrix: DenseMatrix,
    right: Vec<f64>,
    /// w.
    pub weights: Vec<f64>,
    /// The entries that are positive, in the order in which they came.
    pub positive: Vec<usize>,
    /// Entries that rounding threw out again as soon as they came, since another came last.
    barred: Vec<usize>,
}

impl NonNegative {
    /// w = 0.
    pub fn new(matrix: DenseMatrix, right: Vec<f64>) -> Self {
        Self {
            weights: vec![0.0; right.len()],
            matrix,
            right,
            positive: Vec::new(),
            barred: Vec::new(),
        }
    }

    /// Lets the entry with the steepest descent become positive, (q − Q w)_k / √Q_kk, the first of equals, and finds the least value with the entries that are; some may fall back to zero. False where no
    /// entry lowers the value.
    pub fn raise_one(&mut self) -> bool {
        let zero = (0..self.weights.len()).filter(|k| self.weights[*k] == 0.0 && !self.barred.contains(k));
        let (mut steepest, mut largest) = (None, 0.0);
        for k in zero {
            let slope = self.descent(k);
            if slope > largest {
                (steepest, largest) = (Some(k), slope);
            }
        }
        let Some(entry) = steepest else { return false };
        self.positive.push(entry);
        self.settle();
        if self.weights[entry] > 0.0 {
            self.barred.clear();
        } else {
            self.barred.push(entry);
        }
        true
    }

    fn descent(&self, entry: usize) -> f64 {
        let pulled: f64 = self
            .positive
            .iter()
            .map(|&k| self.matrix[(entry, k)] * self.weights[k])
            .sum();
        (self.right[entry] - pulled) / self.matrix[(entry, entry)].sqrt()
    }

    /// The least value with the positive entries: straight towards it, and wherever an entry comes to zero, without that one.
    fn settle(&mut self) {
        while !self.positive.is_empty() {
            let Some(goal) = self.unconstrained() else {
                // Not positive definite: the last entry says nothing that the others do not.
                let last = self.positive.pop();
                last.into_iter().for_each(|k| self.weights[k] = 0.0);
                continue;
            };
            let steps = self.positive.iter().zip(&goal).filter(|(_, goal)| **goal <= 0.0);
            let parts = steps.map(|(&k, goal)| self.weights[k] / (self.weights[k] - goal));
            let part = parts.fold(1.0, f64::min);
            for (&k, goal) in self.positive.iter().zip(&goal) {
                let moved = self.weights[k] + part * (goal - self.weights[k]);
                // What fell is zero to the last bit.
                self.weights[k] = if *goal <= 0.0 && moved <= 1e-14 * self.weights[k] {
                    0.0
                } else {
                    moved
                };
            }
            self.positive.retain(|&k| self.weights[k] > 0.0);
            if part == 1.0 && goal.iter().all(|goal| *goal > 0.0) {
                return;
            }
        }
    }

    /// Q⁻¹ q of the positive entries.
    fn unconstrained(&self) -> Option<Vec<f64>> {
        let (entries, count) = (&self.positive, self.positive.len());
        let matrix = DenseMatrix::from_fn(count, count, |i, j| self.matrix[(entries[i], entries[j])]);
        let right: Vec<f64> = entries.iter().map(|&entry| self.right[entry]).collect();
        let solution = Cholesky::new(&matrix)?.solve(&right);
        solution.iter().all(|w| w.is_finite()).then_some(solution)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn problem(rows: &[Vec<f64>], target: &[f64]) -> (DenseMatrix, Vec<f64>) {
        let n = rows[0].len();
        let product = |i: usize, j: usize| rows.iter().map(|row| row[i] * row[j]).sum::<f64>();
        let matrix = DenseMatrix::from_fn(n, n, |i, j| product(i, j) + if i == j { 0.01 } else { 0.0 });
        let right = (0..n).map(|i| rows.iter().zip(target).map(|(row, y)| row[i] * y).sum());
        (matrix, right.collect())
    }

    fn solved(matrix: &DenseMatrix, right: &[f64]) -> Vec<f64> {
        let mut solver = NonNegative::new(matrix.clone(), right.to_vec());
        while solver.raise_one() {}
        assert_eq!(
            solver.positive.len(),
            solver.weights.iter().filter(|w| **w > 0.0).count()
        );
        solver.weights.clone()
    }

    #[test]
    fn a_solution_that_is_positive_anyway_is_that_of_the_equations() {
        let matrix = DenseMatrix::from_fn(2, 2, |i, j| if i == j { 2.0 } else { 0.5 });
        let weights = solved(&matrix, &[3.0, 1.5]);
        assert!(
            (weights[0] - 1.4).abs() < 1e-14 && (weights[1] - 0.4).abs() < 1e-14,
            "{weights:?}"
        );
        let weights = solved(&matrix, &[3.0, -1.0]);
        assert!((weights[0] - 1.5).abs() < 1e-14 && weights[1] == 0.0, "{weights:?}");
    }

    proptest! {
        /// The conditions of Karush, Kuhn and Tucker: w ≥ 0, Q w − q ≥ 0, and one of both is zero.
        #[test]
        fn the_end_is_the_minimum(
            rows in prop::collection::vec(prop::collection::vec(-1.0_f64..1.0, 12), 8),
            target in prop::collection::vec(-1.0_f64..1.0, 8),
        ) {
            let (matrix, right) = problem(&rows, &target);
            let weights = solved(&matrix, &right);
            for i in 0..right.len() {
                let gradient: f64 = (0..right.len()).map(|j| matrix[(i, j)] * weights[j]).sum::<f64>() - right[i];
                prop_assert!(weights[i] >= 0.0 && gradient > -1e-9, "{i}: {} {gradient}", weights[i]);
                prop_assert!(weights[i] == 0.0 || gradient.abs() < 1e-9, "{i}: {} {gradient}", weights[i]);
            }
        }
    }
}
