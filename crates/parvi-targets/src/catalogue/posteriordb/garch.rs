//! A series whose variance depends on the past.

use super::model_posterior::{Description, FREE, LOGARITHM, ModelPosterior};
use super::prior::Prior;
use crate::catalogue::numbers::series;
use crate::{Constraints, Target, TargetError};

/// The standard deviation that the series begins with.
const FIRST_STANDARD_DEVIATION: f64 = 0.5;

/// The likelihood of x = (μ, α₀, α₁, β₁, 1 − α₁ − β₁) for a series y_1, …, y_n: GARCH(1, 1), y_t ~ N(μ, v_t) with v_1 given and
///
/// v_t = α₀ + α₁ r_{t−1}² + β₁ v_{t−1}, r_t = y_t − μ.
///
/// log L = −½ Σ (log v_t + r_t²/v_t), score_k = ½ Σ (r_t²/v_t − 1) ∂_k v_t/v_t, and Σ r_t/v_t on top for μ, where
/// ∂v_1 = 0, ∂v_t = (−2 α₁ r_{t−1}, 1, r_{t−1}², v_{t−1}) + β₁ ∂v_{t−1}. The last coordinate, which follows from others, does not
/// appear: α₁, β₁ and what they leave of 1 are a simplex.
#[derive(Clone, Debug)]
pub struct Garch {
    series: Vec<f64>,
}

impl Garch {
    /// A synthetic series of 200, v_1 = 0.5²; flat priors where α₀ > 0, 0 < α₁ < 1, 0 < β₁ < 1 − α₁.
    ///
    /// Source: posteriordb, `garch-garch11`.
    ///
    /// # Errors
    /// Those of [`Laplace::find`](crate::Laplace::find) and [`ImportanceSample::new`](crate::ImportanceSample::new).
    pub fn posterior() -> Result<ModelPosterior<Self, 5, 4>, TargetError> {
        let series = series("garch.csv", include_str!("../../../data/posteriordb/garch.csv"))?;
        let description = Description {
            name: "garch",
            priors: [Prior::Flat; 5],
            constraints: Constraints::builder().free(1).positive(1).simplex(3).build()?,
            reach: [FREE, LOGARITHM, LOGARITHM, LOGARITHM],
            start: [5.05, 1.47, 0.57, 0.29, 0.14],
        };
        ModelPosterior::new(Self { series }, description)
    }

    /// Every r_t and v_t with ∂v_t.
    fn each_variance(&self, &[mu, alpha0, alpha1, beta1, _]: &[f64; 5], mut visit: impl FnMut(f64, f64, &[f64; 4])) {
        let mut variance = FIRST_STANDARD_DEVIATION * FIRST_STANDARD_DEVIATION;
        let mut slopes = [0.0; 4];
        for y in &self.series {
            let residual = y - mu;
            visit(residual, variance, &slopes);
            let direct = [-2.0 * alpha1 * residual, 1.0, residual * residual, variance];
            slopes = std::array::from_fn(|k| direct[k] + beta1 * slopes[k]);
            variance = alpha0 + alpha1 * residual * residual + beta1 * variance;
        }
    }
}

impl Target<5> for Garch {
    fn log_density(&self, x: &[f64; 5]) -> f64 {
        let mut sum = 0.0;
        self.each_variance(x, |residual, variance, _| {
            sum -= 0.5 * (variance.ln() + residual * residual / variance);
        });
        sum
    }

    fn score(&self, x: &[f64; 5]) -> [f64; 5] {
        let mut score = [0.0; 5];
        self.each_variance(x, |residual, variance, slopes| {
            let pull = 0.5 * (residual * residual / variance - 1.0) / variance;
            for (score, slope) in score.iter_mut().zip(slopes) {
                *score += pull * slope;
            }
            score[0] += residual / variance;
        });
        score
    }
}
