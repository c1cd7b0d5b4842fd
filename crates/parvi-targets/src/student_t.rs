//! The multivariate Student t distribution.

use rand::Rng;
use rand_distr::{ChiSquared, Distribution};
use statrs::distribution::{ContinuousCDF, StudentsT};
use statrs::function::gamma::ln_gamma;

use crate::error::positive;
use crate::gaussian::{normal_quantiles, standard_normal};
use crate::special::gamma_quantile;
use crate::target::its_own_source;
use crate::{CatalogueTarget, ExactDraws, Frame, Moments, Target, TargetError, UnitCubeTransport};

/// t_ν(0, I): x = z √(ν/W) with z ~ N(0, I) and W ~ χ²_ν.
///
/// log p = −½(ν+D) log(1 + |x|²/ν) + log Γ(½(ν+D)) − log Γ(½ν) − D/2 · log νπ (normalised);
/// score −(ν+D) x / (ν + |x|²). Covariance ν/(ν−2) · I for ν > 2; below, [`moments`](CatalogueTarget::moments) is `None`.
#[derive(Clone, Debug)]
pub struct StudentT<const D: usize> {
    degrees_of_freedom: f64,
    log_normalisation: f64,
    chi_squared: ChiSquared<f64>,
    half_domain: f64,
}

impl<const D: usize> StudentT<D> {
    /// The distribution with ν = `degrees_of_freedom` and identity scale.
    ///
    /// # Errors
    /// [`TargetError::NotFinite`], or [`TargetError::OutOfRange`] unless 0.1 ≤ ν ≤ 10⁶ (heavier tails leave the range of
    /// numbers, lighter ones are Gaussian to rounding).
    pub fn new(degrees_of_freedom: f64) -> Result<Self, TargetError> {
        let nu = positive("degrees of freedom", degrees_of_freedom)?;
        let out_of_range = || TargetError::OutOfRange {
            field: "degrees of freedom".to_owned(),
            value: nu,
            allowed: "a number from 0.1 to 1000000",
        };
        if !(0.1..=1e6).contains(&nu) {
            return Err(out_of_range());
        }
        let d = D as f64;
        let log_normalisation =
            ln_gamma(0.5 * (nu + d)) - ln_gamma(0.5 * nu) - 0.5 * d * (nu * std::f64::consts::PI).ln();
        // All axes together stay outside with a probability below 0.5 %.
        let marginal = StudentsT::new(0.0, 1.0, nu).map_err(|_| out_of_range())?;
        let half_domain = marginal.inverse_cdf(1.0 - 0.0025 / d);
        let chi_squared = ChiSquared::new(nu).map_err(|_| out_of_range())?;
        Ok(Self {
            degrees_of_freedom: nu,
            log_normalisation,
            chi_squared,
            half_domain,
        })
    }
}

impl<const D: usize> Target<D> for StudentT<D> {
    fn log_density(&self, x: &[f64; D]) -> f64 {
        let nu = self.degrees_of_freedom;
        self.log_normalisation - 0.5 * (nu + D as f64) * (square(x) / nu).ln_1p()
    }

    fn score(&self, x: &[f64; D]) -> [f64; D] {
        let nu = self.degrees_of_freedom;
        let pull = -(nu + D as f64) / (nu + square(x));
        x.map(|x| pull * x)
    }
}

impl<const D: usize> ExactDraws<D> for StudentT<D> {
    fn draw(&self, rng: &mut dyn Rng) -> [f64; D] {
        let z: [f64; D] = standard_normal(rng);
        let stretch = (self.degrees_of_freedom / self.chi_squared.sample(rng)).sqrt();
        z.map(|z| z * stretch)
    }
}

impl<const D: usize> UnitCubeTransport<D> for StudentT<D> {
    /// One coordinate more than D: the first gives W by the quantile of χ²_ν.
    fn cube_dimension(&self) -> usize {
        D + 1
    }

    fn transport(&self, u: &[f64]) -> [f64; D] {
        student_t_from_cube(self.degrees_of_freedom, u)
    }
}

impl<const D: usize> CatalogueTarget<D> for StudentT<D> {
    fn name(&self) -> &str {
        "student-t"
    }

    /// The identity scale of the distribution (its standard deviation is larger, or infinite).
    fn frame(&self) -> Frame<D> {
        Frame::identity()
    }

    fn domain(&self) -> [[f64; 2]; D] {
        [[-self.half_domain, self.half_domain]; D]
    }

    its_own_source!(D);

    fn moments(&self) -> Option<Moments<D>> {
        let nu = self.degrees_of_freedom;
        (nu > 2.0).then(|| Moments::centred([nu / (nu - 2.0); D]))
    }

    /// The density is normalised.
    fn log_evidence(&self) -> Option<f64> {
        Some(0.0)
    }
}

/// The point x = z √(ν/W) with W the χ²_ν quantile of `u[0]` and z the normal quantiles of the D entries after it.
pub(crate) fn student_t_from_cube<const D: usize>(nu: f64, u: &[f64]) -> [f64; D] {
    let chi_square = 2.0 * gamma_quantile(0.5 * nu, u.first().copied().unwrap_or(0.5));
    let z: [f64; D] = normal_quantiles(u.get(1..).unwrap_or(&[]));
    let stretch = (nu / chi_square).sqrt();
    z.map(|z| z * stretch)
}

fn square<const D: usize>(x: &[f64; D]) -> f64 {
    x.iter().map(|x| x * x).sum()
}
