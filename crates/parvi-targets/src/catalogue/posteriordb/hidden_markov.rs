//! A hidden Markov model of two states.

use mpm_tensor::vector;

use super::model_posterior::{Description, LOG_ODDS, LOGARITHM, ModelPosterior};
use super::prior::Prior;
use crate::catalogue::numbers::series;
use crate::{Constraints, Target, TargetError};

/// The likelihood of x = (θ₁₁, θ₂₁, μ₁, μ₂) for a series y_1, …, y_n: a Markov chain of two states whose transitions have the
/// probabilities θ_ij, θ_i2 = 1 − θ_i1, emits y_t ~ N(μ_k, 1) in state k.
///
/// The forward algorithm in logarithms, with both states equally likely at the start and both counted:
/// g_1j = b_1j, g_tj = log Σ_i e^(g_{t−1,i} + log θ_ij) + b_tj, log L = log Σ_j e^(g_nj), b_tj = −½ (y_t − μ_j)². The score goes
/// along: the slope of log Σ e^(a_i) is the mean of the slopes of a_i with weights ∝ e^(a_i).
#[derive(Clone, Debug)]
pub struct HiddenMarkov {
    series: Vec<f64>,
}

/// A logarithm and its slopes by (θ₁₁, θ₂₁, μ₁, μ₂).
type Sloped = (f64, [f64; 4]);

impl HiddenMarkov {
    /// A synthetic series of 100; flat priors of θ₁₁ and θ₂₁, μ₁ ~ N(3, 1), μ₂ ~ N(10, 1), 0 < μ₁ < μ₂.
    ///
    /// Source: posteriordb, `hmm_example-hmm_example`, whose θ₁₂ and θ₂₂ follow from the others.
    ///
    /// # Errors
    /// Those of [`Laplace::find`](crate::Laplace::find) and [`ImportanceSample::new`](crate::ImportanceSample::new).
    pub fn posterior() -> Result<ModelPosterior<Self, 4, 4>, TargetError> {
        let series = series(
            "hmm_example.csv",
            include_str!("../../../data/posteriordb/hmm_example.csv"),
        )?;
        let [low, high] = [3.0, 10.0].map(|mean| Prior::Normal {
            mean,
            standard_deviation: 1.0,
        });
        let constraints = Constraints::builder().bounded(2, 0.0, 1.0).positive_ordered(2);
        let description = Description {
            name: "hidden-markov",
            priors: [Prior::Flat, Prior::Flat, low, high],
            constraints: constraints.build()?,
            reach: [LOG_ODDS, LOG_ODDS, LOGARITHM, LOGARITHM],
            start: [0.67, 0.07, 3.0, 8.8],
        };
        ModelPosterior::new(Self { series }, description)
    }

    /// log L with its slopes.
    fn forward(&self, x: &[f64; 4]) -> Sloped {
        let mut states: Option<[Sloped; 2]> = None;
        for y in &self.series {
            let next = [0, 1].map(|to| {
                let residual = y - x[2 + to];
                let mut emission = (-0.5 * residual * residual, [0.0; 4]);
                emission.1[2 + to] = residual;
                match &states {
                    None => emission,
                    Some(states) => {
                        let [first, second] = [0, 1].map(|from| sum(&states[from], &log_transition(x, from, to)));
                        sum(&log_sum_exp(&first, &second), &emission)
                    }
                }
            });
            states = Some(next);
        }
        states.map_or((0.0, [0.0; 4]), |[first, second]| log_sum_exp(&first, &second))
    }
}

/// log θ_ij.
fn log_transition(x: &[f64; 4], from: usize, to: usize) -> Sloped {
    let probability = if to == 0 { x[from] } else { 1.0 - x[from] };
    let mut slopes = [0.0; 4];
    slopes[from] = if to == 0 { 1.0 } else { -1.0 } / probability;
    (probability.ln(), slopes)
}

fn sum(a: &Sloped, b: &Sloped) -> Sloped {
    (a.0 + b.0, vector::add(&a.1, &b.1))
}

/// log(eᵃ + eᵇ).
fn log_sum_exp(a: &Sloped, b: &Sloped) -> Sloped {
    let ratio = (-(a.0 - b.0).abs()).exp();
    let (larger, smaller) = if a.0 >= b.0 { (a, b) } else { (b, a) };
    let weight = ratio / (1.0 + ratio);
    let slopes = std::array::from_fn(|k| (1.0 - weight) * larger.1[k] + weight * smaller.1[k]);
    (larger.0 + ratio.ln_1p(), slopes)
}

impl Target<4> for HiddenMarkov {
    fn log_density(&self, x: &[f64; 4]) -> f64 {
        self.forward(x).0
    }

    fn score(&self, x: &[f64; 4]) -> [f64; 4] {
        self.forward(x).1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All 2ⁿ paths of the chain, one by one.
    #[test]
    fn the_forward_algorithm_sums_over_all_paths() {
        let series = vec![2.5, 9.0, 8.5, 3.5, 4.0, 7.0];
        let x = [0.7_f64, 0.1, 3.0, 9.0];
        let mut sum = 0.0;
        for path in 0..1_usize << series.len() {
            let state = |t: usize| path >> t & 1;
            let mut log_density = 0.0;
            for (t, y) in series.iter().enumerate() {
                log_density -= 0.5 * (y - x[2 + state(t)]).powi(2);
                if t > 0 {
                    let to_first = x[state(t - 1)];
                    log_density += if state(t) == 0 { to_first } else { 1.0 - to_first }.ln();
                }
            }
            sum += log_density.exp();
        }
        let found = HiddenMarkov { series }.log_density(&x);
        assert!((found - sum.ln()).abs() < 1e-12, "{found} for {}", sum.ln());
    }
}
