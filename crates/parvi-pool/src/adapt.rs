//! The rounds: two folds of points take turns.

use rand::RngExt;
use rand::rngs::ChaCha8Rng;

use crate::density::Density;
use crate::fold::Fold;
use crate::lanes::LANES;
use crate::learn::{Manner, learn};
use crate::mixture::Mixture;
use crate::options::{Plan, PoolError, Round};
use crate::propose::{Form, best_form, proposal};
use crate::reach::reach;
use crate::scout::{Scouted, scout, wide};
use crate::search::{LIGHTEST, search};
use crate::student::Kernel;

/// Effective share above which another round could gain nothing.
const BEST_SHARE: f64 = 0.8;

/// A round is an advance where its share is larger than all before by this factor; adaptation ends after so many rounds without one.
const ADVANCE: f64 = 1.2;
const PATIENCE: usize = 2;

/// Standard errors by which the folds' log Z may differ.
const AGREEMENT: f64 = 3.0;

/// Rounds before scores are taken: what neighbours alone teach may do.
const UNSHARPENED: usize = 2;

/// Shares of the evaluations that scouts, the walks and the scores of one round, and all rounds together may take.
const SCOUTING: f64 = 0.2;
const WALKING: f64 = 0.05;
const SHARPENING: f64 = 0.02;
const ADAPTING: f64 = 0.75;

/// What is drawn at a time in search of what the rounds have not met: a share of what these took, but no more than a share of all evaluations, unless a share of the
/// effective size that is wanted is more, or the fewest draws are, and at most twice that share of all; times the effort that is asked for. How many times that all searches may take.
const SEARCHING_OF_SPENT: f64 = 1.0 / 3.0;
const SEARCHING: f64 = 0.1;
const SEARCHING_OF_GOAL: f64 = 0.3;
const FEWEST_DRAWS: f64 = 1800.0;
const SEARCHES: u64 = 5;

/// Evaluations of searches that meet nothing new, over those until the last piece was met, without which there may be more.
pub(super) const QUIET: f64 = 2.0;

/// Share of the last effective share that a round must have to be kept.
const NEARLY: f64 = 0.4;

/// The two folds while they adapt.
pub(super) struct Adaptation<const D: usize> {
    pub folds: [Fold<D>; 2],
    /// The rounds so far.
    pub rounds: Vec<Round>,
    /// Form of the last proposal.
    pub form: Option<Form>,
    /// Effective share of the last round.
    pub share: f64,
    /// Effective shares of the folds' rounds.
    pub shares: [Vec<f64>; 2],
    best: f64,
    without_advance: usize,
    /// Evaluations that searches have taken, and those until they last met a piece.
    searched: u64,
    met: u64,
    /// Draws of searches since they last met a piece.
    drawn_in_vain: u64,
    /// Effective sizes before the last round and after it.
    sizes: [f64; 2],
}

impl<const D: usize> Adaptation<D> {
    /// Scouts, and the first points of both folds: of the scouts' proposal, and of those given.
    pub fn begin(
        density: &mut Density<'_, D>,
        given: &[Mixture<D>],
        plan: &Plan,
        rng: &mut ChaCha8Rng,
    ) -> Result<Self, PoolError> {
        let Scouted { proposal, agree } = scout(density, (SCOUTING * plan.evaluations as f64) as u64, rng.random())
            .ok_or_else(|| density.nowhere_finite())?;
        let mut folds = [Fold::new(), Fold::new()];
        let count = if agree { plan.round / 2 } else { plan.first };
        for fold in &mut folds {
            fold.draw(density, proposal.clone(), count / 2, rng.random());
            for proposal in given {
                fold.draw(density, proposal.clone(), count / 4, rng.random());
            }
        }
        let has_mass = |fold: &Fold<D>| fold.log_densities.iter().any(|l| l.is_finite());
        if !folds.iter().all(has_mass) {
            // Scouts may agree on a place that has none.
            let law = Mixture::new(wide()).ok_or_else(|| density.nowhere_finite())?;
            for fold in &mut folds {
                fold.draw(density, law.clone(), plan.first / 2, rng.random());
            }
        }
        if !folds.iter().all(has_mass) {
            return Err(density.nowhere_finite());
        }
        let size = folds.iter().map(Fold::effective_size).sum();
        let shares = folds.each_ref().map(|fold| vec![0.0; fold.rounds.len()]);
        Ok(Self {
            folds,
            rounds: Vec::new(),
            form: None,
            share: 0.0,
            shares,
            best: 0.0,
            without_advance: 0,
            searched: 0,
            met: 0,
            drawn_in_vain: 0,
            sizes: [0.0, size],
        })
    }

