//! Synthetic data for regressions, from a seed.

use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use rand_distr::{Distribution, StandardNormal};

use crate::error::finite;
use crate::{RegressionData, TargetError};

impl RegressionData {
    /// `rows` rows of synthetic data: covariates x_ij ~ N(0, 1) behind the intercept, responses 1 with probability
    /// 1 / (1 + exp(−x_iᵀ β)), β = `coefficients` with the intercept first. The same seed gives the same data.
    ///
    /// # Errors
    /// [`TargetError::Empty`] without coefficients, [`TargetError::DataNoRows`] for `rows` = 0,
    /// [`TargetError::NotFinite`] for a coefficient.
    pub fn synthetic(coefficients: &[f64], rows: usize, seed: u64) -> Result<Self, TargetError> {
        if coefficients.is_empty() {
            return Err(TargetError::Empty {
                field: "the list of coefficients".to_owned(),
            });
        }
        for (index, &coefficient) in coefficients.iter().enumerate() {
            finite(&format!("coefficient {index}"), coefficient)?;
        }
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut data = Self::empty(
            "synthetic data",
            (1..coefficients.len()).map(|index| format!("x{index}")),
        );
        let mut covariates = vec![0.0; coefficients.len() - 1];
        for _ in 0..rows {
            covariates.fill_with(|| StandardNormal.sample(&mut rng));
            let slope: f64 = coefficients[1..].iter().zip(&covariates).map(|(b, x)| b * x).sum();
            let probability = 1.0 / (1.0 + (-(coefficients[0] + slope)).exp());
            data.push(rng.random::<f64>() < probability, &covariates);
        }
        data.non_empty()
    }
}
