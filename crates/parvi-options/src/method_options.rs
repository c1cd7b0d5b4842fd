//! The options of all methods.

use clap::Args;
use parvi::{Method, Start};
use serde::Deserialize;

use super::{
    AlphaSchedule, Basis, CondensationName, Correction, Draws, EvaluationCount, FrameName, Limit, Material, MethodName,
    MonitorName, NonFinite, OptionError, ParticleCount, RoundCount, Score, StepCount, Switch, Transfer, WarmUp,
};
use parvi_plot::results::Value;

/// A range for numbers, and its name.
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

/// The options by name, type, what `--help` calls the value and its range, and the list of them; the documentation of an option is what `--help` says.
macro_rules! options {
    ($($(#[$meta:meta])* $name:ident: $type:ty $(= $value_name:literal $(in $range:ident)?)?,)*) => {
        /// Options of the methods; `None`: the method's own default.
        #[derive(Args, Clone, Debug, Default, PartialEq, Deserialize)]
        #[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
        #[command(next_help_heading = "Options of the method")]
        pub struct MethodOptions {
            $(
                $(#[$meta])*
                #[arg(long $(, value_name = $value_name)?)]
                pub $name: Option<$type>,
            )*
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

            /// The options that are set, by the names of columns.
            pub fn values(&self) -> impl Iterator<Item = (&'static str, Value)> {
                let all = [$((stringify!($name), self.$name.clone().map(Value::from))),*];
                all.into_iter().filter_map(|(name, value)| Some((name, value?)))
            }

            /// The options that are set: name, value as typed.
            pub fn given(&self) -> impl Iterator<Item = (String, String)> {
                self.values().map(|(name, value)| (flag(name), value.to_string()))
            }

            /// The options that have a range: name, value, range.
            pub(super) fn ranged(&self) -> Vec<(String, Option<f64>, Range)> {
                vec![$($($((
                    flag(stringify!($name)),
                    self.$name.clone().and_then(|value| Value::from(value).to_string().parse().ok()),
                    $range,
                ),)?)?)*]
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
    steps: StepCount = "T",
    /// Background basis
    basis: Basis,
    /// Mesh of the domain that the density is kept to, a .msh file of Gmsh; with --basis mesh
    mesh: String = "FILE.msh",
    /// Grid spacing in units of the target's scale
    spacing: f64 = "H" in POSITIVE,
    /// Time step
    time_step: f64 = "DT" in POSITIVE,
    /// Where the score is evaluated
    score: Score,
    /// Largest displacement per step in units of the spacing, or `off`; mpm: a number
    displacement_limit: Limit = "C|off" in POSITIVE,
    /// Weigh evaluations of the log density and condense the particles from them; the material evens out what that leaves; off: a body moves from its start in the target's frame [default: on]
    survey: Switch,
    /// Evaluations that the survey is planned with, of all kinds; what it begins with is evaluated in any case
    evaluations: EvaluationCount = "N",
    /// How many times as much is drawn in search of pieces that no proposal has met, at least 1
    search_effort: f64 = "FACTOR" in RATIO,
    /// What particles are made of the pool [default: on]
    condense: CondensationName,
    /// Move the basis' origin and draw its spacing every step
    shifts: Switch,
    /// Turn the lattice at random every step
    rotation: Switch,
    /// Largest over smallest spacing that a run draws from, at least 1
    spacing_range: f64 = "RATIO" in RATIO,
    /// Spacing of the first step over the central one, at least 1
    coarse_start: f64 = "RATIO" in RATIO,
    /// Share of the steps over which the time step falls at the end, from 0 to below 1
    settling: f64 = "SHARE" in BELOW_ONE,
    /// Go on shifting while settling
    settling_shifts: Switch,
    /// What a last affine move of all particles puts right
    moment_correction: Correction,
    /// Velocity transfer
    transfer: Transfer,
    /// Share of FLIP in the velocities, from 0 to 1; mpm: with --transfer flip or affine-flip [default: 0.95; paper-*: 0]
    flip_share: f64 = "A" in SHARE,
    /// Friction, per unit of time
    friction: f64 = "GAMMA" in NOT_NEGATIVE,
    /// Rounds of the steps, at most: after a survey while they bring the particles nearer, 0: none; without one while they are still on their way [default: 4 with --steps, a noisy pool or more than 16384 particles, else 0; with --survey off: 3, with --steps too: 1]
    rounds: RoundCount = "N",
    /// More particles than their share for light parts of the target, with weights; after a survey [default: off]
    weighted: Switch,
    /// What is done about a particle whose score is not finite [default: pull-back]
    non_finite: NonFinite,
    /// Judge the particles at the end [default: on]
    certificate: Switch,
    /// The algorithms exactly as the paper writes them: the target's own coordinates, no guard; every departure can be set beside it
    #[arg(num_args = 0..=1, default_missing_value = "on")]
    as_written: Switch,
    /// Coordinates that the body moves in; identity: the target's own, also those of spacing and start [default: target; with --as-written: identity]
    frame: FrameName,
    /// Constitutive law, by the names of the scenes [default: neo-hookean]
    material: Material,
    /// Young's modulus E (solids) [default: 1]
    #[arg(alias = "young-modulus")]
    #[serde(alias = "young-modulus")]
    youngs_modulus: f64 = "E" in POSITIVE,
    /// Poisson's ratio (solids) [default: 0.3]
    #[arg(alias = "poisson-ratio")]
    #[serde(alias = "poisson-ratio")]
    poissons_ratio: f64 = "NU" in POISSON,
    /// Yield stress at first, as |dev tau|; softening-hencky [default: 0.1]
    peak_yield_stress: f64 = "KAPPA",
    /// Yield stress that softening ends at; softening-hencky [default: the first one: perfect plasticity]
    residual_yield_stress: f64 = "KAPPA",
    /// Rate of softening, per plastic strain; softening-hencky [default: 0]
    softening_rate: f64 = "ETA",
    /// Friction angle in degrees; drucker-prager [default: 30]
    friction_angle: f64 = "PHI",
    /// Cohesion, a stress; drucker-prager [default: 0]
    cohesion: f64 = "C",
    /// Density at rest, mass per reference volume; tait-fluid [default: 1]
    density: f64 = "RHO",
    /// Speed of sound at rest; tait-fluid [default: 1]
    sound_speed: f64 = "C",
    /// Viscosity, stress times time; kelvin-voigt, tait-fluid [default: 0.1; tait-fluid: 0]
    viscosity: f64 = "ETA",
    /// Forget volumes above that of rest; tait-fluid [default: off]
    forgets_expansion: Switch,
    /// Pressure per density kappa; at rest the density is p^(alpha/kappa); isothermal-gas [default: 1]
    pressure_per_density: f64 = "KAPPA",
    /// Constant factor before the score; paper-*: of either sign
    alpha: f64 = "ALPHA" in FINITE,
    /// Factor before the score in the first step, with --alpha-to
    alpha_from: f64 = "ALPHA" in FINITE,
    /// Factor before the score in the last step, mpm: when settling begins, with --alpha-from
    alpha_to: f64 = "ALPHA" in FINITE,
    /// How the factor goes from the one to the other [default: geometric]
    alpha_schedule: AlphaSchedule,
    /// Times that a cyclic schedule goes from the one to the other [default: 4]
    alpha_cycles: StepCount = "C",
    /// A new grid, with its origin drawn anew, every so many steps; default: one grid, with nodes at the integer multiples of the spacing
    grid_renewal: StepCount = "STEPS",
    /// Masses of the particles: `equal`, 1/M each, or a file with a column of them [default: equal]
    masses: String = "equal|FILE.csv|.npy",
    /// Reference volumes: `uniform`, 1/M each; `start-density`, mass over density of the start's law; `grid`, mass over density on the grid; or a file with a column of them [default: uniform]
    volumes: String = "uniform|start-density|grid|FILE.csv|.npy",
    /// Velocities at the start: `zero`, or a file with a column per dimension [default: zero]
    velocities: String = "zero|FILE.csv|.npy",
    /// What is watched on the way to find the best configuration [default with --best, --monitor-every or --patience: stein]
    monitor: MonitorName,
    /// Look every so many steps [default: 10]
    monitor_every: StepCount = "STEPS",
    /// End the run after so many looks in a row that were not better than the best one by a hundredth [default: take all steps]
    patience: StepCount = "LOOKS",
    /// File of the best configuration on the way, .csv or .npy
    best: String = "FILE.csv|.npy",
    /// All guards at once; single guards can be set beside it
    guards: Switch,
    /// Nodes lighter than this share of the mean particle mass get no force, 0: off
    mass_floor: f64 = "SHARE" in NOT_NEGATIVE,
    /// Multiply the force by the nodal mass
    mass_weighted_force: Switch,
    /// Courant number that limits the time step, or `off`
    courant: Limit = "C|off" in POSITIVE,
    /// Largest principal stretch of a particle and, inverted, the least, or `off` [default: 1000]
    stretch_limit: Limit = "K|off" in ABOVE_ONE,
    /// Step size of the optimiser
    step_size: f64 = "SIZE" in POSITIVE,
    /// Fixed kernel bandwidth instead of the median rule
    bandwidth: f64 = "BANDWIDTH" in POSITIVE,
    /// Draws per chain that tune the sampler and are thrown away; stein-thinning: with --pool nuts
    warm_up: WarmUp = "N",
    /// Chains that share the draws out; stein-thinning: with --pool nuts
    chains: StepCount = "C",
    /// Keep every K-th draw; stein-thinning: with --pool nuts
    thinning: StepCount = "K",
    /// Acceptance that the step size is tuned to, between 0 and 1; stein-thinning: with --pool nuts
    target_acceptance: f64 = "A" in BETWEEN,
    /// What the draws are chosen from, `exact` or `nuts` (stein-thinning); file for the weighted pool
    pool: String = "exact|nuts|FILE.csv|.npy",
    /// Size of the bigger sample, at least the number of particles
    pool_size: ParticleCount = "N",
    /// End when no point moves farther, in units of the sample's spread
    tolerance: f64 = "TOL" in NOT_NEGATIVE,
    /// File of the positions at the start, a row per particle, in the target's own coordinates; to a survey their normal law is a first proposal
    start: String = "FILE.csv|.npy",
    /// Target whose draws the particles start at, in its own coordinates: the paper's p0 by name; to a survey the normal law of these is a first proposal
    start_law: String = "TARGET",
    /// Mean of a normal law to start from, in the target's own coordinates; to a survey this law is a first proposal
    #[arg(allow_hyphen_values = true)]
    start_centre: String = "M1,M2,...",
    /// Its covariance, the rows between semicolons [default: identity]
    #[arg(allow_hyphen_values = true)]
    start_covariance: String = "C11,C12,...;C21,...",
    /// Mean of every coordinate at the start, in units of the target's scale
    start_mean: f64 = "MEAN" in FINITE,
    /// Standard deviation of every coordinate at the start
    start_sd: f64 = "SD" in POSITIVE,
    /// How the particles are drawn from their initial law
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
        self.check_rules(name)?;
        (name.kind().build)(self, self.steps.map(StepCount::get))
    }

    /// Refuses options that the method does not have.
    fn check_fit(&self, method: MethodName) -> Result<(), OptionError> {
        let foreign = self.given().find(|(name, _)| !method.kind().has(name));
        let refused = |(name, value): (String, String)| {
            OptionError::foreign(&name, &value, method.as_str(), method.kind().options)
        };
        foreign.map(refused).map_or(Ok(()), Err)
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
        let flags = self.given().map(|(name, value)| [format!("--{name}"), value]);
        flags.flatten().collect()
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
