//! Which options belong to which method.

use std::path::PathBuf;

use super::{MethodName, MethodOptions, OptionError};

/// The methods that have an option.
pub(super) type Owners = &'static [MethodName];
const GAS: Owners = &[MethodName::Mpm];
const WEIGHED: Owners = &[MethodName::Mpm, MethodName::Ais];
const PAPER: Owners = &[MethodName::PaperPic, MethodName::PaperApic];
const GRID: Owners = &[MethodName::Mpm, MethodName::PaperPic, MethodName::PaperApic];
const STEIN: Owners = &[MethodName::Svgd];
const STEPPED: Owners = &[
    MethodName::Mpm,
    MethodName::PaperPic,
    MethodName::PaperApic,
    MethodName::Svgd,
    MethodName::SupportPoints,
];
const CHAIN: Owners = &[MethodName::Nuts, MethodName::SteinThinning];
const POOLED: Owners = &[MethodName::Mpm, MethodName::Ais, MethodName::SteinThinning];
const CONDENSED: Owners = &[MethodName::SteinThinning, MethodName::SupportPoints];
const REST: Owners = &[MethodName::SupportPoints];
const MOVED: Owners = &[
    MethodName::Mpm,
    MethodName::PaperPic,
    MethodName::PaperApic,
    MethodName::Svgd,
];
const STARTED: Owners = &[
    MethodName::Mpm,
    MethodName::Ais,
    MethodName::PaperPic,
    MethodName::PaperApic,
    MethodName::Svgd,
    MethodName::Nuts,
    MethodName::SteinThinning,
];

impl MethodOptions {
    /// Refuses options that the method does not have.
    pub(super) fn check_fit(&self, method: MethodName) -> Result<(), OptionError> {
        for (name, value, owners) in self.given() {
            if !owners.contains(&method) {
                return Err(OptionError::misfit(name, &value, method.as_str()));
            }
        }
        Ok(())
    }

    /// The options that are set: name, value as typed, methods that have it.
    pub(super) fn given(&self) -> Vec<(&'static str, String, Owners)> {
        fn text<T: ToString>(value: &Option<T>) -> Option<String> {
            value.as_ref().map(T::to_string)
        }
        let file = |path: &Option<PathBuf>| path.as_ref().map(|path| path.display().to_string());
        let all = [
            ("steps", text(&self.steps), STEPPED),
            ("basis", text(&self.basis), GRID),
            ("mesh", file(&self.mesh), GAS),
            ("spacing", text(&self.spacing), GRID),
            ("time-step", text(&self.time_step), GRID),
            ("score", text(&self.score), GRID),
            ("displacement-limit", text(&self.displacement_limit), GRID),
            ("survey", text(&self.survey), GAS),
            ("evaluations", text(&self.evaluations), WEIGHED),
            ("shifts", text(&self.shifts), GAS),
            ("rotation", text(&self.rotation), GAS),
            ("spacing-range", text(&self.spacing_range), GAS),
            ("coarse-start", text(&self.coarse_start), GAS),
            ("settling", text(&self.settling), GAS),
            ("settling-shifts", text(&self.settling_shifts), GAS),
            ("moment-correction", text(&self.moment_correction), GAS),
            ("transfer", text(&self.transfer), GAS),
            ("flip-share", text(&self.flip_share), GRID),
            ("friction", text(&self.friction), GRID),
            ("rounds", text(&self.rounds), GAS),
            ("weighted", text(&self.weighted), GAS),
            ("non-finite", text(&self.non_finite), GAS),
            ("certificate", text(&self.certificate), GRID),
            ("material", text(&self.material), PAPER),
            ("youngs-modulus", text(&self.youngs_modulus), PAPER),
            ("poissons-ratio", text(&self.poissons_ratio), PAPER),
            ("as-written", text(&self.as_written), PAPER),
            ("frame", text(&self.frame), PAPER),
            ("peak-yield-stress", text(&self.peak_yield_stress), PAPER),
            ("residual-yield-stress", text(&self.residual_yield_stress), PAPER),
            ("softening-rate", text(&self.softening_rate), PAPER),
            ("friction-angle", text(&self.friction_angle), PAPER),
            ("cohesion", text(&self.cohesion), PAPER),
            ("density", text(&self.density), PAPER),
            ("sound-speed", text(&self.sound_speed), PAPER),
            ("viscosity", text(&self.viscosity), PAPER),
            ("forgets-expansion", text(&self.forgets_expansion), PAPER),
            ("pressure-per-density", text(&self.pressure_per_density), PAPER),
            ("grid-renewal", text(&self.grid_renewal), PAPER),
            ("masses", file(&self.masses), PAPER),
            ("volumes", file(&self.volumes), PAPER),
            ("velocities", file(&self.velocities), PAPER),
            ("stretch-limit", text(&self.stretch_limit), PAPER),
            ("alpha", text(&self.alpha), GRID),
            ("alpha-from", text(&self.alpha_from), GRID),
            ("alpha-to", text(&self.alpha_to), GRID),
            ("alpha-schedule", text(&self.alpha_schedule), GRID),
            ("alpha-cycles", text(&self.alpha_cycles), GRID),
            ("monitor", text(&self.monitor), PAPER),
            ("monitor-every", text(&self.monitor_every), PAPER),
            ("patience", text(&self.patience), PAPER),
            ("best", file(&self.best), PAPER),
            ("guards", text(&self.guards), PAPER),
            ("mass-floor", text(&self.mass_floor), PAPER),
            ("mass-weighted-force", text(&self.mass_weighted_force), PAPER),
            ("courant", text(&self.courant), PAPER),
            ("step-size", text(&self.step_size), STEIN),
            ("bandwidth", text(&self.bandwidth), STEIN),
            ("warm-up", text(&self.warm_up), CHAIN),
            ("chains", text(&self.chains), CHAIN),
            ("thinning", text(&self.thinning), CHAIN),
            ("target-acceptance", text(&self.target_acceptance), CHAIN),
            ("pool", file(&self.pool), POOLED),
            ("pool-size", text(&self.pool_size), CONDENSED),
            ("tolerance", text(&self.tolerance), REST),
            ("start", file(&self.start), MOVED),
            ("start-law", text(&self.start_law), MOVED),
            ("start-centre", text(&self.start_centre), MOVED),
            ("start-covariance", text(&self.start_covariance), MOVED),
            ("start-mean", text(&self.start_mean), STARTED),
            ("start-sd", text(&self.start_sd), STARTED),
            ("start-draws", text(&self.start_draws), STARTED),
        ];
        all.into_iter()
            .filter_map(|(name, value, owners)| Some((name, value?, owners)))
            .collect()
    }
}
