//! A score by central differences, for a log density without a gradient.

use crate::error::positive;
use crate::target::POINTS_PER_CALL;
use crate::{Target, TargetError};

/// ε^⅓, the step of least error of a central difference in units of the scale.
const RELATIVE_STEP: f64 = 6.055_454_452_393_343e-6;

/// A target from a log density alone: s_i(x) = \[log p(x + h_i e_i) − log p(x − h_i e_i)\] / 2h_i.
///
/// The step is h_i = ε^⅓ (ℓ_i² (ℓ_i + |x_i|))^⅓ with the scale ℓ_i on which log p changes (1 unless given) and ε = 2⁻⁵²: for
/// |x_i| ≲ ℓ_i it balances the truncation h²/6 |∂³ log p| against the rounding ε |log p| / h, beyond it also the rounding
/// ε |x_i| of the coordinate itself. The error is about 10⁻¹⁰ (1 + |log p|) / ℓ_i; [`error`](Self::error) estimates it at a
/// point. An analytic or automatic derivative is better: a score here costs 2D log densities, and far from the mode,
/// where |log p| is large, it has fewer digits. A log density with jumps or kinks has no such score.
///
/// ```
/// use parvi_targets::{FiniteDifferenceScore, Target};
///
/// let target = FiniteDifferenceScore::new(|x: &[f64; 2]| -0.25 * (x[0].powi(4) + x[1].powi(4)));
/// let score = target.score(&[1.0, -2.0]);
/// assert!((score[0] + 1.0).abs() < 1e-9 && (score[1] - 8.0).abs() < 1e-9);
/// ```
///
/// Source: Press, Teukolsky, Vetterling & Flannery, *Numerical Recipes*, 3rd ed., §5.7.
#[derive(Clone, Copy, Debug)]
pub struct FiniteDifferenceScore<F, const D: usize> {
    log_density: F,
    scales: [f64; D],
    points_per_call: usize,
}

impl<F: Fn(&[f64; D]) -> f64 + Sync, const D: usize> FiniteDifferenceScore<F, D> {
    /// What a caller should tell a user whose score comes from here.
    pub const WARNING: &'static str = "the score is a central difference of the log density: every score costs two log densities \
         per coordinate, and is accurate to about 1e-10 (1 + |log p|) per unit of scale";

    /// Scales of 1 on every axis.
    pub fn new(log_density: F) -> Self {
        Self {
            log_density,
            scales: [1.0; D],
            points_per_call: POINTS_PER_CALL,
        }
    }

    /// The scales ℓ_i on which the log density changes: standard deviations, to an order of magnitude.
    ///
    /// # Errors
    /// [`TargetError::OutOfRange`] or [`TargetError::NotFinite`] for a scale that is not a positive number.
    pub fn with_scales(log_density: F, scales: [f64; D]) -> Result<Self, TargetError> {
        for (axis, &scale) in (1..).zip(&scales) {
            positive(&format!("the scale of x{axis}"), scale)?;
        }
        let points_per_call = POINTS_PER_CALL;
        Ok(Self {
            log_density,
            scales,
            points_per_call,
        })
    }

    /// Points of a call at most ([`Target::points_per_call`]; 256 unless said): 1 for a log density that takes a millisecond or longer.
    #[must_use]
    pub fn with_points_per_call(mut self, points: usize) -> Self {
        self.points_per_call = points;
        self
    }

    /// An estimate of the error of each component of the score at `x`, for 4D + 1 log densities: a third of the difference
    /// between the steps h and 2h, which is the truncation, plus the rounding ε |log p| / h.
    pub fn error(&self, x: &[f64; D]) -> [f64; D] {
        let rounding = f64::EPSILON * (self.log_density)(x).abs();
        std::array::from_fn(|axis| {
            let step = self.step(x, axis);
            let [near, far] = [step, 2.0 * step].map(|step| self.difference(x, axis, step));
            (near - far).abs() / 3.0 + rounding / step
        })
    }

    /// h on `axis`; at least so large that it moves x.
    fn step(&self, x: &[f64; D], axis: usize) -> f64 {
        let (scale, size) = (self.scales[axis], x[axis].abs());
        let step = RELATIVE_STEP * scale * (1.0 + size / scale).cbrt();
        step.max(4.0 * f64::EPSILON * size)
    }

    fn difference(&self, x: &[f64; D], axis: usize, step: f64) -> f64 {
        let (mut above, mut below) = (*x, *x);
        above[axis] += step;
        below[axis] -= step;
        // Over the distance between the numbers that the log density sees.
        ((self.log_density)(&above) - (self.log_density)(&below)) / (above[axis] - below[axis])
    }
}

impl<F: Fn(&[f64; D]) -> f64 + Sync, const D: usize> Target<D> for FiniteDifferenceScore<F, D> {
    fn log_density(&self, x: &[f64; D]) -> f64 {
        (self.log_density)(x)
    }

    fn score(&self, x: &[f64; D]) -> [f64; D] {
        std::array::from_fn(|axis| self.difference(x, axis, self.step(x, axis)))
    }

    fn points_per_call(&self) -> usize {
        self.points_per_call
    }

    /// In parallel over the points.
    fn scores(&self, xs: &[[f64; D]], out: &mut [[f64; D]]) {
        mpm_parallel::write(xs, out, &|x| self.score(x));
    }

    /// In parallel over the points.
    fn log_densities(&self, xs: &[[f64; D]], out: &mut [f64]) {
        mpm_parallel::write(xs, out, &|x| self.log_density(x));
    }
}