    /// Whether further rounds would gain nothing, or must leave what is left of the evaluations to fresh points.
    pub fn is_over(&self, plan: &Plan, spent: u64) -> bool {
        let collapsed = self.sizes[1] < 0.7 * self.sizes[0];
        let in_reach = (plan.goal - self.sizes[1]) < self.share * (plan.evaluations.saturating_sub(spent)) as f64;
        let settled =
            self.share > BEST_SHARE || in_reach && self.without_advance >= PATIENCE || self.sizes[1] > plan.adapted;
        self.is_used_up(plan, spent) || settled && !collapsed && self.agree()
    }

    /// Looks for what the rounds have not met; whether there is something, and the rounds are to go on.
    pub fn search(&mut self, density: &mut Density<'_, D>, plan: &Plan, rng: &mut ChaCha8Rng) -> bool {
        let spent = density.evaluations() - self.searched;
        let most = SEARCHING * plan.evaluations as f64;
        let count = (SEARCHING_OF_SPENT * spent as f64)
            .min(most)
            .max(SEARCHING_OF_GOAL * plan.goal)
            .max(FEWEST_DRAWS)
            .min(2.0 * most);
        let left = ADAPTING * plan.evaluations as f64 - density.evaluations() as f64;
        let count = (plan.search_effort * count).min(left).max(count);
        let count = count as usize / (2 * LANES) * 2 * LANES;
        let met = loop {
            let most = (SEARCHES * count as u64).max(((1.0 + QUIET) * self.met as f64) as u64 + count as u64);
            let allowed = most.saturating_sub(self.searched);
            if allowed < count as u64 || self.is_used_up(plan, density.evaluations()) {
                break false;
            }
            let before = density.evaluations();
            let (drawn, found) = search(&mut self.folds, density, count, allowed, rng);
            self.searched += density.evaluations() - before;
            self.drawn_in_vain += drawn;
            if let Some(found) = found {
                for fold in &mut self.folds {
                    fold.draw(density, found.clone(), plan.round / 4, rng.random());
                }
                // What summits promise, their surroundings need not keep, or were known to.
                let news = self.folds.each_ref().map(Fold::news_of_last);
                if news.iter().any(|&mass| mass >= LIGHTEST) {
                    (self.met, self.drawn_in_vain) = (self.searched, 0);
                    break true;
                }
            }
            if self.quiet() >= QUIET {
                break false;
            }
        };
        self.give_no_share();
        if met {
            (self.best, self.without_advance) = (0.0, 0);
            self.sizes = [0.0, self.folds.iter().map(Fold::effective_size).sum()];
        }
        met
    }

    /// Points far out, where much of the second moments is, and kernels there, with their shares of these.
    pub fn reach(&mut self, density: &mut Density<'_, D>, plan: &Plan, rng: &mut ChaCha8Rng) -> Vec<Kernel<D>> {
        let far = reach(&mut self.folds, density, plan, rng);
        self.give_no_share();
        far
    }

    /// Gives no share to rounds that have none yet: they are not to be frozen by it.
    fn give_no_share(&mut self) {
        for (fold, shares) in self.folds.iter().zip(&mut self.shares) {
            shares.resize(fold.rounds.len(), 0.0);
        }
    }

    /// Evaluations of searches since they last met a piece, over those before; infinite where they met none.
    pub fn quiet(&self) -> f64 {
        let met = self.met as f64;
        if self.met == 0 {
            f64::INFINITY
        } else {
            (self.searched - self.met) as f64 / met
        }
    }

