//! Bayesian logistic regression with a Gaussian prior.

use mpm_tensor::Matrix;

use crate::error::positive;
use crate::identifiability::{check_independence, check_overlap};
use crate::{
    CatalogueTarget, Curvature, Frame, Laplace, RegressionData, Target, TargetError, logistic_batch, logistic_posterior,
};

/// The standard deviation of the prior of each coefficient unless another is given.
pub const DEFAULT_PRIOR_STANDARD_DEVIATION: f64 = 10.0;

/// The posterior of the coefficients β ∈ ℝᴰ: y_i ~ Bernoulli(σ(x_iᵀ β)), β_k ~ N(0, s_k²), σ(t) = 1 / (1 + e^−t).
///
/// log p(β) = Σ_i [y_i x_iᵀβ − log(1 + e^(x_iᵀβ))] − ½ Σ_k β_k²/s_k²; score Σ_i (y_i − σ(x_iᵀβ)) x_i − β/s².
/// Batches of scores and log densities are matrix products, parallel over groups of particles; a batched value agrees
/// with the one of a single point to rounding, and is the same bits in every batch.
///
/// Cost of a batch: n·M logistic functions and 4·n·M·D floating-point operations for n rows and M particles.
#[derive(Clone, Debug)]
pub struct LogisticRegression<const D: usize> {
    name: String,
    data: RegressionData,
    /// (2y_i − 1) x_i: for either response the likelihood of a row is then σ(row · β).
    pub(crate) signed_rows: Vec<[f64; D]>,
    /// 1/s_k², zero for a flat prior.
    pub(crate) precision: [f64; D],
    laplace: Laplace<D>,
}

impl<const D: usize> LogisticRegression<D> {
    /// The regression on `data` with prior standard deviations s_k, where `f64::INFINITY` stands for a flat prior.
    ///
    /// # Errors
    /// [`TargetError::Length`] unless D is the data's dimension; [`TargetError::OutOfRange`] or
    /// [`TargetError::NotFinite`] unless s_k > 0; for flat priors [`TargetError::DataCollinear`] and
    /// [`TargetError::DataSeparated`] where the posterior would be improper; the errors of [`Laplace::find`].
    pub fn new(name: &str, data: RegressionData, prior_standard_deviations: [f64; D]) -> Result<Self, TargetError> {
        let mut signed_rows = data.rows_of::<D>()?;
        let mut precision = [0.0; D];
        for (k, &s) in prior_standard_deviations.iter().enumerate() {
            if s != f64::INFINITY {
                let field = format!("the prior standard deviation of '{}'", data.names()[k]);
                precision[k] = positive(&field, s)?.powi(-2);
                crate::error::finite(&format!("the inverse square of {field}"), precision[k])?;
            }
        }
        let flat = precision.map(|precision| precision == 0.0);
        check_independence(&data, &signed_rows, &flat)?;
        for (row, &response) in signed_rows.iter_mut().zip(data.responses()) {
            if !response {
                *row = row.map(|x| -x);
            }
        }
        if flat.contains(&true) {
            check_overlap(&data, &signed_rows, &precision)?;
        }
        let posterior = Posterior {
            signed_rows: &signed_rows,
            precision: &precision,
        };
        let laplace = Laplace::find(name, &posterior, [0.0; D])?;
        Ok(Self {
            name: name.to_owned(),
            data,
            signed_rows,
            precision,
            laplace,
        })
    }

    /// The regression with the prior N(0, s²) on every coefficient.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_prior(name: &str, data: RegressionData, standard_deviation: f64) -> Result<Self, TargetError> {
        Self::new(name, data, [standard_deviation; D])
    }

    /// The data.
    pub fn data(&self) -> &RegressionData {
        &self.data
    }

    /// The Laplace approximation of the posterior.
    pub fn laplace(&self) -> &Laplace<D> {
        &self.laplace
    }

    fn posterior(&self) -> Posterior<'_, D> {
        Posterior {
            signed_rows: &self.signed_rows,
            precision: &self.precision,
        }
    }
}

impl<const D: usize> Target<D> for LogisticRegression<D> {
    fn log_density(&self, x: &[f64; D]) -> f64 {
        self.posterior().log_density(x)
    }

    fn score(&self, x: &[f64; D]) -> [f64; D] {
        self.posterior().score(x)
    }

    fn scores(&self, xs: &[[f64; D]], out: &mut [[f64; D]]) {
        logistic_batch::scores(&self.signed_rows, &self.precision, xs, out);
    }

    fn log_densities(&self, xs: &[[f64; D]], out: &mut [f64]) {
        logistic_batch::log_densities(&self.signed_rows, &self.precision, xs, out);
    }
}

impl<const D: usize> Curvature<D> for LogisticRegression<D> {
    fn negative_hessian(&self, x: &[f64; D]) -> Matrix<D> {
        self.posterior().negative_hessian(x)
    }
}

impl<const D: usize> CatalogueTarget<D> for LogisticRegression<D> {
    fn name(&self) -> &str {
        &self.name
    }

    /// The Laplace approximation's.
    fn frame(&self) -> Frame<D> {
        *self.laplace.frame()
    }

    /// The mode ± six standard deviations of the Laplace approximation: posteriors of little data are skewed.
    fn domain(&self) -> [[f64; 2]; D] {
        crate::gaussian::box_of_standard_deviations(self.laplace.mode(), &self.laplace.covariance(), 6.0)
    }
}

/// The density while the mode is still being sought.
struct Posterior<'a, const D: usize> {
    signed_rows: &'a [[f64; D]],
    precision: &'a [f64; D],
}

impl<const D: usize> Target<D> for Posterior<'_, D> {
    fn log_density(&self, x: &[f64; D]) -> f64 {
        logistic_posterior::log_posterior(self.signed_rows, self.precision, x)
    }

    fn score(&self, x: &[f64; D]) -> [f64; D] {
        logistic_posterior::score(self.signed_rows, self.precision, x)
    }
}

impl<const D: usize> Curvature<D> for Posterior<'_, D> {
    fn negative_hessian(&self, x: &[f64; D]) -> Matrix<D> {
        logistic_posterior::negative_hessian(self.signed_rows, self.precision, x)
    }
}
