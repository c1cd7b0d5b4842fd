//! Ranges of options, and which of them need or exclude each other.

use super::{
    AlphaSchedule, Basis, MethodName, MethodOptions, OptionError, PoolChoice, Score, Switch, Transfer, is_among,
};

/// Options with spaces between, what has to hold where one of them is given, and what is to be said behind its value otherwise.
type Rule = (&'static str, bool, &'static str);

impl MethodOptions {
    /// Refuses numbers outside of their range.
    pub(super) fn check_ranges(&self) -> Result<(), OptionError> {
        for (name, value, (holds, expected)) in self.ranged() {
            if let Some(value) = value.filter(|value| !holds(*value)) {
                return Err(OptionError::out_of_range(&name, value, expected));
            }
        }
        Ok(())
    }

    /// Refuses options that need or exclude each other.
    pub(super) fn check_rules(&self, method: MethodName) -> Result<(), OptionError> {
        let mut rules = self.rules_of_all();
        rules.extend(match method {
            MethodName::Mpm => self.rules_of_gas(),
            MethodName::SteinThinning => self.rules_of_thinning(),
            _ => Vec::new(),
        });
        let given: Vec<(String, String)> = self.given().collect();
        let broken = rules.into_iter().filter(|(_, holds, _)| !holds);
        let refused = |(options, _, reason): Rule| {
            let (name, value) = given.iter().find(|(name, _)| is_among(options, name))?;
            Some(OptionError::new(name, format!("{value} {reason}")))
        };
        broken.filter_map(refused).next().map_or(Ok(()), Err)
    }

    fn rules_of_all(&self) -> Vec<Rule> {
        let is_geometric = matches!(self.alpha_schedule, None | Some(AlphaSchedule::Geometric));
        let alike = |(from, to): (f64, f64)| from != 0.0 && to != 0.0 && from.signum() == to.signum();
        let reaches = !is_geometric || self.alpha_from.zip(self.alpha_to).is_none_or(alike);
        let is_cyclic = self.alpha_schedule == Some(AlphaSchedule::Cyclic);
        let (is_constant, has_from) = (self.alpha.is_some(), self.alpha_from.is_some());
        let (has_file, has_law) = (self.start.is_some(), self.start_law.is_some());
        let has_centre = self.start_centre.is_some();
        let has_density = !has_file || !self.volumes_of_start();
        let laws = "start-law start-centre start-mean start-sd";
        let otherwise = "must have the sign of alpha-from in a geometric schedule, and neither may be 0";
        let of_start = "needs a start law, which a file of positions does not have";
        vec![
            ("alpha-to", reaches, otherwise),
            ("alpha-schedule", has_from, "needs alpha-from and alpha-to beside it"),
            ("alpha-cycles", is_cyclic, "needs the alpha-schedule `cyclic`"),
            ("alpha-from", !is_constant, "contradicts a constant alpha"),
            ("alpha-to", !is_constant, "contradicts a constant alpha"),
            ("alpha-from", self.alpha_to.is_some(), "needs alpha-to beside it"),
            ("alpha-to", has_from, "needs alpha-from beside it"),
            ("mesh", self.basis == Some(Basis::Mesh), "needs the basis `mesh`"),
            (laws, !has_file, "contradicts --start"),
            ("start-centre start-mean start-sd", !has_law, "contradicts --start-law"),
            ("start-mean start-sd", !has_centre, "contradicts --start-centre"),
            ("start-covariance", has_centre, "needs --start-centre beside it"),
            ("volumes", has_density, of_start),
        ]
    }

    fn rules_of_gas(&self) -> Vec<Rule> {
        // Another score drives the gas away.
        let attracts = "must be a number above 0";
        let flips = matches!(self.transfer, Some(Transfer::Flip | Transfer::AffineFlip));
        let (surveys, asks) = (self.surveys(), self.survey == Some(Switch::On));
        let caches = self.score == Some(Score::Cached);
        let weighs = surveys && !caches;
        let has_rounds = self.rounds.is_none_or(|rounds| rounds.get() > 0);
        let has_mesh = self.basis != Some(Basis::Mesh) || self.mesh.is_some();
        let is_limited = self.displacement_limit.is_none_or(|limit| limit.value().is_some());
        vec![
            ("flip-share", flips, "needs the transfer `flip` or `affine-flip`"),
            ("survey", !asks || !caches, "contradicts --score cached, which has none"),
            ("survey", !asks || surveys, "needs a last alpha of 1"),
            ("evaluations", surveys || caches, "needs a survey, or --score cached"),
            ("search-effort pool", weighs, "needs a survey"),
            ("rounds", surveys || has_rounds, "needs a survey"),
            (
                "weighted",
                weighs || self.weighted != Some(Switch::On),
                "needs a survey",
            ),
            ("alpha", self.alpha > Some(0.0), attracts),
            ("alpha-from", self.alpha_from > Some(0.0), attracts),
            ("alpha-to", self.alpha_to > Some(0.0), attracts),
            ("basis", has_mesh, "needs --mesh FILE.msh beside it"),
            ("displacement-limit", is_limited, "does not fit method `mpm`"),
        ]
    }

    fn rules_of_thinning(&self) -> Vec<Rule> {
        let has_chains = matches!(self.pool_choice(), Ok(Some(PoolChoice::Nuts)));
        vec![(MethodName::Nuts.kind().options, has_chains, "needs the pool `nuts`")]
    }
}
