//! A Gaussian process through eleven points.

use mpm_tensor::{Cholesky, Matrix};

use super::model_posterior::{Description, ModelPosterior};
use super::prior::{Prior, centred_normal};
use crate::{Constraints, Target, TargetError};

const COUNT: usize = 11;

const LOCATIONS: [f64; COUNT] = [-10.0, -8.0, -6.0, -4.0, -2.0, 0.0, 2.0, 4.0, 6.0, 8.0, 10.0];

const VALUES: [f64; COUNT] = [
    4.75906, 1.59423, 2.99548, 5.27501, 1.66472, 2.24347, 2.8914, 4.08681, 4.60588, 0.802364, 3.92136,
];

/// How far from 0 the logarithms of the parameters are followed: K has all its digits' worth of condition there.
const LOGARITHM: f64 = 10.0;

/// The likelihood of x = (ρ, α, σ) for values y_i at places t_i: y ~ N(0, K), K_ij = k_ij + σ δ_ij,
/// k_ij = α² exp(−½ (t_i − t_j)²/ρ²). Here σ is a variance.
///
/// log L = −½ yᵀ K⁻¹ y − ½ log det K; with a = K⁻¹ y, score_k = ½ Σ_ij (a_i a_j − (K⁻¹)_ij) ∂_k K_ij, where
/// ∂_ρ K_ij = k_ij (t_i − t_j)²/ρ³, ∂_α K_ij = 2 k_ij/α, ∂_σ K_ij = δ_ij. Where K is not positive definite in floating-point
/// numbers log L is −∞ and its score 0.
#[derive(Clone, Copy, Debug)]
pub struct GaussianProcess;

impl GaussianProcess {
    /// Eleven synthetic values; ρ ~ Gamma(25, rate 4), α ~ half-normal(2), σ ~ half-normal(1).
    ///
    /// Source: posteriordb, `gp_pois_regr-gp_regr`.
    ///
    /// # Errors
    /// Those of [`Laplace::find`](crate::Laplace::find) and [`ImportanceSample::new`](crate::ImportanceSample::new).
    pub fn posterior() -> Result<ModelPosterior<Self, 3, 3>, TargetError> {
        let length = Prior::Gamma { shape: 25.0, rate: 4.0 };
        let description = Description {
            name: "gaussian-process",
            priors: [length, centred_normal(2.0), centred_normal(1.0)],
            constraints: Constraints::builder().positive(3).build()?,
            reach: [LOGARITHM; 3],
            start: [6.9, 2.4, 1.8],
        };
        ModelPosterior::new(Self, description)
    }

    /// k.
    fn kernel(&[rho, alpha, _]: &[f64; 3]) -> Matrix<COUNT> {
        Matrix::from_fn(|i, j| alpha * alpha * (-0.5 * ((LOCATIONS[i] - LOCATIONS[j]) / rho).powi(2)).exp())
    }

    /// The Cholesky factor of K = k + σ I.
    fn factor(kernel: &Matrix<COUNT>, sigma: f64) -> Option<Cholesky<COUNT>> {
        Cholesky::new(&(*kernel + Matrix::diagonal(&[sigma; COUNT]))).ok()
    }
}

impl Target<3> for GaussianProcess {
    fn log_density(&self, x: &[f64; 3]) -> f64 {
        let of = |factor: Cholesky<COUNT>| {
            let square: f64 = factor.solve_lower(&VALUES).iter().map(|z| z * z).sum();
            -0.5 * (square + factor.log_determinant())
        };
        Self::factor(&Self::kernel(x), x[2]).map_or(f64::NEG_INFINITY, of)
    }

    fn score(&self, x: &[f64; 3]) -> [f64; 3] {
        let kernel = Self::kernel(x);
        let mut score = [0.0; 3];
        let factor = Self::factor(&kernel, x[2]);
        let Some((solved, inverse)) = factor.and_then(|factor| Some((factor.solve(&VALUES), factor.inverse()?))) else {
            return score;
        };
        for i in 0..COUNT {
            for j in 0..COUNT {
                let weight = 0.5 * (solved[i] * solved[j] - inverse.0[i][j]);
                let distance = LOCATIONS[i] - LOCATIONS[j];
                score[0] += weight * kernel.0[i][j] * (distance / x[0]).powi(2) / x[0];
                score[1] += weight * 2.0 * kernel.0[i][j] / x[1];
            }
            score[2] += 0.5 * (solved[i] * solved[i] - inverse.0[i][i]);
        }
        score
    }
}
