//! The eight schools: a hierarchical model whose scale may be zero.

use mpm_tensor::Matrix;
use rand::Rng;
use rand::RngExt;
use rand_distr::Open01;

use crate::catalogue::making::dimension_within;
use crate::catalogue::schools_scale::{GivenScale, PRIOR_SCALE, ScaleMarginal, School};
use crate::gaussian::{box_of_standard_deviations, normal_quantiles, standard_normal};
use crate::special::{HALF_LOG_TWO_PI, log_cosh};
use crate::target::its_own_source;
use crate::{CatalogueTarget, ExactDraws, Frame, MAXIMUM_DIMENSION, Moments, Target, TargetError, UnitCubeTransport};

/// Effect of coaching in each school and its standard error, in points of a test.
///
/// Source: D. B. Rubin, Estimation in parallel randomized experiments, *Journal of Educational Statistics* 6 (1981) 377–401.
const DATA: [School; 8] = [
    [28.0, 15.0],
    [8.0, 10.0],
    [-3.0, 16.0],
    [7.0, 11.0],
    [-1.0, 9.0],
    [1.0, 11.0],
    [18.0, 10.0],
    [12.0, 18.0],
];

/// Beyond log τ = 100, τ is held at e¹⁰⁰ where it multiplies an η, so that squares stay numbers.
const LARGEST_LOG_SCALE: f64 = 100.0;

/// The posterior of x = (μ, log τ, η_1, …, η_{D−2}) for the first D − 2 schools:
/// y_j ~ N(μ + τ η_j, σ_j²), η_j ~ N(0, 1), μ ~ N(0, 5²), τ ~ half-Cauchy(5), in the form that is not centred.
///
/// With residuals e_j = (y_j − μ − τ η_j) / σ_j and s = log τ − log 5 (the Jacobian of the logarithm turns the half-Cauchy
/// density into sech(s)/π)
///
/// log p = −½ Σ (e_j² + η_j²) − Σ log(2π σ_j) − ½ μ²/25 − ½ log(2π 25) − log cosh s − log π − log p(y) (normalised),
///
/// score_μ = Σ e_j/σ_j − μ/25, score_{log τ} = τ Σ η_j e_j/σ_j − tanh s, score_{η_j} = τ e_j/σ_j − η_j.
///
/// Given τ all else is Gaussian: with v_j = σ_j² + τ² and Λ = 1/25 + Σ 1/v_j, μ ~ N(Σ (y_j/v_j)/Λ, 1/Λ) and
/// η_j ~ N(τ (y_j − μ)/v_j, σ_j²/v_j) independently. The one-dimensional posterior of log τ, its quantiles and all moments are
/// quadratures with an error at the level of rounding; draws are exact to 1e-14 in probability. Its tail towards τ = 0 falls
/// like τ only.
#[derive(Clone, Debug)]
pub struct Schools<const D: usize> {
    marginal: ScaleMarginal,
    moments: Moments<D>,
    frame: Frame<D>,
}

impl<const D: usize> Schools<D> {
    /// The posterior of the first D − 2 schools.
    ///
    /// # Errors
    /// [`TargetError::DimensionNotAllowed`] unless 3 ≤ D ≤ 8.
    pub fn new() -> Result<Self, TargetError> {
        dimension_within("schools", D, 3..=MAXIMUM_DIMENSION)?;
        let marginal = ScaleMarginal::new(Self::data());
        let moments = moments_of(Self::data(), &marginal);
        let frame = Frame::new(moments.mean, moments.covariance)?;
        Ok(Self {
            marginal,
            moments,
            frame,
        })
    }

    /// Effects and standard errors of the schools used.
    fn data() -> &'static [School] {
        &DATA[..D - 2]
    }

    /// The point with this log τ whose other coordinates are the standard normal `z` (`z[1]` is not used).
    fn given_scale(&self, log_scale: f64, z: [f64; D]) -> [f64; D] {
        let given = GivenScale::new(Self::data(), log_scale);
        let mu = given.mean + z[0] / given.precision.sqrt();
        let tau = log_scale.exp();
        let mut x = z;
        (x[0], x[1]) = (mu, log_scale);
        for (eta, [y, sigma]) in x[2..].iter_mut().zip(Self::data()) {
            let variance = sigma * sigma + tau * tau;
            *eta = tau * (y - mu) / variance + *eta * sigma / variance.sqrt();
        }
        x
    }
}

/// Mean and covariance as expectations over log τ of those given τ: with b_j = τ/v_j the η_j have mean b_j (y_j − E μ),
/// variance σ_j²/v_j + b_j²/Λ, covariance b_i b_j/Λ with each other and −b_j/Λ with μ.
fn moments_of<const D: usize>(schools: &[School], marginal: &ScaleMarginal) -> Moments<D> {
    let mean_given = |log_scale: f64, given: &GivenScale| -> [f64; D] {
        std::array::from_fn(|axis| match axis {
            0 => given.mean,
            1 => log_scale,
            _ => slope(schools[axis - 2], log_scale) * (schools[axis - 2][0] - given.mean),
        })
    };
    let mean: [f64; D] = marginal.expectation(mean_given);
    let covariance = Matrix::from_fn(|i, j| {
        let [entry] = marginal.expectation(|log_scale, given| {
            // d(coordinate)/dμ given τ: what they share through μ.
            let shared = |axis: usize| match axis {
                0 => 1.0,
                1 => 0.0,
                _ => -slope(schools[axis - 2], log_scale),
            };
            let means = mean_given(log_scale, given);
            let mut entry = shared(i) * shared(j) / given.precision + (means[i] - mean[i]) * (means[j] - mean[j]);
            if i == j && i >= 2 {
                let sigma = schools[i - 2][1];
                entry += sigma * sigma / (sigma * sigma + (2.0 * log_scale).exp());
            }
            [entry]
        });
        entry
    });
    Moments {
        mean,
        covariance: covariance.symmetric_part(),
    }
}

