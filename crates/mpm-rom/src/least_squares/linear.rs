//! min_w Σ_p ω_p |J_p w − y_p|².

/// Pivots below this multiple of the largest one count as zero.
const RANK_TOLERANCE: f64 = 1e-12;

/// Why a least squares problem has no unique finite solution.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LeastSquaresError {
    /// More unknowns than equations.
    #[error("{equations} equations for {unknowns} unknowns")]
    TooFewEquations {
        /// D times the number of points.
        equations: usize,
        /// r.
        unknowns: usize,
    },
    /// The solver has weights for another number of points.
    #[error("{found} points for {expected} weights")]
    Weights {
        /// The number of points.
        found: usize,
        /// That of weights.
        expected: usize,
    },
    /// The points do not see a coordinate: its column depends on those before it.
    #[error("coordinate {coordinate} cannot be told from those before it: pivot {pivot:e} of {largest:e}")]
    RankDeficient {
        /// The coordinate, counted from 0.
        coordinate: usize,
        /// |R_kk|.
        pivot: f64,
        /// The largest pivot.
        largest: f64,
    },
    /// A residual or derivative is NaN or infinite.
    #[error("a residual or derivative is not finite")]
    NotFinite,
}

/// Solver of min_w Σ_p ω_p |J_p w − y_p|² by Householder QR; it keeps its storage from one problem to the next.
#[derive(Default)]
pub struct LeastSquares {
    /// √ω_p; none where all points weigh the same.
    roots: Vec<f64>,
    problem: mpm_dense::LeastSquares,
}

impl LeastSquares {
    /// A solver of problems whose points have these weights ω_p ≥ 0, and so many points; any number of points with the same weight if there are none.
    pub fn weighted(weights: &[f64]) -> Self {
        Self {
            roots: weights.iter().map(|weight| weight.sqrt()).collect(),
            ..Self::default()
        }
    }

    /// w, r = `solution.len()` numbers, for P points: `jacobians` has ∂/∂w_k at point p as entry p r + k, `targets` y_p.
    ///
    /// # Errors
    /// [`LeastSquaresError`]; `solution` is then as it was.
    pub fn solve<const D: usize>(
        &mut self,
        jacobians: &[[f64; D]],
        targets: &[[f64; D]],
        solution: &mut [f64],
    ) -> Result<(), LeastSquaresError> {
        let (equations, unknowns) = (D * targets.len(), solution.len());
        if equations < unknowns || jacobians.len() != unknowns * targets.len() {
            return Err(LeastSquaresError::TooFewEquations { equations, unknowns });
        }
        if !(self.roots.is_empty() || self.roots.len() == targets.len()) {
            let (found, expected) = (targets.len(), self.roots.len());
            return Err(LeastSquaresError::Weights { found, expected });
        }
        if unknowns == 0 {
            return Ok(());
        }
        self.problem.shape(equations, unknowns);
        for (p, (row, target)) in jacobians.chunks_exact(unknowns).zip(targets).enumerate() {
            let root = self.roots.get(p).copied().unwrap_or(1.0);
            for a in 0..D {
                self.problem.right[(D * p + a, 0)] = root * target[a];
                for (k, column) in row.iter().enumerate() {
                    self.problem.matrix[(D * p + a, k)] = root * column[a];
                }
            }
        }
        self.problem.factorise();
        self.check_rank()?;
        let found = self.problem.solve();
        if !found.iter().all(|entry| entry.is_finite()) {
            return Err(LeastSquaresError::NotFinite);
        }
        solution.copy_from_slice(found);
        Ok(())
    }

    fn check_rank(&self) -> Result<(), LeastSquaresError> {
        let pivots = self.problem.pivots();
        let largest = pivots.clone().fold(0.0, f64::max);
        for (coordinate, pivot) in pivots.enumerate() {
            if !pivot.is_finite() {
                return Err(LeastSquaresError::NotFinite);
            }
            if pivot <= RANK_TOLERANCE * largest {
                return Err(LeastSquaresError::RankDeficient {
                    coordinate,
                    pivot,
                    largest,
                });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Jᵀ (J w − y), which vanishes at the minimum.
    fn gradient(jacobians: &[[f64; 3]], targets: &[[f64; 3]], w: &[f64]) -> Vec<f64> {
        let mut sum = vec![0.0; w.len()];
        for (row, y) in jacobians.chunks(w.len()).zip(targets) {
            for a in 0..3 {
                let residual: f64 = row.iter().zip(w).map(|(column, w)| column[a] * w).sum::<f64>() - y[a];
                row.iter()
                    .zip(&mut sum)
                    .for_each(|(column, sum)| *sum += column[a] * residual);
            }
        }
        sum
    }

    proptest! {
        #[test]
        fn the_normal_equations_hold(values in prop::collection::vec(-1.0..1.0f64, 5 * 3 * 7 * 2)) {
            let vectors: Vec<[f64; 3]> = values.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect();
            let (jacobians, targets) = (&vectors[..35], &vectors[35..42]);
            let (mut solver, mut w) = (LeastSquares::default(), vec![0.0; 5]);
            solver.solve(jacobians, targets, &mut w).expect("of full rank");
            let scale = w.iter().fold(1.0, |m: f64, w| m.max(w.abs()));
            prop_assert!(gradient(jacobians, targets, &w).iter().all(|g| g.abs() < 1e-11 * scale));
        }
    }

    #[test]
    fn a_point_of_weight_three_is_three_points() {
        let (jacobians, targets) = (
            [[1.0, 0.2], [0.3, -1.0], [2.0, 0.5], [0.1, 0.4], [-1.0, 0.7], [0.6, 0.9]],
            [[1.0, -0.5], [0.2, 0.8], [-0.3, 0.4]],
        );
        let (mut found, mut expected) = ([0.0; 2], [0.0; 2]);
        let weighted = LeastSquares::weighted(&[1.0, 3.0, 0.0]).solve(&jacobians, &targets, &mut found);
        weighted.expect("of full rank");
        let [a, b, c, d, ..] = jacobians;
        let [first, second, _] = targets;
        LeastSquares::default()
            .solve(
                &[a, b, c, d, c, d, c, d],
                &[first, second, second, second],
                &mut expected,
            )
            .expect("of full rank");
        assert!(
            found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-14),
            "{found:?} {expected:?}"
        );
    }

    #[test]
    fn what_cannot_be_solved_is_said() {
        let (mut solver, mut w) = (LeastSquares::default(), [0.0; 2]);
        let error = solver
            .solve(&[[1.0], [2.0]], &[[1.0]], &mut w)
            .expect_err("one equation");
        assert_eq!(
            error,
            LeastSquaresError::TooFewEquations {
                equations: 1,
                unknowns: 2
            }
        );
        let jacobians = [[1.0, 2.0], [2.0, 4.0], [0.5, 1.0], [1.0, 2.0]];
        let error = solver
            .solve(&jacobians, &[[1.0, 1.0]; 2], &mut w)
            .expect_err("parallel");
        assert!(
            matches!(error, LeastSquaresError::RankDeficient { coordinate: 1, .. }),
            "{error}"
        );
        let error = solver.solve(&[[f64::NAN]], &[[1.0]], &mut w[..1]).expect_err("NaN");
        assert_eq!(error, LeastSquaresError::NotFinite);
        let error = LeastSquares::weighted(&[1.0; 3])
            .solve(&[[1.0]], &[[1.0]], &mut w[..1])
            .expect_err("one point");
        assert_eq!(error, LeastSquaresError::Weights { found: 1, expected: 3 });
    }
}
