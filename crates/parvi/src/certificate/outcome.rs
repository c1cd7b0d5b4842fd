//! How a run ended, and why.

use std::fmt;

/// Error of a score over the size of differences of log p from which on these are called zero beside it.
const FLAT: f64 = 1e4;

/// How a run ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// Fresh importance weights vouch for the evidence, and the pool for every mean and standard deviation of the particles.
    Converged,
    /// The particles are at rest, but something speaks against them or nothing speaks for them.
    Stalled(Doubt),
    /// The steps were used up while the particles were still on their way.
    BudgetExhausted {
        /// [`Certificate::drift`](super::Certificate::drift).
        drift: f64,
    },
}

/// What keeps particles at rest from being called converged. Axes count from 1.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Doubt {
    /// The scores say that the mean may be off.
    #[error("the mean of x{axis} may be off by {}", in_deviations(*.error))]
    Mean {
        /// Axis.
        axis: usize,
        /// By how much, in standard deviations.
        error: f64,
    },
    /// The scores say that the standard deviation may be off.
    #[error("the standard deviation of x{axis} may be off by {}", in_percent(*.error))]
    StandardDeviation {
        /// Axis.
        axis: usize,
        /// By how much, relative to it.
        error: f64,
    },
    /// The scores leave so much of a coordinate or its square unexplained that its mean or spread may be off unnoticed.
    #[error("the scores cannot vouch for the mean and spread of x{axis}: a share of {share:.2} is unexplained")]
    Unexplained {
        /// Axis.
        axis: usize,
        /// Standard deviation of what is left, in units of what would be seen.
        share: f64,
    },
    /// The score is not the gradient of the log density, by differences of this; only searches have followed it.
    #[error("the score is not the gradient of log p: differences of log p {}", beside_a_score(*.error))]
    Score {
        /// By how much, over the size of the differences; huge where log p is flat about nearly all points, as one that is rounded.
        error: f64,
    },
    /// The score is not finite where log p is; only searches have followed it.
    #[error("the score is NaN or infinite where log p is finite, at points of the pool ({points} of {of})")]
    NoScore {
        /// Points of the pool at which it is not.
        points: usize,
        /// Points that were looked at.
        of: usize,
    },
    /// The log density is not a function of the point, but noise, or depends on something else.
    #[error(
        "log p is not a function of the point: evaluated once more it differs at {points} of {of} points, by up to {largest:.3}"
    )]
    AnotherValue {
        /// Points at which it differs by more than rounding explains.
        points: usize,
        /// Points at which it was evaluated once more.
        of: usize,
        /// The largest difference, infinite where it is no number any more.
        largest: f64,
    },
    /// Along rays through points of the pool r^D p does not fall off, r the distance: the density may be improper.
    #[error(
        "log p does not fall off along {rays} of {of} rays, up to a thousand times the distance of particles: its mass lies farther away, or it is improper, without a finite integral"
    )]
    Endless {
        /// Rays along which it does not.
        rays: usize,
        /// Rays that were looked along.
        of: usize,
    },
    /// Along rays through points of the pool r^(D + 2) p does not fall off, r the distance: variances are infinite, or mass much farther away than particles decides them.
    #[error(
        "standard deviations may not exist: along {rays} of {of} rays the square of the distance outweighs the fall of p, up to a thousand times the distance of particles"
    )]
    Spreadless {
        /// Rays along which it does not.
        rays: usize,
        /// Rays that were looked along.
        of: usize,
    },
    /// The residual is above that of independent draws.
    #[error("the residual is {ratio:.2} of that of independent draws")]
    Residual {
        /// Residual over that of independent draws.
        ratio: f64,
    },
    /// The importance weights have a tail that no estimate can rest on.
    #[error("the importance weights have a heavy tail, of shape {pareto_k:.2}, and more may have been missed")]
    HeavyTail {
        /// Shape k̂ of the tail.
        pareto_k: f64,
    },
    /// The log evidence is uncertain.
    #[error("the log evidence has a standard error of {error:.2}")]
    Evidence {
        /// Its standard error.
        error: f64,
    },
    /// The pool is too small for so many particles.
    #[error("the weighted pool has {variance:.2} of the variance of as many independent draws as there are particles")]
    Noise {
        /// Its variance over that of as many independent draws as there are particles.
        variance: f64,
    },
    /// Too few points carry the second moment of a coordinate for its standard error to be known: [`Objection::Hanging`](parvi_pool::Objection::Hanging).
    #[error("the standard deviation of x{axis} hangs on few points: {:.1} % of the effective size of the pool, and there may be more of the tail", 100.0 * .share)]
    Hangs {
        /// Axis.
        axis: usize,
        /// [`Estimate::carriers`](parvi_pool::Estimate::carriers) over the effective size.
        share: f64,
    },
    /// Fresh points met what no kernel had covered.
    #[error("fresh points met a mass of {mass:.3} that nothing had covered before, and more may have been missed")]
    Uncovered {
        /// Its mass.
        mass: f64,
    },
    /// The log density is no number at many points.
    #[error("at {:.0} % of fresh points the log density was NaN or +∞: what mass is there, nobody knows", 100.0 * .share)]
    Undefined {
        /// Share of fresh points at which it is NaN or +∞.
        share: f64,
    },
    /// Independent parts of the pool are too far apart.
    #[error(
        "independent parts of the pool are {ratio:.1} times as far apart as their weights explain: one of them has missed what the others met"
    )]
    Inconsistent {
        /// Their distance over what their weights explain.
        ratio: f64,
    },
    /// Searches still met pieces of late.
    #[error(
        "searches for other pieces ended after {quiet:.1} times the evaluations until the last piece was met: there may be more"
    )]
    Searching {
        /// Evaluations since the last piece was met, over those before.
        quiet: f64,
    },
    /// Nothing has looked for other pieces of the target, of which the particles would know nothing.
    #[error("without a survey nothing has looked for other pieces of the target")]
    NotSurveyed,
    /// A survey has met nothing that could be weighed; a body without one has moved from the start.
    #[error(
        "{evaluations} evaluations met nothing that could be weighed, and the particles are those of a body without a survey: begin nearer to the mass"
    )]
    SurveyInVain {
        /// Evaluations of the survey.
        evaluations: u64,
    },
    /// Nothing has kept the particles where the target has mass: the score does not lead there.
    #[error(
        "log p is -inf or no number at particles ({particles} of {of}): where it is, the score does not lead to the mass"
    )]
    Outside {
        /// Particles at which log p is −∞, +∞ or NaN.
        particles: usize,
        /// Particles.
        of: usize,
    },
    /// The particles stand for p^α, and the scores judge p.
    #[error("the particles stand for the density to the power of {alpha}, and the scores judge the density itself")]
    Tempered {
        /// α of the last steps.
        alpha: f64,
    },
}