/// τ/v_j.
fn slope([_, sigma]: School, log_scale: f64) -> f64 {
    let tau = log_scale.exp();
    tau / (sigma * sigma + tau * tau)
}

impl<const D: usize> Target<D> for Schools<D> {
    fn log_density(&self, x: &[f64; D]) -> f64 {
        let tau = x[1].min(LARGEST_LOG_SCALE).exp();
        let mu = x[0] / PRIOR_SCALE;
        let mut sum = -0.5 * mu * mu - PRIOR_SCALE.ln() - HALF_LOG_TWO_PI;
        sum -= log_cosh(x[1] - PRIOR_SCALE.ln()) + std::f64::consts::PI.ln() + self.marginal.log_evidence();
        for (eta, [y, sigma]) in x[2..].iter().zip(Self::data()) {
            let residual = (y - x[0] - tau * eta) / sigma;
            sum -= 0.5 * (residual * residual + eta * eta) + sigma.ln() + 2.0 * HALF_LOG_TWO_PI;
        }
        sum
    }

    fn score(&self, x: &[f64; D]) -> [f64; D] {
        let tau = x[1].min(LARGEST_LOG_SCALE).exp();
        let mut score = [0.0; D];
        score[0] = -x[0] / (PRIOR_SCALE * PRIOR_SCALE);
        score[1] = -(x[1] - PRIOR_SCALE.ln()).tanh();
        for (axis, [y, sigma]) in (2..D).zip(Self::data()) {
            let pull = (y - x[0] - tau * x[axis]) / (sigma * sigma);
            score[0] += pull;
            score[1] += tau * x[axis] * pull;
            score[axis] = tau * pull - x[axis];
        }
        score
    }
}

impl<const D: usize> ExactDraws<D> for Schools<D> {
    fn draw(&self, rng: &mut dyn Rng) -> [f64; D] {
        let log_scale = self.marginal.quantile(rng.sample(Open01));
        self.given_scale(log_scale, standard_normal(rng))
    }
}

impl<const D: usize> UnitCubeTransport<D> for Schools<D> {
    /// `u` in the order of the coordinates: `u[1]` is the mass below log τ.
    fn transport(&self, u: &[f64]) -> [f64; D] {
        let log_scale = self.marginal.quantile(u.get(1).copied().unwrap_or(0.5));
        self.given_scale(log_scale, normal_quantiles(u))
    }
}

impl<const D: usize> CatalogueTarget<D> for Schools<D> {
    fn name(&self) -> &str {
        "schools"
    }

    /// The frame of mean and covariance.
    fn frame(&self) -> Frame<D> {
        self.frame
    }

    /// The mean ± six standard deviations: log τ has exponential tails.
    fn domain(&self) -> [[f64; 2]; D] {
        box_of_standard_deviations(&self.moments.mean, &self.moments.covariance, 6.0)
    }

    its_own_source!(D);

    fn moments(&self) -> Option<Moments<D>> {
        Some(self.moments)
    }

    /// The density is normalised.
    fn log_evidence(&self) -> Option<f64> {
        Some(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// p(x) = p(log τ) p(μ | τ) Π p(η_j | μ, τ): the joint density against the conditionals that draws are made from.
    fn joint_density_is_the_product_of_its_conditionals<const D: usize>() {
        let schools = Schools::<D>::new().unwrap();
        let normal = |z: f64, deviation: f64| -0.5 * z * z - deviation.ln() - HALF_LOG_TWO_PI;
        for index in 0..200 {
            let spread = |k: usize| ((index * D + k + 1) as f64 * 0.618_033_988_75).fract() * 8.0 - 4.0;
            let mut x: [f64; D] = std::array::from_fn(spread);
            x[0] *= 5.0;
            x[1] *= 3.0;
            let given = GivenScale::new(Schools::<D>::data(), x[1]);
            let mut product = given.log_density - schools.marginal.log_evidence();
            let deviation = given.precision.sqrt().recip();
            product += normal((x[0] - given.mean) / deviation, deviation);
            let tau = x[1].exp();
            for (eta, [y, sigma]) in x[2..].iter().zip(Schools::<D>::data()) {
                let variance = sigma * sigma + tau * tau;
                let deviation = sigma / variance.sqrt();
                product += normal((eta - tau * (y - x[0]) / variance) / deviation, deviation);
            }
            let found = schools.log_density(&x);
            // τ η of 10⁶ standard errors loses six of the digits of its square.
            assert!(
                (found - product).abs() < 1e-11 * (1.0 + found.abs()),
                "{x:?}: {found} and {product}"
            );
        }
    }

    #[test]
    fn draws_and_density_belong_together() {
        mpm_tensor::in_dimensions!(joint_density_is_the_product_of_its_conditionals(), 3, 5, 8);
    }

    #[test]
    fn dimensions_are_checked() {
        assert!(matches!(
            Schools::<2>::new(),
            Err(TargetError::DimensionNotAllowed { .. })
        ));
        assert!(matches!(
            Schools::<9>::new(),
            Err(TargetError::DimensionNotAllowed { .. })
        ));
    }
}
