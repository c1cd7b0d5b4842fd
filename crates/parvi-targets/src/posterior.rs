//! What the log posterior of a regression is made of.

use std::marker::PhantomData;

use mpm_tensor::vector;

use crate::{Link, RegressionTable, Response, TargetError};

/// log p(β) = Σ_i [a_i x_iᵀβ + ℓ(b_i x_iᵀβ) + c_i] + Σ_k [½ log(precision_k/2π) − ½ precision_k β_k²], with a, b, c of the [`Response`]s and ℓ of the
/// [`Link`]: likelihood times normalised prior, whose integral is the evidence. A flat prior has precision 0, and no constant.
#[derive(Clone, Debug)]
pub(crate) struct Posterior<L, const D: usize> {
    /// b_i x_i: with the sign of a yes or no in the row one ℓ serves both, and nothing cancels in either tail.
    pub(crate) rows: Vec<[f64; D]>,
    /// Σ a_i x_i.
    pub(crate) linear: [f64; D],
    /// Σ c_i, and the constants of the prior.
    pub(crate) constant: f64,
    /// 1/s_k², zero for a flat prior.
    pub(crate) precision: [f64; D],
    pub(crate) link: PhantomData<L>,
}

impl<L: Link, const D: usize> Posterior<L, D> {
    /// The posterior of `data` under flat priors; an error unless D is the data's dimension.
    pub(crate) fn new(data: &RegressionTable<L::Response>) -> Result<Self, TargetError> {
        let mut rows = data.rows_of::<D>()?;
        let (mut linear, mut constant) = ([0.0; D], 0.0);
        for (row, response) in rows.iter_mut().zip(data.responses()) {
            vector::accumulate(&mut linear, response.linear(), row);
            constant += response.constant();
            *row = row.map(|x| response.sign() * x);
        }
        Ok(Self {
            rows,
            linear,
            constant,
            precision: [0.0; D],
            link: PhantomData,
        })
    }

    /// The same under priors of the given precisions in the place of flat ones.
    pub(crate) fn with_priors(mut self, precision: [f64; D]) -> Self {
        let proper = precision.iter().filter(|&&precision| precision > 0.0);
        let constants = proper.map(|precision| 0.5 * (precision / std::f64::consts::TAU).ln());
        self.constant += constants.sum::<f64>();
        self.precision = precision;
        self
    }

    /// aᵀβ + c − ½ Σ precision_k β_k².
    pub(crate) fn without_rows(&self, coefficients: &[f64; D]) -> f64 {
        let prior: f64 = (0..D)
            .map(|k| self.precision[k] * coefficients[k] * coefficients[k])
            .sum();
        vector::dot(&self.linear, coefficients) + self.constant - 0.5 * prior
    }
}