/// What differences of log p are beside a score with this error, over their size.
fn beside_a_score(error: f64) -> String {
    match error < FLAT {
        true => format!("say that it is {:.0} % off", 100.0 * error),
        false => "are as good as zero where it is not".to_owned(),
    }
}

/// An error of a mean in words.
fn in_deviations(error: f64) -> String {
    match error.is_finite() {
        true => format!("{error:.3} standard deviations"),
        false => UNKNOWN.to_owned(),
    }
}

/// A relative error in words.
fn in_percent(error: f64) -> String {
    match error.is_finite() {
        true => format!("{:.1} %", 100.0 * error),
        false => UNKNOWN.to_owned(),
    }
}

/// What is said of an error that is no number.
const UNKNOWN: &str = "an amount that nobody knows: what estimates it is no number";

impl Doubt {
    /// The axis that it is about, from 1, if it is about one.
    pub fn axis(&self) -> Option<usize> {
        match self {
            Self::Mean { axis, .. } | Self::StandardDeviation { axis, .. } | Self::Unexplained { axis, .. } => {
                Some(*axis)
            }
            _ => None,
        }
    }

    /// The same in words with the name of the axis, where there is one for it, in the place of its number.
    pub fn naming(&self, names: &[String]) -> String {
        let text = self.to_string();
        let known = self
            .axis()
            .and_then(|axis| Some((axis, names.get(axis.checked_sub(1)?)?)));
        known.map_or(text.clone(), |(axis, name)| {
            text.replacen(&format!(" of x{axis}"), &format!(" of {name}"), 1)
        })
    }
}

