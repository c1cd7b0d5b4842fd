//! Ranges of options, and which of them need or exclude each other.

use super::{AlphaSchedule, Basis, Limit, MethodName, MethodOptions, OptionError, PoolChoice, Score, Switch, Transfer};

/// What has to hold where an option is given.
struct Rules {
    /// Options for which it does not, and what is to be said behind their values.
    broken: Vec<(&'static str, &'static str)>,
}

impl Rules {
    /// For this option, if it is given, that has to hold.
    fn ask(&mut self, option: &'static str, holds: bool, otherwise: &'static str) {
        if !holds {
            self.broken.push((option, otherwise));
        }
    }
}

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
        let mut rules = Rules { broken: Vec::new() };
        self.rules_of_all(&mut rules);
        match method {
            MethodName::Mpm => self.rules_of_gas(&mut rules),
            MethodName::SteinThinning => self.rules_of_thinning(&mut rules),
            _ => {}
        }
        let given: Vec<(String, String)> = self.given().collect();
        for (option, reason) in rules.broken {
            if let Some((_, value)) = given.iter().find(|(name, _)| name == option) {
                return Err(OptionError::new(option, format!("{value} {reason}")));
            }
        }
        Ok(())
    }

    fn rules_of_all(&self, rules: &mut Rules) {
        let is_geometric = matches!(self.alpha_schedule, None | Some(AlphaSchedule::Geometric));
        let alike = |(from, to): (f64, f64)| from != 0.0 && to != 0.0 && from.signum() == to.signum();
        let reaches = !is_geometric || self.alpha_from.zip(self.alpha_to).is_none_or(alike);
        let otherwise = "must have the sign of alpha-from in a geometric schedule, and neither may be 0";
        rules.ask("alpha-to", reaches, otherwise);
        let has_from = self.alpha_from.is_some();
        rules.ask("alpha-schedule", has_from, "needs alpha-from and alpha-to beside it");
        let is_cyclic = self.alpha_schedule == Some(AlphaSchedule::Cyclic);
        rules.ask("alpha-cycles", is_cyclic, "needs the alpha-schedule `cyclic`");
        rules.ask("alpha-from", self.alpha.is_none(), "contradicts a constant alpha");
        rules.ask("alpha-to", self.alpha.is_none(), "contradicts a constant alpha");
        rules.ask("alpha-from", self.alpha_to.is_some(), "needs alpha-to beside it");
        rules.ask("alpha-to", has_from, "needs alpha-from beside it");
        rules.ask("mesh", self.basis == Some(Basis::Mesh), "needs the basis `mesh`");
        for option in ["start-law", "start-centre", "start-mean", "start-sd"] {
            rules.ask(option, self.start.is_none(), "contradicts --start");
        }
        for option in ["start-centre", "start-mean", "start-sd"] {
            rules.ask(option, self.start_law.is_none(), "contradicts --start-law");
        }
        let has_centre = self.start_centre.is_some();
        for option in ["start-mean", "start-sd"] {
            rules.ask(option, !has_centre, "contradicts --start-centre");
        }
        rules.ask("start-covariance", has_centre, "needs --start-centre beside it");
        let has_law = self.start.is_none() || !self.volumes_of_start();
        let otherwise = "needs a start law, which a file of positions does not have";
        rules.ask("volumes", has_law, otherwise);
    }

    fn rules_of_gas(&self, rules: &mut Rules) {
        let flips = matches!(self.transfer, Some(Transfer::Flip | Transfer::AffineFlip));
        rules.ask("flip-share", flips, "needs the transfer `flip` or `affine-flip`");
        let surveys = self.surveys();
        let asks = self.survey == Some(Switch::On);
        let caches = self.score == Some(Score::Cached);
        rules.ask(
            "survey",
            !(asks && caches),
            "contradicts --score cached, which has none",
        );
        rules.ask("survey", !asks || surveys, "needs a last alpha of 1");
        for option in ["start", "start-law", "start-centre"] {
            let otherwise = "needs --survey off: a survey says where the particles begin";
            rules.ask(option, !surveys, otherwise);
        }
        let has_rounds = self.rounds.is_none_or(|rounds| rounds.get() > 0);
        rules.ask("evaluations", surveys, "needs a survey");
        rules.ask("search-effort", surveys, "needs a survey");
        rules.ask("rounds", surveys || has_rounds, "needs a survey");
        rules.ask("pool", surveys, "needs a survey");
        // Another score drives the gas away.
        let factors = [
            ("alpha", self.alpha),
            ("alpha-from", self.alpha_from),
            ("alpha-to", self.alpha_to),
        ];
        for (option, alpha) in factors {
            rules.ask(option, alpha > Some(0.0), "must be a number above 0");
        }
        let has_mesh = self.basis != Some(Basis::Mesh) || self.mesh.is_some();
        rules.ask("basis", has_mesh, "needs --mesh FILE.msh beside it");
        let is_limited = self.displacement_limit != Some(Limit::Off);
        rules.ask("displacement-limit", is_limited, "does not fit method `mpm`");
    }

    fn rules_of_thinning(&self, rules: &mut Rules) {
        let has_chains = matches!(self.pool_choice(), Ok(Some(PoolChoice::Nuts)));
        for option in MethodName::Nuts.kind().options.split(' ') {
            rules.ask(option, has_chains, "needs the pool `nuts`");
        }
    }
}
