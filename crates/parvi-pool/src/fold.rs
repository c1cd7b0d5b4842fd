//! Points, their log densities, and the density of everything that drew them.

use crate::density::Density;
use crate::lanes::{Group, LANES, Lanes, packed};
use crate::mixture::Mixture;
use crate::weights::{effective_size, tempered, top};

/// Share of a sum of densities up to which what is forgotten is taken away from it; more of it would leave rounding, and the sum is taken anew.
const MOST_GONE: f64 = 0.99;

/// Points that one series of proposals drew, weighed by the mixture of all of these (deterministic mixture weights).
///
/// With n_t points of proposal q_t and N = Σ n_t, a point weighs p(x) / Σ_t (n_t/N) q_t(x): A. B. Owen, Y. Zhou, *Safe and effective importance
/// sampling*, J. Am. Stat. Assoc. 95, 2000; J.-M. Cornuet, J.-M. Marin, A. Mira, C. P. Robert, *Adaptive multiple importance sampling*, Scand. J. Stat. 39, 2012.
#[derive(Clone, Debug, Default)]
pub(super) struct Fold<const D: usize> {
    pub positions: Vec<[f64; D]>,
    /// log p; −∞ where it is not a number to count with.
    pub log_densities: Vec<f64>,
    /// Σ_t n_t q_t(x).
    sums: Vec<Lanes>,
    groups: Vec<Group<D>>,
    pub rounds: Vec<(usize, Mixture<D>)>,
}

impl<const D: usize> Fold<D> {
    pub fn new() -> Self {
        Self::default()
    }

    /// Draws about `count` points (whole groups) from a proposal, evaluates and adds them. Returns the effective size of the new points alone,
    /// weighed by their own proposal alone, over their number.
    pub fn draw(&mut self, density: &mut Density<'_, D>, proposal: Mixture<D>, count: usize, seed: u64) -> f64 {
        let count = count.div_ceil(LANES) * LANES;
        let points = proposal.draws(count, seed);
        let values = density.log_densities(&points);
        let groups = packed(&points);
        let count = points.len() as f64;
        proposal.add_density(&self.groups, count, &mut self.sums);
        let mut own = proposal.densities(&groups);
        let solo = log_ratios(&values, &own);
        for value in own.as_flattened_mut() {
            *value *= count;
        }
        self.add_density(&groups, 1.0, &mut own);
        self.rounds.push((points.len(), proposal));
        self.positions.extend(points);
        self.log_densities.extend(values);
        self.groups.extend(groups);
        self.sums.extend(own);
        effective_size(&tempered(&solo, 1.0)) / count.max(1.0)
    }

    /// Adds `factor` · Σ_t n_t q_t(x) to `sums` for every point.
    pub fn add_density(&self, groups: &[Group<D>], factor: f64, sums: &mut [Lanes]) {
        add_densities(&self.rounds, groups, factor, sums);
    }

    /// log p(x) − log Σ_t n_t q_t(x): their exponentials sum to the estimate of the evidence.
    pub fn log_weights(&self) -> Vec<f64> {
        log_ratios(&self.log_densities, &self.sums)
    }

    /// q(x) / Σ_t n_t q_t(x) at every point: weights under which the points stand for q.
    pub fn weights_of(&self, q: &Mixture<D>) -> Vec<f64> {
        let densities = q.densities(&self.groups);
        let pairs = densities.as_flattened().iter().zip(self.sums.as_flattened());
        pairs.map(|(q, sum)| q / sum.max(f64::MIN_POSITIVE)).collect()
    }

    /// What the points before knew too little of: the mass m where more than half of the density that points were drawn from is that of the last proposal,
    /// times its relative standard error before these, m/√(1 + n), n the effective size of the earlier points there.
    pub fn news_of_last(&self) -> f64 {
        let Some((count, last)) = self.rounds.last() else {
            return 0.0;
        };
        let weights = tempered(&self.log_weights(), 1.0);
        let densities = last.densities(&self.groups);
        let (earlier, count) = (self.positions.len() - count, *count as f64);
        let (mut mass, mut before) = (0.0, Vec::new());
        let pairs = densities.as_flattened().iter().zip(self.sums.as_flattened());
        for (index, ((q, sum), weight)) in pairs.zip(&weights).enumerate() {
            let own = count * q / sum;
            if own > 0.5 {
                mass += weight;
                if index < earlier {
                    before.push(weight / (1.0 - own).max(f64::EPSILON));
                }
            }
        }
        mass / weights.iter().sum::<f64>() / (1.0 + effective_size(&before)).sqrt()
    }

