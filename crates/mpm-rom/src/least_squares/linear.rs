//! min_w Σ_p ω_p |J_p w − y_p|².

/// Pivots below this multiple of the largest one count as zero.
const RANK_TOLERANCE: f64 = 1e-12;

/// Why a least squares problem has no unique finite solution.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LeastSquaresError {
    /// More unknowns than equations.
    #[error("the number of equations is {equations}, that of unknowns {unknowns}")]
    TooFewEquations {
        /// D times the number of points.
        equations: usize,
        /// r.
        unknowns: usize,
    },
    /// The solver has weights for another number of points.
    #[error("the number of points is {found}, that of weights {expected}")]
    Weights {
        /// The number of points.
        found: usize,
        /// That of weights.
        expected: usize,
    },
    /// The points do not see a coordinate: its column depends on those before it.
    #[error("coordinate {} cannot be told from those before it: pivot {pivot:e} of {largest:e}", .coordinate + 1)]
    RankDeficient {
        /// The coordinate, counted from 0; in messages from 1.
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

    /// Other weights, as in [`weighted`](Self::weighted); the storage stays.
    pub(crate) fn weigh(&mut self, weights: &[f64]) {
        self.roots.clear();
        self.roots.extend(weights.iter().map(|weight| weight.sqrt()));
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
