//! A narrow peak on a broad one.

use rand::{Rng, RngExt};
use statrs::function::erf::erf;

use super::box_posterior::BoxPosterior;
use super::simulator::{Simulator, numbered};
use crate::gaussian::standard_normal;
use crate::special::HALF_LOG_TWO_PI;
use crate::{Target, TargetError};

/// σ_k.
const SPREADS: [f64; 2] = [1.0, 0.1];

const OBSERVATIONS: [(&str, [f64; 2]); 3] = [
    ("sbibm-gaussian-mixture-1", [-9.472_713, -1.495_050_9]),
    ("sbibm-gaussian-mixture-2", [-2.940_192, -8.682_056]),
    ("sbibm-gaussian-mixture-3", [7.168_336_4, -3.047_058_3]),
];

/// x ~ ½ N(θ, I) + ½ N(θ, 0.1² I), θ in (−10, 10)².
///
/// With z_k = (x − θ)/σ_k and w_k ∝ σ_k⁻² e^(−½‖z_k‖²): p(x | θ) = Σ_k e^(−½‖z_k‖²)/(4π σ_k²), score = Σ_k w_k z_k/σ_k. The evidence is
/// Σ_k ½ Π_i [Φ((b − x_i)/σ_k) − Φ((−b − x_i)/σ_k)]/(2b)².
#[derive(Clone, Copy, Debug)]
pub struct NestedNormals {
    name: &'static str,
    observed: [f64; 2],
}

impl NestedNormals {
    /// The posterior of the benchmark's first, second or third observation.
    ///
    /// # Errors
    /// [`TargetError::OutOfRange`] for another number.
    pub fn posterior(number: usize) -> Result<BoxPosterior<Self, 2>, TargetError> {
        let (name, observed) = numbered(&OBSERVATIONS, number)?;
        BoxPosterior::new(Self { name, observed })
    }

    /// x − θ.
    fn residual(&self, theta: &[f64; 2]) -> [f64; 2] {
        [self.observed[0] - theta[0], self.observed[1] - theta[1]]
    }
}

/// log of the density of each part, both counted half.
fn parts(residual: &[f64; 2]) -> [f64; 2] {
    let square: f64 = residual.iter().map(|residual| residual * residual).sum();
    SPREADS.map(|spread| {
        let variance = spread * spread;
        -0.5 * square / variance - 2.0 * HALF_LOG_TWO_PI - (2.0 * variance).ln()
    })
}

impl Target<2> for NestedNormals {
    fn log_density(&self, theta: &[f64; 2]) -> f64 {
        let [broad, narrow] = parts(&self.residual(theta));
        broad + crate::special::log_one_plus_exp(narrow - broad)
    }

    fn score(&self, theta: &[f64; 2]) -> [f64; 2] {
        let residual = self.residual(theta);
        let [broad, narrow] = parts(&residual);
        let share = (1.0 + (broad - narrow).exp()).recip();
        let precision = (1.0 - share) / (SPREADS[0] * SPREADS[0]) + share / (SPREADS[1] * SPREADS[1]);
        residual.map(|residual| precision * residual)
    }
}

impl Simulator<2> for NestedNormals {
    const HALF_WIDTH: f64 = 10.0;

    fn name(&self) -> &'static str {
        self.name
    }

    /// By rejection of what lies outside of the box.
    fn posterior_draw(&self, rng: &mut dyn Rng) -> [f64; 2] {
        loop {
            let spread = SPREADS[usize::from(rng.random::<bool>())];
            let [first, second] = standard_normal(rng).map(|z| spread * z);
            let theta = [self.observed[0] + first, self.observed[1] + second];
            if theta.iter().all(|theta| theta.abs() < Self::HALF_WIDTH) {
                return theta;
            }
        }
    }

    fn log_evidence(&self) -> f64 {
        let inside = |x: f64, spread: f64| {
            let [above, below] = [Self::HALF_WIDTH - x, -Self::HALF_WIDTH - x]
                .map(|z| erf(z * std::f64::consts::FRAC_1_SQRT_2 / spread));
            0.5 * (above - below)
        };
        let of_part = |spread| 0.5 * self.observed.iter().map(|x| inside(*x, spread)).product::<f64>();
        (SPREADS.map(of_part).iter().sum::<f64>() / (4.0 * Self::HALF_WIDTH * Self::HALF_WIDTH)).ln()
    }
}
