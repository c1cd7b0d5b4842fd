//! Ranges of options, and which of them need or exclude each other.

use super::{AlphaSchedule, Basis, Limit, MethodName, MethodOptions, OptionError, PoolChoice, Transfer};

/// An option, one that it does not go with, and what is to be said behind its value.
const EXCLUDED: [(&str, &str, &str); 11] = [
    ("alpha-from", "alpha", "contradicts a constant alpha"),
    ("alpha-to", "alpha", "contradicts a constant alpha"),
    ("start-law", "start", "contradicts --start"),
    ("start-centre", "start", "contradicts --start"),
    ("start-centre", "start-law", "contradicts --start-law"),
    ("start-mean", "start", "contradicts --start"),
    ("start-mean", "start-law", "contradicts --start-law"),
    ("start-mean", "start-centre", "contradicts --start-centre"),
    ("start-sd", "start", "contradicts --start"),
    ("start-sd", "start-law", "contradicts --start-law"),
    ("start-sd", "start-centre", "contradicts --start-centre"),
];

/// An option, one without which it says nothing, and what is to be said behind its value.
const NEEDED: [(&str, &str, &str); 4] = [
    (
        "alpha-schedule",
        "alpha-from",
        "needs alpha-from and alpha-to beside it",
    ),
    ("alpha-from", "alpha-to", "needs alpha-to beside it"),
    ("alpha-to", "alpha-from", "needs alpha-from beside it"),
    ("start-covariance", "start-centre", "needs --start-centre beside it"),
];

/// Options with spaces between, when they are out of place, and what is to be said behind their values.
type Rule = (&'static str, fn(&MethodOptions) -> bool, &'static str);

/// Of all methods.
const RULES: [Rule; 4] = [
    (
        "mesh",
        |given| given.basis != Some(Basis::Mesh),
        "needs the basis `mesh`",
    ),
    (
        "alpha-to",
        |given| given.has_ends_of_both_signs(),
        "must have the sign of alpha-from in a geometric schedule, and neither may be 0",
    ),
    (
        "alpha-cycles",
        |given| given.alpha_schedule != Some(AlphaSchedule::Cyclic),
        "needs the alpha-schedule `cyclic`",
    ),
    (
        "volumes",
        |given| given.start.is_some() && given.volumes_of_start(),
        "needs a start law, which a file of positions does not have",
    ),
];

/// Of the calibrated gas.
const RULES_OF_GAS: [Rule; 9] = [
    (
        "flip-share",
        |given| !matches!(given.transfer, Some(Transfer::Flip | Transfer::AffineFlip)),
        "needs the transfer `flip` or `affine-flip`",
    ),
    (
        "start start-law start-centre",
        MethodOptions::surveys,
        "needs --survey off: a survey says where the particles begin",
    ),
    ("evaluations pool", |given| !given.surveys(), "needs a survey"),
    (
        "rounds",
        |given| !given.surveys() && given.rounds.is_some_and(|rounds| rounds.get() == 0),
        "needs a survey",
    ),
    // A score that drives the gas away.
    ("alpha", |given| given.alpha <= Some(0.0), "must be a number above 0"),
    (
        "alpha-from",
        |given| given.alpha_from <= Some(0.0),
        "must be a number above 0",
    ),
    (
        "alpha-to",
        |given| given.alpha_to <= Some(0.0),
        "must be a number above 0",
    ),
    (
        "basis",
        |given| given.basis == Some(Basis::Mesh) && given.mesh.is_none(),
        "needs --mesh FILE.msh beside it",
    ),
    (
        "displacement-limit",
        |given| given.displacement_limit == Some(Limit::Off),
        "does not fit method `mpm`",
    ),
];

/// Of Stein thinning: options of the chains.
const RULES_OF_THINNING: [Rule; 1] = [(
    "warm-up chains thinning target-acceptance start-mean start-sd start-draws",
    |given| !matches!(given.pool_choice(), Ok(Some(PoolChoice::Nuts))),
    "needs the pool `nuts`",
)];

impl MethodOptions {
    /// Refuses numbers outside of their range.
    pub(super) fn check_ranges(&self) -> Result<(), OptionError> {
        for (name, value, (holds, expected)) in self.ranged() {
            if let Some(value) = value
                && !holds(value)
            {
                return Err(OptionError::out_of_range(&name, value, expected));
            }
        }
        Ok(())
    }

    /// Refuses options that need or exclude each other.
    pub(super) fn check_rules(&self, method: MethodName) -> Result<(), OptionError> {
        let given: Vec<(String, String)> = self.given().collect();
        let value = |option: &str| given.iter().find(|(name, _)| name == option).map(|(_, value)| value);
        let refuse = |option: &str, reason: &str| match value(option) {
            Some(value) => Err(OptionError::new(option, format!("{value} {reason}"))),
            None => Ok(()),
        };
        for (option, other, reason) in EXCLUDED {
            value(other).map_or(Ok(()), |_| refuse(option, reason))?;
        }
        for (option, other, reason) in NEEDED {
            value(other).map_or_else(|| refuse(option, reason), |_| Ok(()))?;
        }
        let of_method: &[Rule] = match method {
            MethodName::Mpm => &RULES_OF_GAS,
            MethodName::SteinThinning => &RULES_OF_THINNING,
            _ => &[],
        };
        for (options, broken, reason) in RULES.iter().chain(of_method) {
            for option in options.split(' ').filter(|_| broken(self)) {
                refuse(option, reason)?;
            }
        }
        Ok(())
    }

    /// Whether a geometric schedule would have to pass 0.
    fn has_ends_of_both_signs(&self) -> bool {
        let is_geometric = matches!(self.alpha_schedule, None | Some(AlphaSchedule::Geometric));
        let apart = |(from, to): (f64, f64)| from == 0.0 || to == 0.0 || from.signum() != to.signum();
        is_geometric && self.alpha_from.zip(self.alpha_to).is_some_and(apart)
    }
}
