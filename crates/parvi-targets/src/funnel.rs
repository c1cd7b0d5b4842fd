//! Neal's funnel: a variance that is itself a variable.

use rand::Rng;

use crate::error::{at_least_two, positive, within};
use crate::gaussian::{normal_quantiles, standard_normal};
use crate::special::HALF_LOG_TWO_PI;
use crate::target::its_own_source;
use crate::{CatalogueTarget, ExactDraws, Frame, Moments, Target, TargetError, UnitCubeTransport};

/// e^−x₁ is clamped at e^500, so that the score far down the throat of the funnel stays a number.
const LARGEST_EXPONENT: f64 = 500.0;

/// x₁ ~ N(0, w²), x_j ~ N(0, exp(x₁)) for j ≥ 2, with w = 1.5 unless set.
///
/// log p = −x₁²/2w² − ½(D−1) x₁ − ½ e^(−x₁) Σ x_j² − log w − D/2 · log 2π (normalised);
/// score_1 = −x₁/w² − ½(D−1) + ½ e^(−x₁) Σ x_j², score_j = −e^(−x₁) x_j. Mean 0, covariance diag(w², e^(w²/2), …).
///
/// Source of the shape: R. M. Neal, Slice sampling, *Annals of Statistics* 31 (2003) 705–767, §8.
#[derive(Clone, Debug, PartialEq)]
pub struct Funnel<const D: usize> {
    width: f64,
}

impl<const D: usize> Funnel<D> {
    /// A funnel whose first coordinate has standard deviation w = `width`.
    ///
    /// # Errors
    /// [`TargetError::DimensionNotAllowed`] for D < 2; [`TargetError::NotFinite`] or [`TargetError::OutOfRange`] unless
    /// 0 < w ≤ 20 (beyond, the variance of the other coordinates approaches the largest number).
    pub fn new(width: f64) -> Result<Self, TargetError> {
        at_least_two("funnel", D)?;
        positive("width", width)?;
        within("width", width, width <= 20.0, "a number above 0 and up to 20")?;
        Ok(Self { width })
    }

    /// (e^−x₁, Σ_{j≥2} x_j²).
    fn precision_and_square(x: &[f64; D]) -> (f64, f64) {
        ((-x[0]).min(LARGEST_EXPONENT).exp(), x[1..].iter().map(|x| x * x).sum())
    }

    /// Standard normal z ↦ (w z₁, e^(w z₁/2) z_j).
    fn open(&self, z: [f64; D]) -> [f64; D] {
        let first = self.width * z[0];
        let spread = (0.5 * first).exp();
        std::array::from_fn(|axis| if axis == 0 { first } else { spread * z[axis] })
    }
}

impl<const D: usize> Target<D> for Funnel<D> {
    fn log_density(&self, x: &[f64; D]) -> f64 {
        let (precision, square) = Self::precision_and_square(x);
        let z = x[0] / self.width;
        -0.5 * (z * z + (D as f64 - 1.0) * x[0] + precision * square) - self.width.ln() - D as f64 * HALF_LOG_TWO_PI
    }

    fn score(&self, x: &[f64; D]) -> [f64; D] {
        let (precision, square) = Self::precision_and_square(x);
        let mut score = x.map(|x| -precision * x);
        score[0] = -x[0] / (self.width * self.width) + 0.5 * (precision * square - (D as f64 - 1.0));
        score
    }
}

impl<const D: usize> ExactDraws<D> for Funnel<D> {
    fn draw(&self, rng: &mut dyn Rng) -> [f64; D] {
        self.open(standard_normal(rng))
    }
}

impl<const D: usize> UnitCubeTransport<D> for Funnel<D> {
    fn transport(&self, u: &[f64]) -> [f64; D] {
        self.open(normal_quantiles(u))
    }
}

impl<const D: usize> CatalogueTarget<D> for Funnel<D> {
    fn name(&self) -> &str {
        "funnel"
    }

    /// Scales w and, for the others, their standard deviation 1 at x₁ = 0; the heavy tails' own would be far too wide.
    fn frame(&self) -> Frame<D> {
        Frame::diagonal(
            [0.0; D],
            std::array::from_fn(|axis| if axis == 0 { self.width } else { 1.0 }),
        )
    }

    /// |x₁| ≤ 4w; |x_j| ≤ three standard deviations at x₁ = 2.5 w.
    fn domain(&self) -> [[f64; 2]; D] {
        std::array::from_fn(|axis| {
            let half = if axis == 0 {
                4.0 * self.width
            } else {
                3.0 * (1.25 * self.width).exp()
            };
            [-half, half]
        })
    }

    its_own_source!(D);

    fn moments(&self) -> Option<Moments<D>> {
        let square = self.width * self.width;
        let variance = |axis| if axis == 0 { square } else { (0.5 * square).exp() };
        Some(Moments::centred(std::array::from_fn(variance)))
    }

    /// The density is normalised.
    fn log_evidence(&self) -> Option<f64> {
        Some(0.0)
    }
}
