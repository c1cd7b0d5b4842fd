//! The options of all methods.

use std::path::PathBuf;

use clap::Args;
use parvi::{Method, Start};
use serde::Deserialize;

use super::{
    AlphaSchedule, Basis, Correction, Draws, EvaluationCount, FrameName, Limit, Material, MethodName, MonitorName,
    NonFinite, OptionError, ParticleCount, RoundCount, Score, StepCount, Switch, Transfer, Typed, WarmUp,
};

/// The options, and the list of them; the documentation of an option is what `--help` says.
macro_rules! options {
    ($($(#[$meta:meta])* $name:ident: $type:ty,)*) => {
        /// Options of the methods; `None`: the method's own default.
        #[derive(Args, Clone, Debug, Default, PartialEq, Deserialize)]
        #[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
        #[command(next_help_heading = "Options of the method")]
        pub struct MethodOptions {
            $($(#[$meta])* pub $name: Option<$type>,)*
            /// Measure residual and energy every so many steps; set by the studies.
            #[arg(skip)]
            #[serde(skip)]
            pub trace_every: usize,
        }

        impl MethodOptions {
            /// The names of all options.
            #[cfg(test)]
            pub(super) fn names() -> Vec<String> {
                [$(stringify!($name)),*].map(flag).into()
            }

            /// The options that are set: name, value as typed.
            pub(super) fn given(&self) -> impl Iterator<Item = (String, String)> {
                let all = [$((stringify!($name), self.$name.as_ref().map(Typed::typed))),*];
                all.into_iter().filter_map(|(name, value)| Some((flag(name), value?)))
            }
        }
    };
}

/// The name of an option on the command line and in files.
fn flag(name: &str) -> String {
    name.replace('_', "-")
}

options! {
    /// Steps; mpm: of a round; support-points: at most
    #[arg(long, value_name = "T", allow_negative_numbers = true)]
    steps: StepCount,
    /// Background basis
    #[arg(long)]
    basis: Basis,
    /// Mesh of the domain that the density is kept to, a .msh file of Gmsh; with --basis mesh
    #[arg(long, value_name = "FILE.msh")]
    mesh: PathBuf,
    /// Grid spacing in units of the target's scale
    #[arg(long, value_name = "H", allow_negative_numbers = true)]
    spacing: f64,
    /// Time step
    #[arg(long, value_name = "DT", allow_negative_numbers = true)]
    time_step: f64,
    /// Where the score is evaluated
    #[arg(long)]
    score: Score,
    /// Largest displacement per step in units of the spacing, or `off`; mpm: a number
    #[arg(long, value_name = "C|off", allow_negative_numbers = true)]
    displacement_limit: Limit,
    /// Weigh evaluations of the log density and condense the particles from them, which the material evens out; off: a body moves from its start in the target's frame [default: on]
    #[arg(long)]
    survey: Switch,
    /// Evaluations of the survey, of all kinds, at most
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    evaluations: EvaluationCount,
    /// Move the basis' origin and draw its spacing every step
    #[arg(long)]
    shifts: Switch,
    /// Turn the lattice at random every step
    #[arg(long)]
    rotation: Switch,
    /// Largest over smallest spacing that a run draws from, at least 1
    #[arg(long, value_name = "RATIO", allow_negative_numbers = true)]
    spacing_range: f64,
    /// Spacing of the first step over the central one, at least 1
    #[arg(long, value_name = "RATIO", allow_negative_numbers = true)]
    coarse_start: f64,
    /// Share of the steps over which the time step falls at the end, from 0 to below 1
    #[arg(long, value_name = "SHARE", allow_negative_numbers = true)]
    settling: f64,
    /// Go on shifting while settling
    #[arg(long)]
    settling_shifts: Switch,
    /// What a last affine move of all particles puts right
    #[arg(long)]
    moment_correction: Correction,
    /// Velocity transfer
    #[arg(long)]
    transfer: Transfer,
    /// Share of FLIP in the velocities, from 0 to 1; mpm: with --transfer flip or affine-flip [default: 0.95; paper-*: 0]
    #[arg(long, value_name = "A", allow_negative_numbers = true)]
    flip_share: f64,
    /// Friction, per unit of time
    #[arg(long, value_name = "GAMMA", allow_negative_numbers = true)]
    friction: f64,
    /// Rounds of the steps, at most: after a survey while they bring the particles nearer, 0: none; without one while they are still on their way [default: 4; with --survey off: 3, with --steps too: 1]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    rounds: RoundCount,
    /// More particles than their share for light parts of the target, with weights; after a survey [default: off]
    #[arg(long)]
    weighted: Switch,
    /// Judge the particles at the end (mpm, paper-*) [default: on]
    #[arg(long)]
    non_finite: NonFinite,
    /// Judge the particles at the end
    #[arg(long)]
    certificate: Switch,
    /// The algorithms exactly as the paper writes them: the target's own coordinates, no guard; every departure can be set beside it
    #[arg(long, num_args = 0..=1, default_missing_value = "on")]
    as_written: Switch,
    /// Coordinates that the body moves in; identity: the target's own, also those of spacing and start [default: target; with --as-written: identity]
    #[arg(long)]
    frame: FrameName,
    /// Constitutive law, by the names of the scenes [default: neo-hookean]
    #[arg(long)]
    material: Material,
    /// Young's modulus E (solids) [default: 1]
    #[arg(long, value_name = "E", alias = "young-modulus", allow_negative_numbers = true)]
    #[serde(alias = "young-modulus")]
    youngs_modulus: f64,
    /// Poisson's ratio (solids) [default: 0.3]
    #[arg(long, value_name = "NU", alias = "poisson-ratio", allow_negative_numbers = true)]
    #[serde(alias = "poisson-ratio")]
    poissons_ratio: f64,
    /// Yield stress at first, as |dev tau|; softening-hencky [default: 0.1]
    #[arg(long, value_name = "KAPPA", allow_negative_numbers = true)]
    peak_yield_stress: f64,
    /// Yield stress that softening ends at; softening-hencky [default: the first one: perfect plasticity]
    #[arg(long, value_name = "KAPPA", allow_negative_numbers = true)]
    residual_yield_stress: f64,
    /// Rate of softening, per plastic strain; softening-hencky [default: 0]
    #[arg(long, value_name = "ETA", allow_negative_numbers = true)]
    softening_rate: f64,
    /// Friction angle in degrees; drucker-prager [default: 30]
    #[arg(long, value_name = "PHI", allow_negative_numbers = true)]
    friction_angle: f64,
    /// Cohesion, a stress; drucker-prager [default: 0]
    #[arg(long, value_name = "C", allow_negative_numbers = true)]
    cohesion: f64,
    /// Density at rest, mass per reference volume; tait-fluid [default: 1]
    #[arg(long, value_name = "RHO", allow_negative_numbers = true)]
    density: f64,
    /// Speed of sound at rest; tait-fluid [default: 1]
    #[arg(long, value_name = "C", allow_negative_numbers = true)]
    sound_speed: f64,
    /// Viscosity, stress times time; kelvin-voigt, tait-fluid [default: 0.1; tait-fluid: 0]
    #[arg(long, value_name = "ETA", allow_negative_numbers = true)]
    viscosity: f64,
    /// Forget volumes above that of rest; tait-fluid [default: off]
    #[arg(long)]
    forgets_expansion: Switch,
    /// Pressure per density kappa; at rest the density is p^(alpha/kappa); isothermal-gas [default: 1]
    #[arg(long, value_name = "KAPPA", allow_negative_numbers = true)]
    pressure_per_density: f64,
    /// Constant factor before the score; paper-*: of either sign
    #[arg(long, allow_negative_numbers = true)]
    alpha: f64,
    /// Factor before the score in the first step, with --alpha-to
    #[arg(long, value_name = "ALPHA", allow_negative_numbers = true)]
    alpha_from: f64,
    /// Factor before the score in the last step, mpm: when settling begins, with --alpha-from
    #[arg(long, value_name = "ALPHA", allow_negative_numbers = true)]
    alpha_to: f64,
    /// How the factor goes from the one to the other [default: geometric]
    #[arg(long)]
    alpha_schedule: AlphaSchedule,
    /// Times that a cyclic schedule goes from the one to the other [default: 4]
    #[arg(long, value_name = "C", allow_negative_numbers = true)]
    alpha_cycles: StepCount,
    /// A new grid, with its origin drawn anew, every so many steps; default: one grid, with nodes at the integer multiples of the spacing
    #[arg(long, value_name = "STEPS", allow_negative_numbers = true)]
    grid_renewal: StepCount,
    /// Masses of the particles: `equal`, 1/M each, or a file with a column of them [default: equal]
    #[arg(long, value_name = "equal|FILE.csv|.npy")]
    masses: PathBuf,
    /// Reference volumes: `uniform`, 1/M each; `start-density`, mass over density of the start's law; `grid`, mass over density on the grid; or a file with a column of them [default: uniform]
    #[arg(long, value_name = "uniform|start-density|grid|FILE.csv|.npy")]
    volumes: PathBuf,
    /// Velocities at the start: `zero`, or a file with a column per dimension [default: zero]
    #[arg(long, value_name = "zero|FILE.csv|.npy")]
    velocities: PathBuf,
    /// What is watched on the way to find the best configuration [default with --best, --monitor-every or --patience: stein]
    #[arg(long)]
    monitor: MonitorName,
    /// Look every so many steps [default: 10]
    #[arg(long, value_name = "STEPS", allow_negative_numbers = true)]
    monitor_every: StepCount,
    /// End the run after so many looks in a row that were not better than the best one by a hundredth [default: take all steps]
    #[arg(long, value_name = "LOOKS", allow_negative_numbers = true)]
    patience: StepCount,
    /// File of the best configuration on the way, .csv or .npy
    #[arg(long, value_name = "FILE.csv|.npy")]
    best: PathBuf,
    /// All guards at once; single guards can be set beside it
    #[arg(long)]
    guards: Switch,
    /// Nodes lighter than this share of the mean particle mass get no force, 0: off
    #[arg(long, value_name = "SHARE", allow_negative_numbers = true)]
    mass_floor: f64,
    /// Multiply the force by the nodal mass
    #[arg(long)]
    mass_weighted_force: Switch,
    /// Courant number that limits the time step, or `off`
    #[arg(long, value_name = "C|off", allow_negative_numbers = true)]
    courant: Limit,
    /// Largest principal stretch of a particle and, inverted, the least, or `off` [default: 1000]
    #[arg(long, value_name = "K|off", allow_negative_numbers = true)]
    stretch_limit: Limit,
    /// Step size of the optimiser
    #[arg(long, value_name = "SIZE", allow_negative_numbers = true)]
    step_size: f64,
    /// Fixed kernel bandwidth instead of the median rule
    #[arg(long, allow_negative_numbers = true)]
    bandwidth: f64,
    /// Draws per chain that tune the sampler and are thrown away; stein-thinning: with --pool nuts
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    warm_up: WarmUp,
    /// Chains that share the draws out; stein-thinning: with --pool nuts
    #[arg(long, value_name = "C", allow_negative_numbers = true)]
    chains: StepCount,
    /// Keep every K-th draw; stein-thinning: with --pool nuts
    #[arg(long, value_name = "K", allow_negative_numbers = true)]
    thinning: StepCount,
    /// Acceptance that the step size is tuned to, between 0 and 1; stein-thinning: with --pool nuts
    #[arg(long, value_name = "A", allow_negative_numbers = true)]
    target_acceptance: f64,
    /// What the draws are chosen from, `exact` or `nuts` (stein-thinning); file for the weighted pool
    #[arg(long, value_name = "exact|nuts|FILE.csv|.npy")]
    pool: PathBuf,
    /// Size of the bigger sample, at least the number of particles
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pool_size: ParticleCount,
    /// End when no point moves farther, in units of the sample's spread
    #[arg(long, value_name = "TOL", allow_negative_numbers = true)]
    tolerance: f64,
    /// File of the positions at the start, a row per particle, in the target's own coordinates; mpm: with --survey off
    #[arg(long, value_name = "FILE.csv|.npy")]
    start: PathBuf,
    /// Target whose draws the particles start at, in its own coordinates: the paper's p0 by name; mpm: with --survey off
    #[arg(long, value_name = "TARGET")]
    start_law: String,
    /// Mean of a normal law to start from, in the target's own coordinates; mpm: with --survey off
    #[arg(long, value_name = "M1,M2,...", allow_hyphen_values = true)]
    start_centre: String,
    /// Its covariance, the rows between semicolons; mpm: with --survey off [default: identity]
    #[arg(long, value_name = "C11,C12,...;C21,...", allow_hyphen_values = true)]
    start_covariance: String,
    /// Mean of every coordinate at the start, in units of the target's scale
    #[arg(long, value_name = "MEAN", allow_negative_numbers = true)]
    start_mean: f64,
    /// Standard deviation of every coordinate at the start
    #[arg(long, value_name = "SD", allow_negative_numbers = true)]
    start_sd: f64,
    /// How the particles are drawn from their initial law
    #[arg(long)]
    start_draws: Draws,
}

impl MethodOptions {
    /// The method for the sampler.
    ///
    /// # Errors
    /// The first option that does not fit the method, contradicts another one or lies outside of its range.
    pub fn method(&self, name: MethodName) -> Result<Method, OptionError> {
        self.check_fit(name)?;
        self.check_ranges()?;
        self.check_pairs(name)?;
        self.check_starts(name)?;
        self.check_pool(name)?;
        (name.kind().build)(self, self.steps.map(StepCount::get))
    }

    /// Refuses options that the method does not have.
    fn check_fit(&self, method: MethodName) -> Result<(), OptionError> {
        match self.given().find(|(name, _)| !method.kind().has(name)) {
            Some((name, value)) => Err(OptionError::misfit(&name, &value, method.as_str())),
            None => Ok(()),
        }
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

    /// The flags that say the same on the command line.
    pub fn flags(&self) -> Vec<String> {
        self.given()
            .flat_map(|(name, value)| [format!("--{name}"), value])
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use clap::ValueEnum;

    use super::*;

    #[test]
    fn every_option_is_one_of_some_method_and_no_method_has_others() {
        let names = MethodOptions::names();
        let owned: Vec<&str> = MethodName::value_variants()
            .iter()
            .flat_map(|method| method.kind().options.split(' '))
            .filter(|option| !option.is_empty())
            .collect();
        assert!(owned.iter().all(|option| names.iter().any(|name| name == option)));
        assert!(names.iter().all(|name| owned.contains(&name.as_str())));
    }
}
