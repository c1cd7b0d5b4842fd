//! The evidence by fresh points of a frozen proposal, which did not shape it.

use crate::pareto::pareto_k;
use crate::weights::{effective_size, tempered, top};

/// What fresh points of a frozen proposal say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Verdict {
    /// log Z, Z the mean weight p/q: unbiased for Z.
    pub log_evidence: f64,
    /// Its standard error, by the spread of the weights.
    pub log_evidence_error: f64,
    /// Effective size of the fresh points over their number.
    pub effective_share: f64,
    /// Shape of the weights' tail; `None` where there is no tail.
    pub pareto_k: Option<f64>,
    /// Share of the weight of fresh points at which the wide parts of the proposal outweigh all others: the mass that recent points met and no kernel had covered,
    /// after I. J. Good, *The population frequencies of species*, Biometrika 40, 1953.
    pub mass_uncovered: f64,
    /// Number of fresh points.
    pub points: usize,
}

impl Verdict {
    /// The verdict on log weights log p/q and on which points no narrow kernel covers.
    pub(super) fn of(log_weights: &[f64], covered: &[bool]) -> Self {
        let n = log_weights.len() as f64;
        let weights = tempered(log_weights, 1.0);
        let mean = weights.iter().sum::<f64>() / n;
        let variance = weights.iter().map(|w| (w - mean).powi(2)).sum::<f64>() / (n * (n - 1.0));
        let uncovered: f64 = weights
            .iter()
            .zip(covered)
            .filter(|(_, covered)| !**covered)
            .map(|(w, _)| w)
            .sum();
        Self {
            log_evidence: top(log_weights) + mean.ln(),
            log_evidence_error: variance.sqrt() / mean,
            effective_share: effective_size(&weights) / n,
            pareto_k: pareto_k(&weights),
            mass_uncovered: uncovered / (n * mean),
            points: log_weights.len(),
        }
    }
}
