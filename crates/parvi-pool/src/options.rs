//! What a pool is asked for, and what it says on the way.

/// Options of a pool.
#[derive(Clone, Debug, PartialEq)]
pub struct PoolOptions {
    /// Evaluations of all kinds (log densities and scores) that are planned with, ≥ 1. By default 15, 25, 45, 80, 140 or 200 per particle in d = 1…6 and above and at least 8,000,
    /// and as long as there is an [`Objection`](crate::Objection) twice as many again, up to 200 per particle and at least 20,000.
    ///
    /// Rounds and fresh points keep to them. What a pool begins with is evaluated in any case: 375 log densities per dimension and ¾ per particle, half as many more for each proposal that is
    /// given, and scouts before them; and searches that meet piece after piece are not cut short.
    pub evaluations: Option<u64>,
    /// Effective size at which the pool is large enough, per particle, but at least 2,000 in all.
    pub effective_size: f64,
    /// How many times as much is drawn in search of pieces that no proposal has met, as far as the evaluations last: ≥ 1.
    pub search_effort: f64,
}

impl Default for PoolOptions {
    fn default() -> Self {
        Self {
            evaluations: None,
            effective_size: 7.5,
            search_effort: 1.0,
        }
    }
}

/// Effective size below which tails are met too seldom for their errors to be known.
const LEAST_SIZE: f64 = 2000.0;

/// Effective share of a proposal that curvature would hardly better.
const GOOD_SHARE: f64 = 0.6;

/// Share of what scores can spare that they may cost.
const SHARPENING: f64 = 0.4;

/// Kernels that scores sharpen at least, if any.
const FEWEST_KERNELS: usize = 20;

/// Sizes that follow from the options.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plan {
    pub evaluations: u64,
    /// What these may be extended to.
    pub most: u64,
    /// Points of the first proposal, and of every round.
    pub first: usize,
    pub round: usize,
    /// Fresh points at least.
    pub referee: usize,
    /// Scores that are worth taking.
    pub fewest_scores: usize,
    /// Effective size at which adaptation ends, and the whole ends.
    pub adapted: f64,
    pub goal: f64,
    pub search_effort: f64,
    /// Whether a pool was met whose second moments hang on few points.
    pub hanging: bool,
}

impl PoolOptions {
    /// Sizes for this many particles.
    pub(super) fn plan<const D: usize>(&self, particles: usize) -> Result<Plan, PoolError> {
        let check = |field, value: f64, allowed: bool, expected| {
            if allowed {
                Ok(())
            } else {
                Err(PoolError::InvalidOption { field, value, expected })
            }
        };
        check(
            "particles",
            particles as f64,
            particles >= 2 && u32::try_from(particles).is_ok(),
            "from 2 to 2^32 - 1",
        )?;
        check("evaluations", 0.0, self.evaluations != Some(0), "at least 1")?;
        let size = self.effective_size;
        check(
            "effective size",
            size,
            size > 0.0 && size.is_finite(),
            "positive and finite",
        )?;
        let effort = self.search_effort;
        check(
            "search effort",
            effort,
            effort >= 1.0 && effort.is_finite(),
            "at least 1 and finite",
        )?;
        check("dimensions", D as f64, (1..=19).contains(&D), "from 1 to 19")?;
        let per_particle = [10, 15, 25, 45, 80, 140, 200][D.min(6)];
        let default = (per_particle * particles as u64).max(8_000);
        let most = (200 * particles as u64).max(20_000);
        let round = 250 * D + particles / 2;
        let goal = (size * particles as f64).max(LEAST_SIZE);
        Ok(Plan {
            evaluations: self.evaluations.unwrap_or(default),
            most: self.evaluations.unwrap_or(most),
            first: round * 3 / 2,
            round,
            referee: round,
            fewest_scores: FEWEST_KERNELS * (D + 1),
            adapted: 0.5 * goal,
            goal,
            search_effort: effort,
            hanging: false,
        })
    }
}

impl Plan {
    /// Twice as many evaluations, as far as there may be more; where second moments hang on few points, for an effective size that is twice as large.
    pub(super) fn extend(&mut self, hanging: bool) -> bool {
        if hanging {
            self.hanging = true;
            self.adapted *= 2.0;
            self.goal *= 2.0;
        }
        let before = self.evaluations;
        self.evaluations = before.saturating_mul(2).min(self.most);
        self.evaluations > before
    }

    /// Scores that may be taken before the next proposal, at most this share of all: a part of what the effective size that is lacking would cost at
    /// the present share beyond what it would cost at a good one.
    pub(super) fn sharpening(&self, share: f64, size: f64, most: f64) -> usize {
        let lacking = (self.goal - size).max(0.0);
        let cost = lacking * (1.0 / share.max(1e-3) - 1.0 / GOOD_SHARE);
        let scores = (SHARPENING * cost).min(most * self.evaluations as f64);
        if scores < self.fewest_scores as f64 {
            0
        } else {
            scores as usize
        }
    }
}

/// A round of a pool.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Round {
    /// Number, from 1.
    pub number: usize,
    /// Evaluations so far, of all kinds.
    pub evaluations: u64,
    /// Effective size after the round.
    pub effective_size: f64,
    /// Effective size of the round's points alone over their number.
    pub share: f64,
    /// Kernels of a proposal.
    pub kernels: usize,
    /// Their width over the fitted one.
    pub width: f64,
    /// Whether scores sharpened the kernels.
    pub sharpened: bool,
}

/// Why there is no pool.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PoolError {
    /// An option is outside its range.
    #[error("{field} = {value}: must be {expected}")]
    InvalidOption {
        /// The option's name.
        field: &'static str,
        /// The value given.
        value: f64,
        /// What is allowed.
        expected: &'static str,
    },
    /// Of the first points too few have a log density to count with, which is between ±1e15: none, as a rule.
    #[error("{}", nowhere_finite(*.points, *.finite, *.undefined, *.beyond))]
    NowhereFinite {
        /// Points at which it was evaluated.
        points: u64,
        /// Those of them at which it was between ±1e15.
        finite: u64,
        /// Those at which it was NaN, +∞ or above 1e15.
        undefined: u64,
        /// Those at which it was a number below −1e15, which counts as −∞; at the others it was −∞.
        beyond: u64,
        /// Points at which the score was evaluated.
        scores: u64,
    },
    /// The values of an earlier process are not those of the target: some of its points, evaluated again, differ.
    #[error("the values that an earlier process left are those of another target")]
    AnotherTape,
    /// The observer stopped the exploration.
    #[error("interrupted after round {round}")]
    Interrupted {
        /// Rounds done.
        round: usize,
    },
}

/// What the log density was at the points.
fn nowhere_finite(points: u64, finite: u64, undefined: u64, beyond: u64) -> String {
    let zero = points.saturating_sub(finite + undefined + beyond);
    let found = if zero == points {
        format!("log p was -inf at all {points} points")
    } else if beyond == points {
        format!("log p was below -1e15, which counts as -inf, at all {points} points")
    } else {
        let beyond = match beyond {
            0 => String::new(),
            beyond => format!("below -1e15, which counts as -inf, at {beyond}, "),
        };
        format!(
            "log p was -inf at {zero}, {beyond}NaN or +inf at {undefined} and finite at {finite} of {points} points: too few to begin with"
        )
    };
    format!("{found}; the frame is to say where the mass lies and how wide it is")
}
