//! Ranges of options, and which of them need or exclude each other.

use super::{AlphaSchedule, Basis, MethodName, MethodOptions, OptionError, Transfer};

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

    /// Options that need or exclude each other.
    pub(super) fn check_pairs(&self, method: MethodName) -> Result<(), OptionError> {
        if let Some(mesh) = &self.mesh
            && self.basis != Some(Basis::Mesh)
        {
            let reason = format!("{} needs the basis `mesh`", mesh.display());
            return Err(OptionError::new("mesh", reason));
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
            let reason = format!("{schedule} needs alpha-from and alpha-to beside it");
            return Err(OptionError::new("alpha-schedule", reason));
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
