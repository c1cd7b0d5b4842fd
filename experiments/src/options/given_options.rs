//! Which options are set, and which of them a method has.

use std::path::PathBuf;

use super::{MethodName, MethodOptions, OptionError};

impl MethodOptions {
    /// Refuses options that the method does not have.
    pub(super) fn check_fit(&self, method: MethodName) -> Result<(), OptionError> {
        match self.given().find(|(name, _)| !method.kind().has(name)) {
            Some((name, value)) => Err(OptionError::misfit(name, &value, method.as_str())),
            None => Ok(()),
        }
    }

    /// The options that are set: name, value as typed.
    pub(super) fn given(&self) -> impl Iterator<Item = (&'static str, String)> {
        self.all().into_iter().filter_map(|(name, value)| Some((name, value?)))
    }

    /// All options by name.
    fn all(&self) -> [(&'static str, Option<String>); 72] {
        fn text<T: ToString>(value: &Option<T>) -> Option<String> {
            value.as_ref().map(T::to_string)
        }
        let file = |path: &Option<PathBuf>| path.as_ref().map(|path| path.display().to_string());
        [
            ("steps", text(&self.steps)),
            ("basis", text(&self.basis)),
            ("mesh", file(&self.mesh)),
            ("spacing", text(&self.spacing)),
            ("time-step", text(&self.time_step)),
            ("score", text(&self.score)),
            ("displacement-limit", text(&self.displacement_limit)),
            ("survey", text(&self.survey)),
            ("evaluations", text(&self.evaluations)),
            ("shifts", text(&self.shifts)),
            ("rotation", text(&self.rotation)),
            ("spacing-range", text(&self.spacing_range)),
            ("coarse-start", text(&self.coarse_start)),
            ("settling", text(&self.settling)),
            ("settling-shifts", text(&self.settling_shifts)),
            ("moment-correction", text(&self.moment_correction)),
            ("transfer", text(&self.transfer)),
            ("flip-share", text(&self.flip_share)),
            ("friction", text(&self.friction)),
            ("rounds", text(&self.rounds)),
            ("weighted", text(&self.weighted)),
            ("non-finite", text(&self.non_finite)),
            ("certificate", text(&self.certificate)),
            ("material", text(&self.material)),
            ("youngs-modulus", text(&self.youngs_modulus)),
            ("poissons-ratio", text(&self.poissons_ratio)),
            ("as-written", text(&self.as_written)),
            ("frame", text(&self.frame)),
            ("peak-yield-stress", text(&self.peak_yield_stress)),
            ("residual-yield-stress", text(&self.residual_yield_stress)),
            ("softening-rate", text(&self.softening_rate)),
            ("friction-angle", text(&self.friction_angle)),
            ("cohesion", text(&self.cohesion)),
            ("density", text(&self.density)),
            ("sound-speed", text(&self.sound_speed)),
            ("viscosity", text(&self.viscosity)),
            ("forgets-expansion", text(&self.forgets_expansion)),
            ("pressure-per-density", text(&self.pressure_per_density)),
            ("grid-renewal", text(&self.grid_renewal)),
            ("masses", file(&self.masses)),
            ("volumes", file(&self.volumes)),
            ("velocities", file(&self.velocities)),
            ("stretch-limit", text(&self.stretch_limit)),
            ("alpha", text(&self.alpha)),
            ("alpha-from", text(&self.alpha_from)),
            ("alpha-to", text(&self.alpha_to)),
            ("alpha-schedule", text(&self.alpha_schedule)),
            ("alpha-cycles", text(&self.alpha_cycles)),
            ("monitor", text(&self.monitor)),
            ("monitor-every", text(&self.monitor_every)),
            ("patience", text(&self.patience)),
            ("best", file(&self.best)),
            ("guards", text(&self.guards)),
            ("mass-floor", text(&self.mass_floor)),
            ("mass-weighted-force", text(&self.mass_weighted_force)),
            ("courant", text(&self.courant)),
            ("step-size", text(&self.step_size)),
            ("bandwidth", text(&self.bandwidth)),
            ("warm-up", text(&self.warm_up)),
            ("chains", text(&self.chains)),
            ("thinning", text(&self.thinning)),
            ("target-acceptance", text(&self.target_acceptance)),
            ("pool", file(&self.pool)),
            ("pool-size", text(&self.pool_size)),
            ("tolerance", text(&self.tolerance)),
            ("start", file(&self.start)),
            ("start-law", text(&self.start_law)),
            ("start-centre", text(&self.start_centre)),
            ("start-covariance", text(&self.start_covariance)),
            ("start-mean", text(&self.start_mean)),
            ("start-sd", text(&self.start_sd)),
            ("start-draws", text(&self.start_draws)),
        ]
    }
}

#[cfg(test)]
mod tests {
    use clap::ValueEnum;

    use super::*;

    #[test]
    fn every_option_is_one_of_some_method_and_no_method_has_others() {
        let names = MethodOptions::default().all().map(|(name, _)| name);
        let owned: Vec<&str> = MethodName::value_variants()
            .iter()
            .flat_map(|method| method.kind().options.split(' '))
            .collect();
        assert!(owned.iter().all(|option| option.is_empty() || names.contains(option)));
        assert!(names.iter().all(|name| owned.contains(name)));
    }
}
