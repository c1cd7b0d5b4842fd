//! The options of all methods, and which of them belong to which method.

use std::path::PathBuf;

use clap::Args;
use parvi::{
    Annealing, Guards, MeshOptions, Method, MpmOptions, OnMesh, PaperOptions, Settling, SpacingSchedule, Start,
    SvgdOptions, TransferChoice,
};
use serde::{Deserialize, Serialize};

use super::{
    Basis, Correction, Draws, Limit, Material, MethodName, NonFinite, OptionError, ParticleCount, PoolChoice, Score,
    StepCount, Switch, Transfer, WarmUp,
};

/// Options of the methods; `None`: the method's own default.
#[derive(Args, Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
#[command(next_help_heading = "Options of the method")]
pub struct MethodOptions {
    /// Steps; support-points: at most [mpm, paper-*, svgd, support-points]
    #[arg(long, value_name = "T", allow_negative_numbers = true)]
    pub steps: Option<StepCount>,
    /// Background basis [mpm, paper-*]
    #[arg(long)]
    pub basis: Option<Basis>,
    /// Mesh of the domain that the density is kept to, a .msh file of Gmsh; with --basis mesh (mpm)
    #[arg(long, value_name = "FILE.msh")]
    pub mesh: Option<PathBuf>,
    /// Grid spacing in units of the target's scale [mpm, paper-*]
    #[arg(long, value_name = "H", allow_negative_numbers = true)]
    pub spacing: Option<f64>,
    /// Time step [mpm, paper-*]
    #[arg(long, value_name = "DT", allow_negative_numbers = true)]
    pub time_step: Option<f64>,
    /// Where the score is evaluated [mpm, paper-*]
    #[arg(long)]
    pub score: Option<Score>,
    /// Largest displacement per step in units of the spacing, or `off` [paper-*; mpm: a number]
    #[arg(long, value_name = "C|off", allow_negative_numbers = true)]
    pub displacement_limit: Option<Limit>,
    /// Look for the target's place, scales and pieces before the body moves (mpm)
    #[arg(long)]
    pub survey: Option<Switch>,
    /// Move the basis' origin and draw its spacing every step (mpm)
    #[arg(long)]
    pub shifts: Option<Switch>,
    /// Turn the lattice at random every step (mpm)
    #[arg(long)]
    pub rotation: Option<Switch>,
    /// Largest over smallest spacing that a run draws from, at least 1 (mpm)
    #[arg(long, value_name = "RATIO", allow_negative_numbers = true)]
    pub spacing_range: Option<f64>,
    /// Spacing of the first step over the central one, at least 1 (mpm)
    #[arg(long, value_name = "RATIO", allow_negative_numbers = true)]
    pub coarse_start: Option<f64>,
    /// Share of the steps over which the time step falls at the end, from 0 to below 1 (mpm)
    #[arg(long, value_name = "SHARE", allow_negative_numbers = true)]
    pub settling: Option<f64>,
    /// Go on shifting while settling (mpm)
    #[arg(long)]
    pub settling_shifts: Option<Switch>,
    /// What a last affine move of all particles puts right (mpm)
    #[arg(long)]
    pub moment_correction: Option<Correction>,
    /// Velocity transfer (mpm)
    #[arg(long)]
    pub transfer: Option<Transfer>,
    /// Share of FLIP in --transfer flip, from 0 to 1 (mpm)
    #[arg(long, value_name = "A", allow_negative_numbers = true)]
    pub flip_share: Option<f64>,
    /// Friction, per unit of time (mpm)
    #[arg(long, value_name = "GAMMA", allow_negative_numbers = true)]
    pub friction: Option<f64>,
    /// Rounds of the steps, at most, while the particles are still on their way; 3, but 1 with --steps (mpm)
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub rounds: Option<StepCount>,
    /// Equally many particles for each separate piece of the target, with weights; off unless given (mpm)
    #[arg(long)]
    pub weighted: Option<Switch>,
    /// What is done about a score that is not finite; pull-back unless given (mpm)
    #[arg(long)]
    pub non_finite: Option<NonFinite>,
    /// Judge the particles at the end; on unless given (mpm)
    #[arg(long)]
    pub certificate: Option<Switch>,
    /// Elastic law [paper-*]
    #[arg(long)]
    pub material: Option<Material>,
    /// Young's modulus [paper-*]
    #[arg(long, value_name = "E", allow_negative_numbers = true)]
    pub youngs_modulus: Option<f64>,
    /// Poisson's ratio [paper-*]
    #[arg(long, value_name = "NU", allow_negative_numbers = true)]
    pub poissons_ratio: Option<f64>,
    /// Constant factor before the score [mpm, paper-*]
    #[arg(long, allow_negative_numbers = true)]
    pub alpha: Option<f64>,
    /// Factor before the score in the first step, with --alpha-to [mpm, paper-*]
    #[arg(long, value_name = "ALPHA", allow_negative_numbers = true)]
    pub alpha_from: Option<f64>,
    /// Factor before the score in the last step, mpm: when settling begins, with --alpha-from [mpm, paper-*]
    #[arg(long, value_name = "ALPHA", allow_negative_numbers = true)]
    pub alpha_to: Option<f64>,
    /// All guards at once; single guards can be set beside it [paper-*]
    #[arg(long)]
    pub guards: Option<Switch>,
    /// Nodes lighter than this share of the mean particle mass get no force, 0: off [paper-*]
    #[arg(long, value_name = "SHARE", allow_negative_numbers = true)]
    pub mass_floor: Option<f64>,
    /// Multiply the force by the nodal mass [paper-*]
    #[arg(long)]
    pub mass_weighted_force: Option<Switch>,
    /// Courant number that limits the time step, or `off` [paper-*]
    #[arg(long, value_name = "C|off", allow_negative_numbers = true)]
    pub courant: Option<Limit>,
    /// Step size of the optimiser (svgd)
    #[arg(long, value_name = "SIZE", allow_negative_numbers = true)]
    pub step_size: Option<f64>,
    /// Fixed kernel bandwidth instead of the median rule (svgd)
    #[arg(long, allow_negative_numbers = true)]
    pub bandwidth: Option<f64>,
    /// Draws per chain that tune the sampler and are thrown away [nuts, stein-thinning with --pool nuts]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub warm_up: Option<WarmUp>,
    /// Chains that share the draws out [nuts, stein-thinning with --pool nuts]
    #[arg(long, value_name = "C", allow_negative_numbers = true)]
    pub chains: Option<StepCount>,
    /// Keep every K-th draw [nuts, stein-thinning with --pool nuts]
    #[arg(long, value_name = "K", allow_negative_numbers = true)]
    pub thinning: Option<StepCount>,
    /// Acceptance that the step size is tuned to, between 0 and 1 [nuts, stein-thinning with --pool nuts]
    #[arg(long, value_name = "A", allow_negative_numbers = true)]
    pub target_acceptance: Option<f64>,
    /// What the draws are chosen from (stein-thinning)
    #[arg(long)]
    pub pool: Option<PoolChoice>,
    /// Size of the bigger sample, at least the number of particles [stein-thinning, support-points]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub pool_size: Option<ParticleCount>,
    /// End when no point moves farther, in units of the sample's spread (support-points)
    #[arg(long, value_name = "TOL", allow_negative_numbers = true)]
    pub tolerance: Option<f64>,
    /// Mean of every coordinate at the start, in units of the target's scale [mpm, paper-*, svgd, nuts]
    #[arg(long, value_name = "MEAN", allow_negative_numbers = true)]
    pub start_mean: Option<f64>,
    /// Standard deviation of every coordinate at the start [mpm, paper-*, svgd, nuts]
    #[arg(long, value_name = "SD", allow_negative_numbers = true)]
    pub start_sd: Option<f64>,
    /// How the particles are drawn from their initial law [mpm, paper-*, svgd, nuts]
    #[arg(long)]
    pub start_draws: Option<Draws>,
    /// Measure residual and energy every so many steps; set by the studies.
    #[arg(skip)]
    #[serde(skip)]
    pub trace_every: usize,
}

