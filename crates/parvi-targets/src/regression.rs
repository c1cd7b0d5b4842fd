//! Bayesian regressions with a Gaussian prior: logistic, probit and Poisson.

use mpm_tensor::Matrix;

use crate::error::{positive, within};
use crate::identifiability::{check_independence, check_overlap};
use crate::posterior::Posterior;
use crate::{
    CatalogueTarget, Curvature, Frame, Laplace, Link, Logarithm, Logit, Probit, RegressionTable, Response, Target,
    TargetError,
};

/// The prior standard deviations s for which 1/s² is a normal number, and a flat prior's.
const ALLOWED: &str = "a number from 7.46e-155 to 6.70e153, or inf";

/// The posterior of the coefficients β ∈ ℝᴰ of a regression with predictors x_iᵀβ and the prior β_k ~ N(0, s_k²).
///
/// log p(β) = Σ_i log p(y_i | x_iᵀβ) − ½ Σ_k β_k²/s_k², where the [`Link`] L gives the likelihood of a response; score
/// Σ_i ∂ log p(y_i | x_iᵀβ) x_i − β/s². Log-concave, so Newton's method finds the mode. Batches of scores and log densities
/// are matrix products, parallel over groups of particles; a batched value agrees with the one of a single point to
/// rounding, and is the same bits in every batch.
///
/// Cost of a batch: n·M evaluations of the link and 4·n·M·D floating-point operations for n rows and M particles.
#[derive(Clone, Debug)]
pub struct Regression<L: Link, const D: usize> {
    name: String,
    data: RegressionTable<L::Response>,
    pub(crate) posterior: Posterior<L, D>,
    laplace: Laplace<D>,
}

/// y_i ~ Bernoulli(σ(x_iᵀβ)), σ(t) = 1 / (1 + e^−t): log p = Σ_i [y_i x_iᵀβ − log(1 + e^(x_iᵀβ))] − ½ Σ_k β_k²/s_k².
pub type LogisticRegression<const D: usize> = Regression<Logit, D>;

/// y_i ~ Bernoulli(Φ(x_iᵀβ)): log p = Σ_i log Φ((2y_i − 1) x_iᵀβ) − ½ Σ_k β_k²/s_k².
pub type ProbitRegression<const D: usize> = Regression<Probit, D>;

/// y_i ~ Poisson(exp(x_iᵀβ)): log p = Σ_i [y_i x_iᵀβ − e^(x_iᵀβ) − log y_i!] − ½ Σ_k β_k²/s_k².
///
/// Means above e¹⁰⁰ are continued linearly in the predictor (see [`Logarithm`]).
pub type PoissonRegression<const D: usize> = Regression<Logarithm, D>;

impl<L: Link, const D: usize> Regression<L, D> {
    /// The regression on `data` with prior standard deviations s_k, where `f64::INFINITY` stands for a flat prior.
    ///
    /// # Errors
    /// [`TargetError::Length`] unless D is the data's dimension; [`TargetError::OutOfRange`] or
    /// [`TargetError::NotFinite`] unless s_k > 0 and 1/s_k² is a normal number; for flat priors [`TargetError::DataCollinear`] and
    /// [`TargetError::DataSeparated`] where the posterior would be improper; the errors of [`Laplace::find`].
    pub fn new(
        name: &str,
        data: RegressionTable<L::Response>,
        prior_standard_deviations: [f64; D],
    ) -> Result<Self, TargetError> {
        let posterior = Posterior::<L, D>::new(&data)?;
        let mut precision = [0.0; D];
        for (k, &s) in prior_standard_deviations.iter().enumerate() {
            if s != f64::INFINITY {
                let field = format!("the prior standard deviation of '{}'", data.names()[k]);
                precision[k] = positive(&field, s)?.powi(-2);
                within(&field, s, precision[k].is_normal(), ALLOWED)?;
            }
        }
        let posterior = posterior.with_priors(precision);
        let flat = precision.map(|precision| precision == 0.0);
        check_independence(&data, &posterior.rows, &flat)?;
        if flat.contains(&true) {
            // Overlap is a matter of the data, and the canonical link's Newton steps tell it most clearly.
            let canonical = Posterior::<<L::Response as Response>::Canonical, D>::new(&data)?;
            check_overlap(&data, &canonical.with_priors(precision))?;
        }
        let laplace = Laplace::find(name, &posterior, [0.0; D]).map_err(|error| named(error, &data))?;
        Ok(Self {
            name: name.to_owned(),
            data,
            posterior,
            laplace,
        })
    }

    /// The regression with the prior N(0, s²) on every coefficient.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_prior(
        name: &str,
        data: RegressionTable<L::Response>,
        standard_deviation: f64,
    ) -> Result<Self, TargetError> {
        Self::new(name, data, [standard_deviation; D])
    }

    /// The data.
    pub fn data(&self) -> &RegressionTable<L::Response> {
        &self.data
    }

    /// The Laplace approximation of the posterior.
    pub fn laplace(&self) -> &Laplace<D> {
        &self.laplace
    }
}

impl<L: Link, const D: usize> Target<D> for Regression<L, D> {
    fn log_density(&self, x: &[f64; D]) -> f64 {
        self.posterior.log_density(x)
    }

    fn score(&self, x: &[f64; D]) -> [f64; D] {
        self.posterior.score(x)
    }

    fn scores(&self, xs: &[[f64; D]], out: &mut [[f64; D]]) {
        self.posterior.scores(xs, out);
    }

    fn log_densities(&self, xs: &[[f64; D]], out: &mut [f64]) {
        self.posterior.log_densities(xs, out);
    }
}

impl<L: Link, const D: usize> Curvature<D> for Regression<L, D> {
    fn negative_hessian(&self, x: &[f64; D]) -> Matrix<D> {
        self.posterior.negative_hessian(x)
    }
}

impl<L: Link, const D: usize> CatalogueTarget<D> for Regression<L, D> {
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

/// An error about an axis, with the name of its column.
fn named<R: Response>(error: TargetError, data: &RegressionTable<R>) -> TargetError {
    match error {
        TargetError::NotPositiveDefinite { field, axis, value } => TargetError::Undetermined {
            field,
            column: data.names().get(axis).cloned().unwrap_or_default(),
            file: data.source().to_owned(),
            value,
        },
        error => error,
    }
}
