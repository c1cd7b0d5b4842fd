//! A mixture of two normal distributions, fitted to data.

use super::model_posterior::{Description, FREE, LOG_ODDS, LOGARITHM, ModelPosterior};
use super::prior::{Prior, centred_normal};
use crate::catalogue::numbers::series;
use crate::special::log_one_plus_exp;
use crate::{Constraints, Target, TargetError};

/// The likelihood of x = (μ₁, μ₂, σ₁, σ₂, θ): y_i ~ θ N(μ₁, σ₁²) + (1 − θ) N(μ₂, σ₂²), independently for i = 1, …, n.
///
/// With z_ik = (y_i − μ_k)/σ_k, weights θ₁ = θ, θ₂ = 1 − θ and ℓ_ik = log θ_k − log σ_k − ½ z_ik²,
/// log L = Σ_i log Σ_k e^(ℓ_ik). With the responsibilities r_ik = e^(ℓ_ik)/Σ_j e^(ℓ_ij), score_{μ_k} = Σ r_ik z_ik/σ_k,
/// score_{σ_k} = Σ r_ik (z_ik² − 1)/σ_k, score_θ = Σ (r_i1/θ − r_i2/(1 − θ)).
#[derive(Clone, Debug)]
pub struct NormalMixture {
    responses: Vec<f64>,
}

impl NormalMixture {
    /// 1,000 synthetic responses; μ_k ~ N(0, 2²) with μ₁ < μ₂, σ_k ~ half-normal(2), θ ~ Beta(5, 5).
    ///
    /// Source: posteriordb, `low_dim_gauss_mix-low_dim_gauss_mix`.
    ///
    /// # Errors
    /// Those of [`Laplace::find`](crate::Laplace::find) and [`ImportanceSample::new`](crate::ImportanceSample::new).
    pub fn posterior() -> Result<ModelPosterior<Self, 5, 5>, TargetError> {
        let file = include_str!("../../../data/posteriordb/low_dim_gauss_mix.csv");
        let responses = series("low_dim_gauss_mix.csv", file)?;
        let normal = centred_normal(2.0);
        let constraints = Constraints::builder().ordered(2).positive(2).bounded(1, 0.0, 1.0);
        let description = Description {
            name: "gaussian-mixture-posterior",
            priors: [normal, normal, normal, normal, Prior::SymmetricBeta { shape: 5.0 }],
            constraints: constraints.build()?,
            reach: [FREE, LOGARITHM, LOGARITHM, LOGARITHM, LOG_ODDS],
            start: [-2.73, 2.87, 1.03, 1.02, 0.62],
        };
        ModelPosterior::new(Self { responses }, description)
    }
}

/// z_1, z_2 and ℓ_1, ℓ_2.
fn parts(&[mu1, mu2, sigma1, sigma2, theta]: &[f64; 5]) -> impl Fn(f64) -> [[f64; 2]; 2] {
    let constants = [theta.ln() - sigma1.ln(), (-theta).ln_1p() - sigma2.ln()];
    move |y| {
        let z = [(y - mu1) / sigma1, (y - mu2) / sigma2];
        [z, std::array::from_fn(|k| constants[k] - 0.5 * z[k] * z[k])]
    }
}

impl Target<5> for NormalMixture {
    fn log_density(&self, x: &[f64; 5]) -> f64 {
        let parts = parts(x);
        let of_one = |&y| {
            let [_, [first, second]] = parts(y);
            first + log_one_plus_exp(second - first)
        };
        self.responses.iter().map(of_one).sum()
    }

    fn score(&self, x: &[f64; 5]) -> [f64; 5] {
        let parts = parts(x);
        let mut score = [0.0; 5];
        for &y in &self.responses {
            let [z, [first, second]] = parts(y);
            let responsibilities = [second - first, first - second].map(|log_odds| (1.0 + log_odds.exp()).recip());
            for k in 0..2 {
                let pull = responsibilities[k] / x[2 + k];
                score[k] += pull * z[k];
                score[2 + k] += pull * (z[k] * z[k] - 1.0);
            }
            score[4] += responsibilities[0] / x[4] - responsibilities[1] / (1.0 - x[4]);
        }
        score
    }
}