/// The methods that have an option.
pub(super) type Owners = &'static [MethodName];
const GAS: Owners = &[MethodName::Mpm];
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
const CHOICE: Owners = &[MethodName::SteinThinning];
const CONDENSED: Owners = &[MethodName::SteinThinning, MethodName::SupportPoints];
/// What the sampler on a mesh knows.
const ON_MESH: [&str; 10] = [
    "basis",
    "mesh",
    "steps",
    "time-step",
    "friction",
    "shifts",
    "settling",
    "settling-shifts",
    "non-finite",
    "displacement-limit",
];
const REST: Owners = &[MethodName::SupportPoints];
const STARTED: Owners = &[
    MethodName::Mpm,
    MethodName::PaperPic,
    MethodName::PaperApic,
    MethodName::Svgd,
    MethodName::Nuts,
    MethodName::SteinThinning,
];

/// A range for numbers.
type Range = (fn(f64) -> bool, &'static str);
const POSITIVE: Range = (|x| x > 0.0 && x.is_finite(), "a number above 0");
const NOT_NEGATIVE: Range = (|x| x >= 0.0 && x.is_finite(), "a number of at least 0");
const FINITE: Range = (f64::is_finite, "a finite number");
const SHARE: Range = (|x| (0.0..=1.0).contains(&x), "from 0 to 1");
const RATIO: Range = (|x| x >= 1.0 && x.is_finite(), "a number of at least 1");
const BELOW_ONE: Range = (|x| (0.0..1.0).contains(&x), "at least 0 and below 1");
const BETWEEN: Range = (|x| x > 0.0 && x < 1.0, "above 0 and below 1");
const POISSON: Range = (|x| x > -1.0 && x < 0.5, "above -1 and below 0.5");

impl MethodOptions {
    /// The method for the sampler.
    ///
    /// # Errors
    /// The first option that does not fit the method, contradicts another one or lies outside of its range.
    pub fn method(&self, name: MethodName) -> Result<Method, OptionError> {
        self.check_fit(name)?;
        self.check_ranges()?;
        self.check_pairs()?;
        self.check_pool(name)?;
        let steps = self.steps.map(StepCount::get);
        Ok(match name {
            MethodName::Mpm if self.basis == Some(Basis::Mesh) => Method::OnMesh(self.on_mesh(steps)?),
            MethodName::Mpm => Method::Mpm(self.mpm(steps)?),
            MethodName::PaperPic | MethodName::PaperApic if self.basis == Some(Basis::Mesh) => {
                return Err(OptionError::misfit("basis", "mesh", name.as_str()));
            }
            MethodName::PaperPic => Method::Paper(self.paper(steps, false)),
            MethodName::PaperApic => Method::Paper(self.paper(steps, true)),
            MethodName::Svgd => {
                let default = SvgdOptions::default();
                Method::Svgd(SvgdOptions {
                    steps: steps.or(default.steps),
                    step_size: self.step_size.unwrap_or(default.step_size),
                    bandwidth: self.bandwidth,
                    trace_every: self.trace_every,
                })
            }
            MethodName::Iid => Method::Iid,
            MethodName::Sobol => Method::Sobol,
            MethodName::Nuts => Method::Nuts(self.nuts()),
            MethodName::SteinThinning => Method::SteinThinning(self.stein_thinning()),
            MethodName::SupportPoints => Method::SupportPoints(self.support_points()),
        })
    }

    /// Where the particles begin.
    pub fn start(&self) -> Start {
        let default = Start::default();
        Start {
            mean: self.start_mean.unwrap_or(default.mean),
            standard_deviation: self.start_sd.unwrap_or(default.standard_deviation),
            draws: self.start_draws.map_or(default.draws, Into::into),
        }
    }

    fn mpm(&self, steps: Option<usize>) -> Result<MpmOptions, OptionError> {
        let default = MpmOptions::default();
        let transfer = match self.transfer {
            None => default.transfer,
            Some(Transfer::Pic) => TransferChoice::Pic,
            Some(Transfer::Apic) => TransferChoice::Apic,
            Some(Transfer::Flip) => TransferChoice::Flip(self.flip_share.unwrap_or(0.95)),
        };
        let displacement_limit = self.displacement_limit_of_gas(default.displacement_limit)?;
        Ok(MpmOptions {
            basis: self.basis.and_then(Basis::uniform).unwrap_or(default.basis),
            transfer,
            spacing: self.spacing.or(default.spacing),
            steps: steps.or(default.steps),
            time_step: self.time_step.or(default.time_step),
            friction: self.friction.or(default.friction),
            survey: self.survey.map_or(default.survey, Switch::is_on),
            shifts: self.shifts.map_or(default.shifts, Switch::is_on),
            rotation: self.rotation.map_or(default.rotation, Switch::is_on),
            spacing_schedule: SpacingSchedule {
                range: self.spacing_range.unwrap_or(default.spacing_schedule.range),
                coarse_start: self.coarse_start.unwrap_or(default.spacing_schedule.coarse_start),
                ..default.spacing_schedule
            },
            settling: self.settling(default.settling),
            moment_correction: self.moment_correction.map_or(default.moment_correction, Into::into),
            score_location: self.score.map_or(default.score_location, Into::into),
            displacement_limit,
            rounds: self.rounds.map(StepCount::get).or(default.rounds),
            non_finite_scores: self.non_finite.map_or(default.non_finite_scores, Into::into),
            annealing: self.annealing().unwrap_or(default.annealing),
            certificate: self.certificate.map_or(default.certificate, Switch::is_on),
            checkpoint: default.checkpoint,
            weighted: self.weighted.map_or(default.weighted, Switch::is_on),
            trace_every: self.trace_every,
        })
    }

    fn on_mesh(&self, steps: Option<usize>) -> Result<OnMesh, OptionError> {
        let default = MeshOptions::default();
        let Some(file) = self.mesh.clone() else {
            return Err(OptionError {
                name: "basis".to_owned(),
                reason: "mesh needs --mesh FILE.msh beside it".to_owned(),
            });
        };
        let misfit = self.given().into_iter().find(|(name, ..)| !ON_MESH.contains(name));
        if let Some((name, value, _)) = misfit {
            return Err(OptionError::misfit(name, &value, "mpm on a mesh"));
        }
        let options = MeshOptions {
            steps: steps.or(default.steps),
            time_step: self.time_step.or(default.time_step),
            friction: self.friction.or(default.friction),
            shifts: self.shifts.map_or(default.shifts, Switch::is_on),
            settling: self.settling(default.settling),
            non_finite_scores: self.non_finite.map_or(default.non_finite_scores, Into::into),
            displacement_limit: self.displacement_limit_of_gas(default.displacement_limit)?,
            trace_every: self.trace_every,
        };
        Ok(OnMesh { file, options })
    }

    fn settling(&self, default: Settling) -> Settling {
        Settling {
            share: self.settling.unwrap_or(default.share),
            shifts: self.settling_shifts.map_or(default.shifts, Switch::is_on),
            ..default
        }
    }

    fn displacement_limit_of_gas(&self, default: f64) -> Result<f64, OptionError> {
        match self.displacement_limit {
            None => Ok(default),
            Some(Limit::At(limit)) => Ok(limit),
            Some(Limit::Off) => Err(OptionError::misfit("displacement-limit", "off", "mpm")),
        }
    }

    fn paper(&self, steps: Option<usize>, affine: bool) -> PaperOptions {
        let default = PaperOptions::default();
        PaperOptions {
            affine,
            basis: self.basis.and_then(Basis::uniform).unwrap_or(default.basis),
            elasticity: self.material.map_or(default.elasticity, Into::into),
            youngs_modulus: self.youngs_modulus.unwrap_or(default.youngs_modulus),
            poissons_ratio: self.poissons_ratio.unwrap_or(default.poissons_ratio),
            annealing: self.annealing().unwrap_or(default.annealing),
            score_location: self.score.map_or(default.score_location, Into::into),
            spacing: self.spacing.or(default.spacing),
            steps: steps.or(default.steps),
            time_step: self.time_step.or(default.time_step),
            guards: self.guards(),
            trace_every: self.trace_every,
        }
    }

    fn annealing(&self) -> Option<Annealing> {
        match (self.alpha, self.alpha_from, self.alpha_to) {
            (Some(alpha), _, _) => Some(Annealing::Constant(alpha)),
            (None, Some(from), Some(to)) => Some(Annealing::Geometric { from, to }),
            _ => None,
        }
    }

    fn guards(&self) -> Guards {
        let base = match self.guards {
            Some(Switch::Off) => Guards::none(),
            _ => Guards::default(),
        };
        Guards {
            mass_floor: self.mass_floor.unwrap_or(base.mass_floor),
            mass_weighted_force: self.mass_weighted_force.map_or(base.mass_weighted_force, Switch::is_on),
            courant: self.courant.map_or(base.courant, Limit::value),
            displacement_limit: self.displacement_limit.map_or(base.displacement_limit, Limit::value),
        }
    }

    /// Refuses options that the method does not have.
    fn check_fit(&self, method: MethodName) -> Result<(), OptionError> {
        for (name, value, owners) in self.given() {
            if !owners.contains(&method) {
                return Err(OptionError::misfit(name, &value, method.as_str()));
            }
        }
        Ok(())
    }

    /// The flags that say the same on the command line.
    pub fn flags(&self) -> Vec<String> {
        self.given()
            .into_iter()
            .flat_map(|(name, value, _)| [format!("--{name}"), value])
            .collect()
    }

    /// The options that are set: name, value as typed, methods that have it.
    pub(super) fn given(&self) -> Vec<(&'static str, String, Owners)> {
        fn text<T: ToString>(value: &Option<T>) -> Option<String> {
            value.as_ref().map(T::to_string)
        }
        let all = [
            ("steps", text(&self.steps), STEPPED),
            ("basis", text(&self.basis), GRID),
            ("mesh", self.mesh.as_ref().map(|path| path.display().to_string()), GAS),
            ("spacing", text(&self.spacing), GRID),
            ("time-step", text(&self.time_step), GRID),
            ("score", text(&self.score), GRID),
            ("displacement-limit", text(&self.displacement_limit), GRID),
            ("survey", text(&self.survey), GAS),
            ("shifts", text(&self.shifts), GAS),
            ("rotation", text(&self.rotation), GAS),
            ("spacing-range", text(&self.spacing_range), GAS),
            ("coarse-start", text(&self.coarse_start), GAS),
            ("settling", text(&self.settling), GAS),
            ("settling-shifts", text(&self.settling_shifts), GAS),
            ("moment-correction", text(&self.moment_correction), GAS),
            ("transfer", text(&self.transfer), GAS),
            ("flip-share", text(&self.flip_share), GAS),
            ("friction", text(&self.friction), GAS),
            ("rounds", text(&self.rounds), GAS),
            ("weighted", text(&self.weighted), GAS),
            ("non-finite", text(&self.non_finite), GAS),
            ("certificate", text(&self.certificate), GAS),
            ("material", text(&self.material), PAPER),
            ("youngs-modulus", text(&self.youngs_modulus), PAPER),
            ("poissons-ratio", text(&self.poissons_ratio), PAPER),
            ("alpha", text(&self.alpha), GRID),
            ("alpha-from", text(&self.alpha_from), GRID),
            ("alpha-to", text(&self.alpha_to), GRID),
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
            ("pool", text(&self.pool), CHOICE),
            ("pool-size", text(&self.pool_size), CONDENSED),
            ("tolerance", text(&self.tolerance), REST),
            ("start-mean", text(&self.start_mean), STARTED),
            ("start-sd", text(&self.start_sd), STARTED),
            ("start-draws", text(&self.start_draws), STARTED),
        ];
        all.into_iter()
            .filter_map(|(name, value, owners)| Some((name, value?, owners)))
            .collect()
    }

    fn check_ranges(&self) -> Result<(), OptionError> {
        let numbers: [(&str, Option<f64>, Range); 20] = [
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
            ("alpha", self.alpha, POSITIVE),
            ("alpha-from", self.alpha_from, POSITIVE),
            ("alpha-to", self.alpha_to, POSITIVE),
            ("mass-floor", self.mass_floor, NOT_NEGATIVE),
            ("courant", self.courant.and_then(Limit::value), POSITIVE),
            ("step-size", self.step_size, POSITIVE),
            ("bandwidth", self.bandwidth, POSITIVE),
            ("target-acceptance", self.target_acceptance, BETWEEN),
            ("tolerance", self.tolerance, NOT_NEGATIVE),
            ("start-sd", self.start_sd, POSITIVE),
        ];
        for (name, value, (holds, expected)) in numbers.into_iter().chain([("start-mean", self.start_mean, FINITE)]) {
            if let Some(value) = value
                && !holds(value)
            {
                return Err(OptionError::out_of_range(name, value, expected));
            }
        }
        Ok(())
    }

    /// Options that need or exclude each other.
    fn check_pairs(&self) -> Result<(), OptionError> {
        if let Some(mesh) = &self.mesh
            && self.basis != Some(Basis::Mesh)
        {
            return Err(OptionError {
                name: "mesh".to_owned(),
                reason: format!("{} needs the basis `mesh`", mesh.display()),
            });
        }
        let refuse = |name: &str, value: f64, reason: &str| {
            Err(OptionError {
                name: name.to_owned(),
                reason: format!("{value} {reason}"),
            })
        };
        if let Some(share) = self.flip_share
            && self.transfer != Some(Transfer::Flip)
        {
            return refuse("flip-share", share, "needs the transfer `flip`");
        }
        match (self.alpha, self.alpha_from, self.alpha_to) {
            (Some(_), Some(from), _) => refuse("alpha-from", from, "contradicts a constant alpha"),
            (Some(_), _, Some(to)) => refuse("alpha-to", to, "contradicts a constant alpha"),
            (None, Some(from), None) => refuse("alpha-from", from, "needs alpha-to beside it"),
            (None, None, Some(to)) => refuse("alpha-to", to, "needs alpha-from beside it"),
            _ => Ok(()),
        }
    }
}