    /// Draws of searches since they last met a piece.
    pub fn drawn_in_vain(&self) -> u64 {
        self.drawn_in_vain
    }

    /// Takes fresh points in after all: they met what the rounds had not.
    pub fn absorb(&mut self, fresh: Fold<D>, share: f64) {
        let side = usize::from(self.folds[1].effective_size() < self.folds[0].effective_size());
        // What was frozen holds the proposals before it and is not to be frozen again with them: no share.
        self.shares[side].extend(fresh.rounds.iter().map(|_| 0.0));
        self.folds[side].absorb(fresh);
        (self.share, self.best, self.without_advance) = (share, 0.0, 0);
        self.sizes = [0.0, self.folds.iter().map(Fold::effective_size).sum()];
    }

    /// Forgets the rounds before the first whose share was nearly as large as the last one's: what few heavy points the others had taught the later proposals too much.
    pub fn forget_beginnings(&mut self) {
        for (fold, shares) in self.folds.iter_mut().zip(&mut self.shares) {
            let enough = NEARLY * shares.last().copied().unwrap_or(0.0);
            let first = shares.iter().position(|&share| share >= enough).unwrap_or(0);
            fold.forget(first);
            shares.drain(..first);
        }
    }

    /// Whether what is left of the evaluations is for fresh points.
    pub fn is_used_up(&self, plan: &Plan, spent: u64) -> bool {
        (spent as f64) + plan.round as f64 > ADAPTING * plan.evaluations as f64
    }

    /// Whether the folds' estimates of log Z differ by no more than their standard errors explain.
    fn agree(&self) -> bool {
        let [(one, one_error), (other, other_error)] = [&self.folds[0], &self.folds[1]].map(Fold::log_evidence);
        (one - other).abs() <= AGREEMENT * one_error.hypot(other_error)
    }

    /// A proposal for each fold from the other's points, and points of it.
    pub fn round(
        &mut self,
        density: &mut Density<'_, D>,
        plan: &Plan,
        rng: &mut ChaCha8Rng,
    ) -> Result<Round, PoolError> {
        let number = self.rounds.len() + 1;
        let sharpening = if number > UNSHARPENED {
            plan.sharpening(self.share, self.sizes[1], SHARPENING)
        } else {
            0
        };
        let manner = Manner {
            hanging: plan.hanging,
            sharpening,
            walking: (0.5 * WALKING * plan.evaluations as f64) as u64,
        };
        let mut share = 0.0;
        for side in 0..2 {
            let proposal = self.proposal(1 - side, manner, density, rng)?;
            let drawn = self.folds[side].draw(density, proposal, plan.round / 2, rng.random());
            self.shares[side].push(drawn);
            share += 0.5 * drawn;
        }
        self.share = share;
        self.without_advance = if share > ADVANCE * self.best {
            0
        } else {
            self.without_advance + 1
        };
        self.best = self.best.max(share);
        self.sizes = [self.sizes[1], self.folds.iter().map(Fold::effective_size).sum()];
        let form = self.form.unwrap_or(Form { kernels: 0, width: 1.0 });
        let round = Round {
            number,
            evaluations: density.evaluations(),
            effective_size: self.sizes[1],
            share,
            kernels: form.kernels,
            width: form.width,
            sharpened: sharpening > 0,
        };
        self.rounds.push(round);
        Ok(round)
    }

    /// A proposal fitted to the points of this fold.
    fn proposal(
        &mut self,
        side: usize,
        manner: Manner,
        density: &mut Density<'_, D>,
        rng: &mut ChaCha8Rng,
    ) -> Result<Mixture<D>, PoolError> {
        let mut learned = learn(&[&self.folds[side]], manner, density, rng);
        let form = best_form(&learned.sample, self.form, manner.sharpening > 0, rng);
        learned.sample.join(learned.level);
        self.form = Some(form);
        proposal(&learned.sample, form, rng).ok_or_else(|| density.nowhere_finite())
    }
}