    /// The fitted kernels of the last proposal that has any.
    pub fn core(&self) -> Option<Mixture<D>> {
        self.rounds.iter().rev().find_map(|(_, proposal)| proposal.core())
    }

    /// Takes the points and the proposals of another fold in.
    pub fn absorb(&mut self, mut other: Self) {
        self.add_density(&other.groups, 1.0, &mut other.sums);
        other.add_density(&self.groups, 1.0, &mut self.sums);
        self.positions.extend(other.positions);
        self.log_densities.extend(other.log_densities);
        self.groups.extend(other.groups);
        self.sums.extend(other.sums);
        self.rounds.extend(other.rounds);
    }

    /// Forgets the first rounds, their points and their proposals.
    pub fn forget(&mut self, rounds: usize) {
        let forgotten: Vec<(usize, Mixture<D>)> = self.rounds.drain(..rounds).collect();
        let points: usize = forgotten.iter().map(|(count, _)| count).sum();
        self.positions.drain(..points);
        self.log_densities.drain(..points);
        self.groups.drain(..points / LANES);
        self.sums.drain(..points / LANES);
        let kernels = |rounds: &[(usize, Mixture<D>)]| rounds.iter().map(|(_, q)| q.kernels().len()).sum::<usize>();
        let anew: Vec<usize> = if kernels(&forgotten) < kernels(&self.rounds) {
            let mut gone = vec![[0.0; LANES]; self.groups.len()];
            add_densities(&forgotten, &self.groups, 1.0, &mut gone);
            let are_left =
                |sums: &Lanes, gone: &Lanes| sums.iter().zip(gone).all(|(sum, gone)| *gone < MOST_GONE * sum);
            let anew = (0..gone.len()).filter(|&index| !are_left(&self.sums[index], &gone[index]));
            let anew = anew.collect();
            let pairs = self.sums.as_flattened_mut().iter_mut().zip(gone.as_flattened());
            pairs.for_each(|(sum, gone)| *sum -= gone);
            anew
        } else {
            (0..self.groups.len()).collect()
        };
        let groups: Vec<Group<D>> = anew.iter().map(|&index| self.groups[index]).collect();
        let mut sums = vec![[0.0; LANES]; groups.len()];
        self.add_density(&groups, 1.0, &mut sums);
        for (index, sums) in anew.into_iter().zip(sums) {
            self.sums[index] = sums;
        }
    }

    /// log Z by the weights of this fold, and its standard error.
    pub fn log_evidence(&self) -> (f64, f64) {
        let logs = self.log_weights();
        let weights = tempered(&logs, 1.0);
        let sum: f64 = weights.iter().sum();
        let squares: f64 = weights.iter().map(|w| w * w).sum();
        let variance = (squares / (sum * sum) - 1.0 / weights.len() as f64).max(0.0);
        (top(&logs) + sum.ln(), variance.sqrt())
    }

    /// The effective size of all weights.
    pub fn effective_size(&self) -> f64 {
        effective_size(&tempered(&self.log_weights(), 1.0))
    }
}

/// Adds `factor` · Σ_t n_t q_t(x) of some rounds to `sums` for every point.
fn add_densities<const D: usize>(rounds: &[(usize, Mixture<D>)], groups: &[Group<D>], factor: f64, sums: &mut [Lanes]) {
    for (count, proposal) in rounds {
        proposal.add_density(groups, factor * *count as f64, sums);
    }
}

/// Points, log densities and log weights of several folds; each estimates Z by itself, and they count by their effective sizes.
pub(super) fn joined<const D: usize>(folds: &[&Fold<D>]) -> (Vec<[f64; D]>, Vec<f64>, Vec<f64>) {
    let sizes: Vec<f64> = folds.iter().map(|fold| fold.effective_size()).collect();
    let total: f64 = sizes.iter().sum();
    let (mut points, mut values, mut logs) = (Vec::new(), Vec::new(), Vec::new());
    for (fold, size) in folds.iter().zip(sizes) {
        let share = (size / total).ln();
        points.extend_from_slice(&fold.positions);
        values.extend_from_slice(&fold.log_densities);
        logs.extend(fold.log_weights().iter().map(|log| log + share));
    }
    (points, values, logs)
}

/// log p − log q, −∞ where p vanishes.
fn log_ratios(logs: &[f64], densities: &[Lanes]) -> Vec<f64> {
    let ratio = |(log, density): (&f64, &f64)| log - density.max(f64::MIN_POSITIVE).ln();
    logs.iter().zip(densities.as_flattened()).map(ratio).collect()
}
