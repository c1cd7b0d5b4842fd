//! The evidence by fresh points of a frozen proposal, which did not shape it.

use crate::pareto::pareto_k;
use crate::weights::{effective_size, tempered, top};

/// Above this shape of the weights' tail no estimate is relied on; from 0.7 on none is to be.
const LARGEST_PARETO_K: f64 = 0.65;

/// Share of fresh points at which the log density may be no number: far out it may overflow.
const LARGEST_UNDEFINED: f64 = 0.02;

/// The largest standard error of the log evidence, the largest variance of the measure over that of as many independent draws as there are particles,
/// and the largest mass that fresh points met and no kernel had covered.
const LARGEST_LOG_EVIDENCE_ERROR: f64 = 0.05;
const LARGEST_VARIANCE: f64 = 0.2;
const LARGEST_MASS_UNCOVERED: f64 = 0.02;

/// Why a pool is not to be relied on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Objection {
    /// The weights' tail is heavy: its shape k̂ is above 0.65.
    HeavyTail(f64),
    /// The standard error of the log evidence is above 0.05.
    Evidence(f64),
    /// The variance of the measure over that of as many independent draws as there are particles is above 0.2.
    Noise(f64),
    /// Fresh points met more than 0.02 of the mass where no kernel had covered it.
    Uncovered(f64),
    /// The log density is NaN or +∞ at more than 0.02 of the fresh points: what mass is there, nobody knows.
    Undefined(f64),
    /// The independent parts of the measure are more than three times as far apart as their weights explain; the quotient. One of them has lost what the others met.
    Inconsistent(f64),
    /// Searches that met a piece were not followed by twice as long ones that met none; the quotient. A. M. Turing's argument, of which I. J. Good tells: where
    /// something was still met of late, there is more.
    Searching(f64),
    /// A second moment hangs on few points: less than 1/16 of the effective size carries it, or less than 3/16 after an objection of this kind, from which on proposals aim at second moments.
    Hanging {
        /// Axis, from 1.
        axis: usize,
        /// [`Estimate::carriers`](crate::Estimate::carriers) over the effective size.
        share: f64,
    },
}

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
    /// Share of the fresh points at which the log density is NaN or +∞.
    pub undefined: f64,
    /// Number of fresh points.
    pub points: usize,
}

impl Verdict {
    /// The verdict on log weights log p/q, on which points no narrow kernel covers, and on the share at which log p is no number.
    pub(super) fn of(log_weights: &[f64], covered: &[bool], undefined: f64) -> Self {
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
            undefined,
            points: log_weights.len(),
        }
    }

    /// The first reason, if any, not to rely on a pool with this verdict, this standard error of log Z and this variance, over that of as many independent
    /// draws as there are particles.
    pub(super) fn objection(&self, log_evidence_error: f64, variance: f64) -> Option<Objection> {
        let exceeds = |value: f64, largest: f64| value.is_nan() || value > largest;
        let k = self.pareto_k.unwrap_or(0.0);
        if exceeds(k, LARGEST_PARETO_K) {
            Some(Objection::HeavyTail(k))
        } else if exceeds(log_evidence_error, LARGEST_LOG_EVIDENCE_ERROR) {
            Some(Objection::Evidence(log_evidence_error))
        } else if exceeds(variance, LARGEST_VARIANCE) {
            Some(Objection::Noise(variance))
        } else if exceeds(self.mass_uncovered, LARGEST_MASS_UNCOVERED) {
            Some(Objection::Uncovered(self.mass_uncovered))
        } else if exceeds(self.undefined, LARGEST_UNDEFINED) {
            Some(Objection::Undefined(self.undefined))
        } else {
            None
        }
    }
}
