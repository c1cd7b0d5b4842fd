//! The finished pool: everything evaluated with its weights, and what follows from them.

use std::fmt;

use mpm_tensor::{Matrix, vector};
use parvi_targets::Frame;
use rand::RngExt;
use rand::rngs::ChaCha8Rng;

use crate::adapt::{Adaptation, QUIET};
use crate::density::Density;
use crate::estimate::Estimate;
use crate::fold::{Fold, joined};
use crate::freeze::Frozen;
use crate::marginal::{Marginal, hanging};
use crate::measure::Measure;
use crate::options::{Plan, Round};
use crate::referee::{Objection, Verdict};
use crate::sample::moments;
use crate::weights::effective_size;

/// Of parts that stand for the same.
const LARGEST_INCONSISTENCY: f64 = 3.0;

/// Errors of a control variate over those without, from which on there is none.
const WORTH_CONTROL: f64 = 2.0;

/// Probability with which a piece that is seen from a share [`Pool::unseen`] of all draws is overlooked.
const OVERLOOKED: f64 = 0.05;

/// The points of all proposals but those of the first rounds that had few effective points and of the scouts, with weights.
#[derive(Clone)]
pub struct Pool<const D: usize> {
    /// Positions in the target's coordinates.
    pub positions: Vec<[f64; D]>,
    /// log p there; −∞ where it is not a number to count with.
    pub log_densities: Vec<f64>,
    /// Weights that sum to one.
    pub weights: Vec<f64>,
    /// What stands for the target: the points with control variates, for moments and for condensation.
    pub measure: Measure<D>,
    /// log Z from all points.
    pub log_evidence: f64,
    /// Its standard error: by the spread of the weights, or by how far the folds are apart, if that is more.
    pub log_evidence_error: f64,
    /// What fresh points of the frozen proposal say.
    pub verdict: Verdict,
    /// The rounds that shaped the proposals, in their order.
    pub rounds: Vec<Round>,
    /// [`Measure::inconsistency`]; zero where it is not known.
    pub inconsistency: f64,
    /// Evaluations of searches since they last met a piece, over those before; infinite where they met none.
    pub quiet: f64,
    /// Draws of searches' wide law since they last met a piece.
    pub drawn_in_vain: u64,
    /// Whether its proposals had an earlier pool whose second moments hang on few points.
    pub(crate) had_hung: bool,
    /// Points at which log p was evaluated.
    pub density_evaluations: u64,
    /// Points at which the score was evaluated.
    pub score_evaluations: u64,
    /// Log densities and scores that were not finite or too large, and counted as −∞ and as zero.
    pub values_replaced: u64,
}

/// How much it holds and what it says, without the points.
impl<const D: usize> fmt::Debug for Pool<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Pool")
            .field("points", &self.positions.len())
            .field("effective_size", &self.effective_size())
            .field("log_evidence", &self.log_evidence)
            .field("log_evidence_error", &self.log_evidence_error)
            .field("verdict", &self.verdict)
            .finish_non_exhaustive()
    }
}

impl<const D: usize> Pool<D> {
    /// Joins the folds, every one of which estimates Z by itself: in the weights they count by their effective sizes, in the measure by the inverse of its variance.
    pub(crate) fn new(
        adaptation: &Adaptation<D>,
        frozen: &Frozen<D>,
        density: &Density<'_, D>,
        (particles, plan): (usize, &Plan),
        rng: &mut ChaCha8Rng,
    ) -> Self {
        let frame = density.frame;
        let folds = &adaptation.folds;
        let fresh = &frozen.fresh;
        let points = fresh.positions.len() as f64;
        let fresh_logs: Vec<f64> = fresh.log_weights().iter().map(|l| l + points.ln()).collect();
        let verdict = Verdict::of(&fresh_logs, &frozen.covered, frozen.undefined);
        let all = [&folds[0], &folds[1], fresh];
        let (log_evidence, log_evidence_error, mut measure) = together(all, verdict.effective_share, particles, rng);
        let inconsistency = Some(measure.inconsistency()).filter(|ratio| ratio.is_finite());
        for y in &mut measure.points {
            *y = frame.to_target(y);
        }
        let (positions, log_densities, logs) = joined(&all);
        let mut weights = crate::weights::tempered(&logs, 1.0);
        let sum: f64 = weights.iter().sum();
        weights.iter_mut().for_each(|w| *w /= sum);
        Self {
            positions: positions.iter().map(|z| frame.to_target(z)).collect(),
            log_densities: log_densities.iter().map(|l| l - frame.log_determinant()).collect(),
            weights,
            measure,
            log_evidence,
            log_evidence_error,
            verdict,
            rounds: adaptation.rounds.clone(),
            inconsistency: inconsistency.unwrap_or(0.0),
            quiet: adaptation.quiet(),
            drawn_in_vain: adaptation.drawn_in_vain(),
            had_hung: plan.hanging,
            density_evaluations: density.density_evaluations,
            score_evaluations: density.score_evaluations,
            values_replaced: density.replaced,
        }
    }

