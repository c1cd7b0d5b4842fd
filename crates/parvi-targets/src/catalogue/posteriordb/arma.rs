//! An autoregressive moving average.

use mpm_tensor::vector;

use super::model_posterior::{Description, LOGARITHM, ModelPosterior};
use super::prior::{Prior, centred_normal};
use crate::catalogue::numbers::series;
use crate::{Constraints, Target, TargetError};

/// How far from 0 the coefficients of the mean are followed.
const COEFFICIENT: f64 = 1e10;

/// How far from 0 the moving average's coefficient is followed, of which an error has the power of its index.
const MOVING_AVERAGE: f64 = 3.0;

/// The likelihood of x = (μ, φ, θ, σ) for a series y_1, …, y_n: ARMA(1, 1) with errors e_t ~ N(0, σ²),
///
/// e_1 = y_1 − μ − φ μ, e_t = y_t − μ − φ y_{t−1} − θ e_{t−1}.
///
/// With S = Σ e_t², log L = −½ S/σ² − n log σ, score_k = −Σ e_t ∂_k e_t/σ² for μ, φ, θ, score_σ = (S/σ² − n)/σ, where
/// ∂_μ e_1 = −1 − φ, ∂_φ e_1 = −μ, ∂_θ e_1 = 0, ∂e_t = −(1, y_{t−1}, e_{t−1}) − θ ∂e_{t−1}.
#[derive(Clone, Debug)]
pub struct Arma {
    series: Vec<f64>,
}

impl Arma {
    /// A synthetic series of 200; μ ~ N(0, 10²), φ, θ ~ N(0, 2²), σ ~ half-Cauchy(2.5).
    ///
    /// Source: posteriordb, `arma-arma11`.
    ///
    /// # Errors
    /// Those of [`Laplace::find`](crate::Laplace::find) and [`ImportanceSample::new`](crate::ImportanceSample::new).
    pub fn posterior() -> Result<ModelPosterior<Self, 4, 4>, TargetError> {
        let series = series("arma.csv", include_str!("../../../data/posteriordb/arma.csv"))?;
        let description = Description {
            name: "arma",
            priors: [
                centred_normal(10.0),
                centred_normal(2.0),
                centred_normal(2.0),
                Prior::HalfCauchy { scale: 2.5 },
            ],
            constraints: Constraints::builder().free(3).positive(1).build()?,
            reach: [COEFFICIENT, COEFFICIENT, MOVING_AVERAGE, LOGARITHM],
            start: [0.0, 0.95, 0.0, 0.17],
        };
        ModelPosterior::new(Self { series }, description)
    }

    /// Every e_t/σ with ∂e_t.
    fn each_error(&self, &[mu, phi, theta, sigma]: &[f64; 4], mut visit: impl FnMut(f64, &[f64; 3])) {
        // Before the series stands μ, and no error.
        let (mut before, mut error) = (mu, 0.0);
        let mut slopes = [0.0; 3];
        for (t, &y) in self.series.iter().enumerate() {
            let of_start = if t == 0 { phi } else { 0.0 };
            let direct = [1.0 + of_start, before, error];
            slopes = std::array::from_fn(|k| -direct[k] - theta * slopes[k]);
            error = y - mu - phi * before - theta * error;
            before = y;
            visit(error / sigma, &slopes);
        }
    }
}

impl Target<4> for Arma {
    fn log_density(&self, x: &[f64; 4]) -> f64 {
        let mut squares = 0.0;
        self.each_error(x, |error, _| squares += error * error);
        -0.5 * squares - self.series.len() as f64 * x[3].ln()
    }

    fn score(&self, x: &[f64; 4]) -> [f64; 4] {
        let (mut squares, mut sum) = (0.0, [0.0; 3]);
        self.each_error(x, |error, slopes| {
            squares += error * error;
            vector::accumulate(&mut sum, -error / x[3], slopes);
        });
        let [mu, phi, theta] = sum;
        [mu, phi, theta, (squares - self.series.len() as f64) / x[3]]
    }
}