impl Outcome {
    /// By the drift and by what else speaks against the particles.
    pub(crate) fn of(drift: f64, doubt: Option<Doubt>) -> Self {
        if super::exceeds(drift, super::LARGEST_DRIFT) {
            Self::BudgetExhausted { drift }
        } else {
            doubt.map_or(Self::Converged, Self::Stalled)
        }
    }

    /// `converged`, `stalled` or `budget exhausted`.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Converged => "converged",
            Self::Stalled(_) => "stalled",
            Self::BudgetExhausted { .. } => "budget exhausted",
        }
    }

    /// Why it is not `converged`.
    pub fn reason(&self) -> Option<String> {
        self.reason_naming(&[])
    }

    /// The same with the coordinates' names, as far as they are given.
    pub fn reason_naming(&self, names: &[String]) -> Option<String> {
        match self {
            Self::Converged => None,
            Self::Stalled(doubt) => Some(doubt.naming(names)),
            Self::BudgetExhausted { drift } => Some(format!(
                "the particles still moved at the end, by {drift:.2} standard deviations"
            )),
        }
    }
}

/// As the key `outcome` of `parvi sample` has it: the [`name`](Outcome::name), without the [`reason`](Outcome::reason).
impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_doubt_about_an_axis_has_its_name_and_no_infinity() {
        let doubt = Outcome::Stalled(Doubt::StandardDeviation { axis: 2, error: 0.25 });
        let names = ["intercept", "x1"].map(str::to_owned);
        let reason = |names: &[String]| doubt.reason_naming(names).unwrap();
        assert_eq!(reason(&names), "the standard deviation of x1 may be off by 25.0 %");
        assert_eq!(reason(&names[..1]), "the standard deviation of x2 may be off by 25.0 %");
        let error = f64::INFINITY;
        for doubt in [
            Doubt::Mean { axis: 1, error },
            Doubt::StandardDeviation { axis: 1, error },
        ] {
            let text = doubt.naming(&names);
            assert!(
                text.contains("of intercept may be off by an amount") && !text.contains("inf "),
                "{text}"
            );
        }
    }

    #[test]
    fn a_score_beside_a_flat_log_density_has_no_infinite_error() {
        let reason = |error: f64| Doubt::Score { error }.to_string();
        assert!(reason(2.0).ends_with("say that it is 200 % off"), "{}", reason(2.0));
        for error in [1e5, 1.0 / f64::MIN_POSITIVE, f64::INFINITY] {
            assert!(
                reason(error).ends_with("are as good as zero where it is not"),
                "{}",
                reason(error)
            );
        }
    }

    #[test]
    fn an_outcome_is_written_as_its_name() {
        let stalled = Outcome::Stalled(Doubt::Evidence { error: 0.5 });
        let exhausted = Outcome::BudgetExhausted { drift: 0.1 };
        let written = [Outcome::Converged, stalled.clone(), exhausted].map(|outcome| outcome.to_string());
        assert_eq!(written, ["converged", "stalled", "budget exhausted"]);
        assert_eq!(format!("{stalled:>9}"), "  stalled");
        let reason = stalled.reason();
        assert_eq!(reason.as_deref(), Some("the log evidence has a standard error of 0.50"));
    }
}