    /// The entropy power e^{2 h/D}/(2πe) of the target over that of the normal law of its covariance, h its entropy: 1 for a normal law, and less the more bent
    /// it is or the more pieces it has. e^{−2 KL/D}, KL = Σ w (log p − log Z − log N) (C. E. Shannon, *A mathematical theory of communication*, 1948, §21).
    pub fn entropy_power(&self) -> f64 {
        let (mean, covariance) = self.moments();
        let Ok(normal) = Frame::new(mean, covariance) else {
            return 1.0;
        };
        let constant = normal.log_determinant() + 0.5 * D as f64 * std::f64::consts::TAU.ln() - self.log_evidence;
        let excess = |x: &[f64; D], log: f64| log + constant + 0.5 * vector::norm_squared(&normal.to_reference(x));
        let points = self.positions.iter().zip(&self.log_densities).zip(&self.weights);
        let weighted = points.filter(|((_, log), w)| **w > 0.0 && log.is_finite());
        let divergence: f64 = weighted.map(|((x, log), w)| w * excess(x, *log)).sum();
        (-2.0 * divergence / D as f64).exp()
    }

    /// With log Z and its error of an earlier pool, where that error is less and both agree: proposals that aim at second moments know them better, and log Z worse.
    pub(crate) fn keeping(self, (log_evidence, log_evidence_error): (f64, f64)) -> Self {
        let apart = (log_evidence - self.log_evidence).abs();
        let agrees = apart <= LARGEST_INCONSISTENCY * log_evidence_error.hypot(self.log_evidence_error);
        if agrees && log_evidence_error < self.log_evidence_error {
            Self {
                log_evidence,
                log_evidence_error,
                ..self
            }
        } else {
            self
        }
    }

    /// The first reason, if any, not to rely on these weights for so many particles.
    pub fn objection(&self, particles: usize) -> Option<Objection> {
        self.objection_beside_moments(particles)
            .or_else(|| self.hanging(&self.marginals()))
    }

    /// The same with the [`marginals`](Self::marginals), where they are known already.
    pub fn objection_given(&self, particles: usize, marginals: &[Marginal; D]) -> Option<Objection> {
        self.objection_beside_moments(particles)
            .or_else(|| self.hanging(marginals))
    }

    fn hanging(&self, marginals: &[Marginal; D]) -> Option<Objection> {
        hanging(marginals, self.effective_size(), self.had_hung)
    }

    /// Mean and variance of every coordinate, by [`expectation`](Self::expectation).
    pub fn marginals(&self) -> [Marginal; D] {
        let (_, deviation) = self.measure.mean_and_deviation();
        std::array::from_fn(|axis| Marginal::of(deviation[axis], |f| self.expectation(|x| f(x[axis]))))
    }

    /// The first one that asks for no moments.
    fn objection_beside_moments(&self, particles: usize) -> Option<Objection> {
        let variance = self.measure.variance * particles as f64;
        let objection = self.verdict.objection(self.log_evidence_error, variance);
        let inconsistent = (self.inconsistency > LARGEST_INCONSISTENCY).then_some(self.inconsistency);
        let searching = (self.quiet < QUIET).then_some(Objection::Searching(self.quiet));
        objection.or(inconsistent.map(Objection::Inconsistent)).or(searching)
    }

    /// What searches can have overlooked: the share v of their law's draws from which a piece is seen, such that with probability 0.05 none of the `n` that met
    /// nothing was one, (1 − v)ⁿ = 0.05; about 3/n. A piece that is seen from more of them is known, with 95 % confidence.
    pub fn unseen(&self) -> f64 {
        1.0 - OVERLOOKED.powf(1.0 / self.drawn_in_vain as f64)
    }

    /// The points that weigh anything, with their weights.
    pub fn weighing(&self) -> (Vec<[f64; D]>, Vec<f64>) {
        let pairs = self.positions.iter().zip(&self.weights);
        pairs.filter(|(_, weight)| **weight > 0.0).unzip()
    }

    /// Kish's effective size of the weights.
    pub fn effective_size(&self) -> f64 {
        effective_size(&self.weights)
    }

    /// Mean and covariance.
    pub fn moments(&self) -> ([f64; D], Matrix<D>) {
        moments(&self.positions, &self.weights)
    }

