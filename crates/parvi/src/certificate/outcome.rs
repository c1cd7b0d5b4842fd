//! How a run ended, and why.

use std::fmt;

/// How a run ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// The particles are at rest, and the scores vouch for every mean and standard deviation.
    Converged,
    /// The particles are at rest, but something speaks against them or nothing speaks for them.
    Stalled(Doubt),
    /// The steps were used up while the particles were still on their way.
    BudgetExhausted {
        /// What the mean or the spread still changed by over the last tenth of the steps, in standard deviations.
        drift: f64,
    },
}

/// What keeps particles at rest from being called converged. Axes count from 1.
#[derive(Clone, Debug, PartialEq)]
pub enum Doubt {
    /// The scores say that the mean may be off.
    Mean {
        /// Axis.
        axis: usize,
        /// By how much, in standard deviations.
        error: f64,
    },
    /// The scores say that the standard deviation may be off.
    StandardDeviation {
        /// Axis.
        axis: usize,
        /// By how much, relative to it.
        error: f64,
    },
    /// The scores leave so much of a coordinate or its square unexplained that its mean or spread may be off unnoticed.
    Unexplained {
        /// Axis.
        axis: usize,
        /// Standard deviation of what is left, in units of what would be seen.
        share: f64,
    },
    /// The residual is above that of independent draws.
    Residual {
        /// Residual over that of independent draws.
        ratio: f64,
    },
    /// The masses of separate pieces are uncertain.
    Masses {
        /// Standard error that they bring into a mean, in standard deviations.
        error: f64,
    },
    /// Nothing has looked for other pieces of the target, of which the particles would know nothing.
    NotSurveyed,
    /// Pieces of the target have no particles, since there are too few.
    LeftOut {
        /// The mass of these pieces.
        mass: f64,
    },
    /// The particles stand for p^α, and the scores judge p.
    Tempered {
        /// α of the last steps.
        alpha: f64,
    },
}

impl Outcome {
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
        match self {
            Self::Converged => None,
            Self::Stalled(doubt) => Some(doubt.to_string()),
            Self::BudgetExhausted { drift } => Some(format!(
                "the particles still moved by {drift:.2} standard deviations over the last tenth of the steps"
            )),
        }
    }
}

impl fmt::Display for Doubt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Mean { axis, error } => {
                write!(f, "the mean of x{axis} may be off by {error:.3} standard deviations")
            }
            Self::StandardDeviation { axis, error } => write!(
                f,
                "the standard deviation of x{axis} may be off by {:.1} %",
                100.0 * error
            ),
            Self::Unexplained { axis, share } => write!(
                f,
                "the scores cannot vouch for the mean and spread of x{axis}: a share of {share:.2} is unexplained"
            ),
            Self::Residual { ratio } => write!(f, "the residual is {ratio:.2} of that of independent draws"),
            Self::Masses { error } => write!(
                f,
                "the masses of separate pieces leave a standard error of {error:.3} standard deviations in a mean"
            ),
            Self::NotSurveyed => write!(f, "without a survey nothing has looked for other pieces of the target"),
            Self::LeftOut { mass } => write!(
                f,
                "pieces of the target with a mass of {mass:.3} have no particles, since there are too few"
            ),
            Self::Tempered { alpha } => write!(
                f,
                "the particles stand for the density to the power of {alpha}, and the scores judge the density itself"
            ),
        }
    }
}
