//! The list of blocks that the constrained coordinates consist of.

use std::sync::Arc;

use super::correlation::Correlation;
use super::correlation_cholesky::CorrelationCholesky;
use super::free::Free;
use super::half_line::{HalfLine, Side};
use super::interval::Interval;
use super::numbers::inner;
use super::ordered::Ordered;
use super::simplex::Simplex;
use super::transform::Transform;
use crate::error::{finite, within};
use crate::{Constraints, TargetError};

/// Names the blocks of constrained coordinates from the first to the last; [`build`](Self::build) checks that they fill N
/// constrained and D unconstrained coordinates.
#[derive(Clone, Debug)]
#[must_use = "call `build` for the constraints"]
pub struct ConstraintsBuilder<const N: usize, const D: usize> {
    transforms: Vec<Arc<dyn Transform>>,
    /// The first thing that was wrong.
    error: Option<TargetError>,
}

impl<const N: usize, const D: usize> ConstraintsBuilder<N, D> {
    /// No blocks yet.
    pub(crate) fn new() -> Self {
        Self {
            transforms: Vec::new(),
            error: None,
        }
    }

    /// `count` coordinates without a constraint: x = y.
    pub fn free(self, count: usize) -> Self {
        self.sized("free", count, 1, Free { count })
    }

    /// `count` coordinates above 0: x = e^y.
    pub fn positive(self, count: usize) -> Self {
        self.half_line("positive", count, 0.0, Side::Above)
    }

    /// `count` coordinates above `lower`: x = lower + e^y.
    pub fn lower_bounded(self, count: usize, lower: f64) -> Self {
        self.half_line("lower bounded", count, lower, Side::Above)
    }

    /// `count` coordinates below `upper`: x = upper − e^y.
    pub fn upper_bounded(self, count: usize, upper: f64) -> Self {
        self.half_line("upper bounded", count, upper, Side::Below)
    }

    /// `count` coordinates between two bounds: x = lower + (upper − lower) / (1 + e^−y).
    pub fn bounded(mut self, count: usize, lower: f64, upper: f64) -> Self {
        self.record(check_interval(lower, upper));
        self.sized("bounded", count, 1, Interval { count, lower, upper })
    }

    /// `count` increasing coordinates: x₁ = y₁, x_k = x_{k−1} + e^{y_k}.
    pub fn ordered(self, count: usize) -> Self {
        let positive = false;
        self.sized("ordered", count, 1, Ordered { count, positive })
    }

    /// `count` increasing coordinates above 0: x₁ = e^{y₁}, x_k = x_{k−1} + e^{y_k}.
    pub fn positive_ordered(self, count: usize) -> Self {
        let positive = true;
        self.sized("positive ordered", count, 1, Ordered { count, positive })
    }

    /// `count` ≥ 2 positive coordinates of sum 1, from `count` − 1 unconstrained ones by a softmax of isometric log ratios.
    ///
    /// The density is one in all but the last of them; the score is asked for in all, as if they were independent.
    pub fn simplex(self, count: usize) -> Self {
        self.sized("simplex", count, 2, Simplex { count })
    }

    /// The K(K−1)/2 entries below the diagonal of a correlation matrix of K = `size` ≥ 2 rows, row by row
    /// (R₂₁, R₃₁, R₃₂, …), from as many unconstrained ones by canonical partial correlations z = tanh y.
    ///
    /// A score has the derivative for each entry R_ij, which also stands at R_ji. Where correlations round to ±1
    /// (|y| ≳ 15) the matrix is singular to working precision; the
    /// [Cholesky factor](Self::correlation_cholesky) has no such end, and most densities are simpler in it.
    pub fn correlation(self, size: usize) -> Self {
        self.sized("correlation", size, 2, Correlation { size })
    }

    /// The K(K+1)/2 entries of the lower triangle of the Cholesky factor L of a correlation matrix of K = `size` ≥ 2 rows,
    /// row by row with the diagonal (L₁₁ = 1, L₂₁, L₂₂, …), from K(K−1)/2 unconstrained ones.
    ///
    /// The density is one in the entries below the diagonal; the score is asked for in all, as if they were independent.
    pub fn correlation_cholesky(self, size: usize) -> Self {
        self.sized("correlation Cholesky factor", size, 2, CorrelationCholesky { size })
    }

    /// A transform of one's own.
    pub fn transform(mut self, transform: impl Transform + 'static) -> Self {
        self.transforms.push(Arc::new(transform));
        self
    }

    /// The constraints.
    ///
    /// # Errors
    /// The first of: [`TargetError::OutOfRange`] for a block without coordinates, a simplex or correlation matrix of one, or
    /// bounds that hold no number between them; [`TargetError::NotFinite`] for a bound or a width; [`TargetError::Length`]
    /// where the blocks have not N constrained and D unconstrained coordinates.
    pub fn build(self) -> Result<Constraints<N, D>, TargetError> {
        match self.error {
            Some(error) => Err(error),
            None => Constraints::new(self.transforms),
        }
    }

    fn half_line(mut self, name: &'static str, count: usize, bound: f64, side: Side) -> Self {
        self.record(finite(&format!("the bound of a {name} block"), bound).map(|_| ()));
        let transform = HalfLine {
            name,
            count,
            bound,
            side,
        };
        self.sized(name, count, 1, transform)
    }

    /// Adds a block whose size is between `minimum` and what fits: no block of K has fewer than K − 1 coordinates.
    fn sized(mut self, name: &str, size: usize, minimum: usize, transform: impl Transform + 'static) -> Self {
        if size < minimum {
            let allowed = if minimum == 1 { "at least 1" } else { "at least 2" };
            let refused = within(&format!("the size of a {name} block"), size as f64, false, allowed);
            self.record(refused.map(drop));
        } else if size > N.saturating_add(1) {
            self.record(Err(TargetError::Length {
                field: format!("a {name} block"),
                expected: N,
                found: size,
            }));
        } else {
            self = self.transform(transform);
        }
        self
    }

    fn record(&mut self, result: Result<(), TargetError>) {
        if let (None, Err(error)) = (&self.error, result) {
            self.error = Some(error);
        }
    }
}

fn check_interval(lower: f64, upper: f64) -> Result<(), TargetError> {
    finite("the lower bound of a bounded block", lower)?;
    finite("the upper bound of a bounded block", upper)?;
    let [low, high] = inner(lower, upper);
    let allowed = "a number above the lower bound, with others between them";
    within("the upper bound of a bounded block", upper, low < high, allowed)?;
    finite("the distance between the bounds of a bounded block", upper - lower)?;
    Ok(())
}
