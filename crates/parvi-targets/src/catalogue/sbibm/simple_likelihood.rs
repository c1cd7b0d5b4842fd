//! A simple likelihood with a complex posterior.

use mpm_tensor::{Matrix, vector};
use rand::{Rng, RngExt};

use super::box_posterior::BoxPosterior;
use super::inverse_wishart::InverseWishart;
use super::simulator::{Simulator, numbered};
use crate::catalogue::numbers::rows;
use crate::gaussian::standard_normal;
use crate::special::HALF_LOG_TWO_PI;
use crate::{Target, TargetError};

/// Points of an observation.
const COUNT: usize = 4;

/// |θ₃| and |θ₄| are followed down to this, where log p is below −10⁵⁰.
const SMALLEST: f64 = 1e-16;

/// Degrees of freedom of the law of S that posteriors are drawn from.
const DEGREES_OF_FREEDOM: f64 = 2.5;

/// x_i ~ N(m, S) for i = 1, …, 4, m = (θ₁, θ₂), S_11 = s_1², S_22 = s_2², S_12 = ρ s_1 s_2, s_1 = θ₃², s_2 = θ₄², ρ = tanh θ₅, θ in (−3, 3)⁵:
/// SLCP, after G. Papamakarios, D. C. Sterratt, I. Murray, *Sequential neural likelihood*, AISTATS 2019.
///
/// With z_i = (x_i − m)/s per axis, κ = 1 − ρ² and q_i = (z_i1² − 2ρ z_i1 z_i2 + z_i2²)/κ: log p = −Σ_i [½ q_i + log(2π s_1 s_2) + ½ log κ],
/// score of θ₁: Σ (z_i1 − ρ z_i2)/(κ s_1); of θ₃: (2/θ₃) Σ [(z_i1² − ρ z_i1 z_i2)/κ − 1]; of θ₂ and θ₄ the same with axes exchanged; of θ₅:
/// Σ (z_i1 z_i2 − ρ q_i + ρ). Four equal parts, by the signs of θ₃ and θ₄.
///
/// Draws are exact. With A = Σ (x_i − x̄)(x_i − x̄)ᵀ the posterior of (m, S) without the box is N(m; x̄, S/4) times |S|^(−11/4) κ^(1/4) exp(−½ tr S⁻¹A): an
/// inverse Wishart law of 5/2 degrees of freedom, of which κ^(1/4) ≤ 1 is accepted, and what lies in the box: 0.3 to 53 %. The evidence is that law's
/// constant times the accepted share, from 16 × 2¹⁹ quasi-random points of S and one coordinate of m, the other in closed form.
#[derive(Clone, Copy, Debug)]
pub struct SimpleLikelihood {
    name: &'static str,
    points: [[f64; 2]; COUNT],
    log_evidence: f64,
    /// x̄.
    mean: [f64; 2],
    covariances: InverseWishart,
}

/// The posteriors of the benchmark's first five observations.
const NAMES: [&str; 5] = [
    "sbibm-slcp-1",
    "sbibm-slcp-2",
    "sbibm-slcp-3",
    "sbibm-slcp-4",
    "sbibm-slcp-5",
];

/// Per observation its points, one after the other, and the log evidence, whose standard error is below 2·10⁻⁴.
const OBSERVATIONS: &str = include_str!("../../../data/sbibm/slcp_observations.csv");

impl SimpleLikelihood {
    /// The posterior of one of the benchmark's first five observations.
    ///
    /// # Errors
    /// [`TargetError::OutOfRange`] for another number.
    pub fn posterior(number: usize) -> Result<BoxPosterior<Self, 5>, TargetError> {
        let name = numbered(&NAMES, number)?;
        let [numbers @ .., log_evidence] = numbered(&rows::<9>("slcp_observations.csv", OBSERVATIONS)?, number)?;
        let points: [[f64; 2]; COUNT] = std::array::from_fn(|i| [numbers[2 * i], numbers[2 * i + 1]]);
        let sum = points.iter().fold([0.0; 2], |sum, x| vector::add(&sum, x));
        let mean = sum.map(|sum| sum / COUNT as f64);
        let scatter = points.iter().fold(Matrix([[0.0; 2]; 2]), |sum, x| {
            let residual = vector::subtract(x, &mean);
            sum + Matrix::outer(&residual, &residual)
        });
        BoxPosterior::new(Self {
            name,
            points,
            log_evidence,
            mean,
            covariances: InverseWishart::new(&scatter, DEGREES_OF_FREEDOM)?,
        })
    }
}

/// s_1, s_2, ρ and κ.
fn scales(theta: &[f64; 5]) -> ([f64; 2], f64, f64) {
    let scale = |theta: f64| theta.abs().max(SMALLEST).powi(2);
    let rho = theta[4].tanh();
    ([scale(theta[2]), scale(theta[3])], rho, theta[4].cosh().powi(-2))
}

impl Target<5> for SimpleLikelihood {
    fn log_density(&self, theta: &[f64; 5]) -> f64 {
        let (scales, rho, kappa) = scales(theta);
        let constant = 2.0 * HALF_LOG_TWO_PI + scales[0].ln() + scales[1].ln() + 0.5 * kappa.ln();
        let of_one = |x: &[f64; 2]| {
            let [a, b] = [0, 1].map(|k| (x[k] - theta[k]) / scales[k]);
            -0.5 * (a * a - 2.0 * rho * a * b + b * b) / kappa - constant
        };
        self.points.iter().map(of_one).sum()
    }

    fn score(&self, theta: &[f64; 5]) -> [f64; 5] {
        let (scales, rho, kappa) = scales(theta);
        let mut score = [0.0; 5];
        for x in &self.points {
            let [a, b] = [0, 1].map(|k| (x[k] - theta[k]) / scales[k]);
            let pulls = [(a - rho * b) / kappa, (b - rho * a) / kappa];
            let square = a * pulls[0] + b * pulls[1];
            for (k, z) in [a, b].into_iter().enumerate() {
                score[k] += pulls[k] / scales[k];
                if theta[2 + k].abs() >= SMALLEST {
                    score[2 + k] += 2.0 / theta[2 + k] * (z * pulls[k] - 1.0);
                }
            }
            score[4] += a * b - rho * square + rho;
        }
        score
    }
}

impl Simulator<5> for SimpleLikelihood {
    const HALF_WIDTH: f64 = 3.0;

    fn name(&self) -> &'static str {
        self.name
    }

    fn posterior_draw(&self, rng: &mut dyn Rng) -> [f64; 5] {
        loop {
            let root = self.covariances.root(rng);
            let [[a, _], [b, c]] = root.0;
            let cosine = a / a.hypot(b);
            let of_scales = [a.hypot(b).sqrt(), c.sqrt(), (b / a).asinh()];
            let is_inside = |theta: &f64| theta.abs() < Self::HALF_WIDTH;
            if !of_scales.iter().all(is_inside) || rng.random::<f64>() > cosine.sqrt() {
                continue;
            }
            let mut mean = self.mean;
            vector::accumulate(&mut mean, 0.5, &root.apply_transposed(&standard_normal(rng)));
            if mean.iter().all(is_inside) {
                let [third, fourth, fifth] = of_scales;
                let [third, fourth] = [third, fourth].map(|size| if rng.random() { size } else { -size });
                return [mean[0], mean[1], third, fourth, fifth];
            }
        }
    }

    fn log_evidence(&self) -> f64 {
        self.log_evidence
    }

    fn centres(&self) -> Vec<[f64; 5]> {
        let signs = [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]];
        signs.map(|[third, fourth]| [0.0, 0.0, third, fourth, 0.0]).to_vec()
    }
}
