//! Ranges of options, and which of them need or exclude each other.

use super::{AlphaSchedule, Basis, Limit, MethodName, MethodOptions, OptionError, Transfer};

/// A range for numbers.
type Range = (fn(f64) -> bool, &'static str);
const POSITIVE: Range = (|x| x > 0.0 && x.is_finite(), "a number above 0");
const NOT_NEGATIVE: Range = (|x| x >= 0.0 && x.is_finite(), "a number of at least 0");
const FINITE: Range = (f64::is_finite, "a finite number");
const SHARE: Range = (|x| (0.0..=1.0).contains(&x), "from 0 to 1");
const RATIO: Range = (|x| x >= 1.0 && x.is_finite(), "a number of at least 1");
const ABOVE_ONE: Range = (|x| x > 1.0 && x.is_finite(), "a number above 1");
const BELOW_ONE: Range = (|x| (0.0..1.0).contains(&x), "at least 0 and below 1");
const BETWEEN: Range = (|x| x > 0.0 && x < 1.0, "above 0 and below 1");
const POISSON: Range = (|x| x > -1.0 && x < 0.5, "above -1 and below 0.5");

impl MethodOptions {
    /// Refuses numbers outside of their range.
    pub(super) fn check_ranges(&self) -> Result<(), OptionError> {
        let numbers: [(&str, Option<f64>, Range); 22] = [
            ("spacing", self.spacing, POSITIVE),
            ("time-step", self.time_step, POSITIVE),
            (
                "displacement-limit",
                self.displacement_limit.and_then(Limit::value),
                POSITIVE,
            ),
            ("spacing-range", self.spacing_range, RATIO),
            ("coarse-start", self.coarse_start, RATIO),
            ("settling", self.settling, BELOW_ONE),
            ("flip-share", self.flip_share, SHARE),
            ("friction", self.friction, NOT_NEGATIVE),
            ("youngs-modulus", self.youngs_modulus, POSITIVE),
            ("poissons-ratio", self.poissons_ratio, POISSON),
            ("alpha", self.alpha, FINITE),
            ("alpha-from", self.alpha_from, FINITE),
            ("alpha-to", self.alpha_to, FINITE),
            ("stretch-limit", self.stretch_limit.and_then(Limit::value), ABOVE_ONE),
            ("mass-floor", self.mass_floor, NOT_NEGATIVE),
            ("courant", self.courant.and_then(Limit::value), POSITIVE),
            ("step-size", self.step_size, POSITIVE),
            ("bandwidth", self.bandwidth, POSITIVE),
            ("target-acceptance", self.target_acceptance, BETWEEN),
            ("tolerance", self.tolerance, NOT_NEGATIVE),
            ("start-sd", self.start_sd, POSITIVE),
            ("start-mean", self.start_mean, FINITE),
        ];
        for (name, value, (holds, expected)) in numbers {
            if let Some(value) = value
                && !holds(value)
            {
                return Err(OptionError::out_of_range(name, value, expected));
            }
        }
        Ok(())
    }

    /// Options that need or exclude each other.
    pub(super) fn check_pairs(&self, method: MethodName) -> Result<(), OptionError> {
        if let Some(mesh) = &self.mesh
            && self.basis != Some(Basis::Mesh)
        {
            return Err(OptionError::new(
                "mesh",
                format!("{} needs the basis `mesh`", mesh.display()),
            ));
        }
        let refuse = |name: &str, value: f64, reason: &str| Err(OptionError::new(name, format!("{value} {reason}")));
        if let Some(share) = self.flip_share
            && method == MethodName::Mpm
            && !matches!(self.transfer, Some(Transfer::Flip | Transfer::AffineFlip))
        {
            return refuse("flip-share", share, "needs the transfer `flip` or `affine-flip`");
        }
        if let (Some(from), Some(to)) = (self.alpha_from, self.alpha_to)
            && matches!(self.alpha_schedule, None | Some(AlphaSchedule::Geometric))
            && (from == 0.0 || to == 0.0 || from.signum() != to.signum())
        {
            return refuse(
                "alpha-to",
                to,
                "must have the sign of alpha-from in a geometric schedule, and neither may be 0",
            );
        }
        if let Some(schedule) = self.alpha_schedule
            && self.alpha_from.is_none()
        {
            return Err(OptionError::new(
                "alpha-schedule",
                format!("{schedule} needs alpha-from and alpha-to beside it"),
            ));
        }
        if let Some(cycles) = self.alpha_cycles
            && self.alpha_schedule != Some(AlphaSchedule::Cyclic)
        {
            return refuse("alpha-cycles", cycles.get() as f64, "needs the alpha-schedule `cyclic`");
        }
        match (self.alpha, self.alpha_from, self.alpha_to) {
            (Some(_), Some(from), _) => refuse("alpha-from", from, "contradicts a constant alpha"),
            (Some(_), _, Some(to)) => refuse("alpha-to", to, "contradicts a constant alpha"),
            (None, Some(from), None) => refuse("alpha-from", from, "needs alpha-to beside it"),
            (None, None, Some(to)) => refuse("alpha-to", to, "needs alpha-from beside it"),
            _ => Ok(()),
        }
    }

    /// Refuses a score that drives the gas away.
    pub(super) fn check_attraction(&self) -> Result<(), OptionError> {
        let factors = [
            ("alpha", self.alpha),
            ("alpha-from", self.alpha_from),
            ("alpha-to", self.alpha_to),
        ];
        let drives_away = |&(name, alpha): &(_, Option<f64>)| Some((name, alpha.filter(|alpha| *alpha <= 0.0)?));
        match factors.iter().find_map(drives_away) {
            Some((name, alpha)) => Err(OptionError::out_of_range(name, alpha, "a number above 0")),
            None => Ok(()),
        }
    }

    /// Refuses options of a survey where there is none.
    pub(super) fn check_survey(&self) -> Result<(), OptionError> {
        if self.surveys() {
            return Ok(());
        }
        let no_rounds = self.rounds.is_some_and(|rounds| rounds.get() == 0);
        let is_of_survey = |name: &str| matches!(name, "evaluations" | "pool") || (name == "rounds" && no_rounds);
        match self.given().find(|(name, _)| is_of_survey(name)) {
            None => Ok(()),
            Some((name, value)) => Err(OptionError::new(&name, format!("{value} needs a survey"))),
        }
    }
}