    /// E\[f\] under the target, by the [`measure`](Self::measure) with its control variates, or by the weights alone, Σ w f ± (Σ w² (f − f̄)²)^½, where that has less than half of its error or than
    /// the share of one of its free draws: kernels have longer tails than the target, in which a function such as e^y, a parameter that was made positive, may have no expectation.
    ///
    /// The error is that of the points that were met. Of a rare event it can be trusted where enough of them meet it: by [`carriers`](Estimate::carriers) from 100 on
    /// (docs/limitations.md); where fewer do the value is low and the error several times too small, and where none does both are 0, of an event that may well have a probability.
    pub fn expectation(&self, f: impl Fn(&[f64; D]) -> f64) -> Estimate {
        let terms = self.measure.terms(&f);
        let (controlled, largest) = Estimate::of_terms(&terms);
        let weighted = self.positions.iter().zip(&self.weights).filter(|(_, w)| **w > 0.0);
        let weighted: Vec<_> = weighted.map(|(y, w)| (*w, f(y), true)).collect();
        let (weighed, _) = Estimate::of_terms(&weighted);
        let error = weighed.standard_error;
        if controlled.standard_error <= WORTH_CONTROL * error && largest <= error {
            // Beside a control variate weights are small and of any sign: what carries an estimate is what was met.
            Estimate {
                carriers: weighed.carriers,
                ..self.measure.spread(controlled, &terms)
            }
        } else {
            weighed
        }
    }

    /// The quantile of one coordinate; NaN for an axis that is none, and a probability that is none.
    pub fn quantile(&self, axis: usize, probability: f64) -> f64 {
        if axis >= D || !(0.0..=1.0).contains(&probability) {
            return f64::NAN;
        }
        let count = self.positions.len().min(self.weights.len());
        let mut order: Vec<usize> = (0..count).filter(|&i| self.weights[i] > 0.0).collect();
        order.sort_by(|&a, &b| self.positions[a][axis].total_cmp(&self.positions[b][axis]));
        let mut sum = 0.0;
        for &index in &order {
            sum += self.weights[index];
            if sum >= probability {
                return self.positions[index][axis];
            }
        }
        order.last().map_or(f64::NAN, |&index| self.positions[index][axis])
    }

    /// What stands for √p: light parts count for more.
    pub fn flattened(&self) -> Measure<D> {
        let rooted = |(w, log): (&f64, &f64)| {
            if *w > 0.0 && log.is_finite() {
                w.ln() - 0.5 * log
            } else {
                f64::NEG_INFINITY
            }
        };
        let logs: Vec<f64> = self.weights.iter().zip(&self.log_densities).map(rooted).collect();
        let weights = crate::weights::tempered(&logs, 1.0);
        let total: f64 = weights.iter().sum();
        Measure::new(self.positions.clone(), weights.iter().map(|w| w / total).collect())
    }
}

/// The folds' evidences with a standard error, and their measures, by the inverse of the variances.
///
/// The last fold is of fresh points, which shaped no proposal: its evidence is unbiased. That of the others is not quite, the less so the smaller the effective `share` of the
/// fresh points is, so that in the evidence their variances count 1/share times, and what separates them from the fresh points' beyond their errors adds to the error.
fn together<const D: usize>(
    folds: [&Fold<D>; 3],
    share: f64,
    particles: usize,
    rng: &mut ChaCha8Rng,
) -> (f64, f64, Measure<D>) {
    let each: Vec<(f64, Measure<D>)> = folds
        .iter()
        .filter_map(|fold| Measure::of_fold(fold, particles, rng.random()))
        .collect();
    let doubtful = |(k, (log, measure)): (usize, &(f64, Measure<D>))| {
        let factor = if k + 1 == folds.len() {
            1.0
        } else {
            share.max(1e-6).recip()
        };
        (*log, (factor * measure.variance).max(f64::MIN_POSITIVE))
    };
    let parts: Vec<(f64, f64)> = each.iter().enumerate().map(doubtful).collect();
    let precision: f64 = parts.iter().map(|(_, variance)| variance.recip()).sum();
    let top = parts.iter().map(|(log, _)| *log).fold(f64::NEG_INFINITY, f64::max);
    let evidences = parts.iter().map(|(log, variance)| (log - top).exp() / variance);
    let log = top + (evidences.sum::<f64>() / precision).ln();
    let squares = parts.iter().map(|(part, variance)| (part - log).powi(2) / variance);
    let inflation = squares.sum::<f64>() / (parts.len().max(2) - 1) as f64;
    let error = (inflation.max(1.0) / precision).sqrt().hypot(disagreement(folds));
    let measures = each.into_iter().map(|(_, measure)| measure);
    let measure = measures.reduce(|all, next| {
        let share = all.variance / (all.variance + next.variance);
        all.mixed(share, next)
    });
    (log, error, measure.unwrap_or_default())
}

/// What separates the folds' estimates of log Z from the fresh points' beyond their own standard errors: √(Δ² − σ²)₊ of the fold that is farther off.
fn disagreement<const D: usize>([first, second, fresh]: [&Fold<D>; 3]) -> f64 {
    let (log_evidence, error) = fresh.log_evidence();
    let excess = [first, second].map(|fold| {
        let (other, other_error) = fold.log_evidence();
        (log_evidence - other).powi(2) - error.powi(2) - other_error.powi(2)
    });
    let excess = excess.into_iter().filter(|excess| excess.is_finite());
    excess.fold(0.0, f64::max).sqrt()
}
