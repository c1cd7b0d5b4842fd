//! Runs on the standard Gaussian N(0, I), measured in the exact squared energy distance: what several studies share.

use serde::de::DeserializeOwned;

use super::prelude::*;
use super::yardstick::CurrentYardstick;
use crate::dispatch::in_dimension;

/// A study of such runs.
pub trait GaussianStudy: DeserializeOwned + Sync {
    /// The `kind` in the configuration.
    const KIND: &'static str;

    /// Its report.
    const REPORT: Report<Self>;

    /// All cases, in the order in which they run.
    ///
    /// # Errors
    /// Parts of the configuration that do not fit together.
    fn cases(&self) -> Result<Vec<Case<Sampled>>, CommandError>;
}

impl<S: GaussianStudy> Study for S {
    type Work = Sampled;

    const KIND: &'static str = S::KIND;
    const COLUMNS: &'static str = COLUMNS;
    const REPORT: Report<Self> = S::REPORT;

    fn cases(&self) -> Result<Vec<Case<Sampled>>, CommandError> {
        GaussianStudy::cases(self)
    }

    /// Samples N(0, I) and measures the particles. A run that diverges is a row with its reason.
    fn run(&self, case: &Case<Sampled>, row: &mut Row, tools: Tools<'_>) -> Result<(), CommandError> {
        let yardstick = standard_yardstick(&case.work.target, tools.yardstick)?;
        case.work.run(row, yardstick, tools.observer)
    }
}

/// The columns of such runs.
const COLUMNS: &str = "case status reason dim particles series spacing_factor requested_spacing requested_steps seed \
     energy_distance_squared energy_level steps score_evaluations density_evaluations spacing active_nodes wall_seconds";

/// What is run with several seeds.
pub struct Setting<'a> {
    /// d.
    pub dim: Dimension,
    /// M.
    pub particles: usize,
    /// The method or basis, as tables and figures name it.
    pub series: String,
    /// The sampler with all its options.
    pub method: &'a MethodSpecification,
    /// The spacing in units of the basis's own default; `None` where the study does not vary it so.
    pub spacing_factor: Option<f64>,
}

impl<'a> Setting<'a> {
    /// A method as it is.
    pub fn new(dim: Dimension, particles: ParticleCount, method: &'a MethodSpecification) -> Self {
        Self {
            dim,
            particles: particles.get(),
            series: method.label().to_owned(),
            method,
            spacing_factor: None,
        }
    }

    /// A case for every seed.
    ///
    /// # Errors
    /// Options that do not fit the method.
    pub fn cases(&self, seeds: &[u64]) -> Result<Vec<Case<Sampled>>, CommandError> {
        let target = TargetSpecification::plain("gaussian", Some(self.dim));
        let options = &self.method.options;
        let spacing = options.spacing.map(|spacing| format!("-h{spacing}"));
        let spacing = self.spacing_factor.map(|factor| format!("-f{factor}")).or(spacing);
        let steps = options.steps.map(|steps| format!("-t{steps}"));
        let told: String = spacing.into_iter().chain(steps).collect();
        let name = format!("d{}-m{}-{}{told}", self.dim, self.particles, self.series);
        let cases = Sampled::of_seeds((&target, self.method), (self.particles, None), (&name, seeds))?;
        let told = |case: Case<Sampled>| {
            case.with("series", self.series.as_str())
                .with("spacing_factor", self.spacing_factor)
                .with("requested_spacing", options.spacing)
                .with("requested_steps", options.steps)
                .costing(self.cost())
        };
        Ok(cases.into_iter().map(told).collect())
    }

    /// Microseconds, roughly: the pairs of the energy distance, and per step M² pairs or M nodes times those of a stencil.
    fn cost(&self) -> f64 {
        let options = &self.method.options;
        let (count, steps) = (self.particles as f64, options.steps.map(StepCount::get));
        let pool = || {
            let size = options.pool_size.map(ParticleCount::get);
            size.unwrap_or_else(|| parvi::defaults::pool_size(self.particles)) as f64
        };
        let sampling = match self.method.name {
            MethodName::Iid | MethodName::Sobol => 0.0,
            MethodName::Ais => 100.0 * count,
            MethodName::Svgd => steps.unwrap_or(500) as f64 * 3e-3 * count * count,
            MethodName::Nuts => 10.0 * (count + 2e3),
            MethodName::SteinThinning => 5e-3 * count * pool(),
            MethodName::SupportPoints => steps.unwrap_or(100) as f64 * 2e-3 * count * pool(),
            _ => {
                let nodes = options.basis.unwrap_or_default().stencil(self.dim.get());
                steps.unwrap_or(100) as f64 * 1e-2 * count * nodes as f64
            }
        };
        1e3 + 1e-3 * count * count + sampling
    }
}

/// The yardstick of N(0, I), whose energy distance is exact: the points are for the sliced distance, which is not looked at.
///
/// # Errors
/// A dimension that this build lacks.
pub fn standard_yardstick<'a>(
    target: &TargetSpecification,
    current: &'a mut CurrentYardstick,
) -> Result<&'a dyn Yardstick, CommandError> {
    let options = YardstickOptions::of_energy(2, 0, Coordinates::Standardised);
    // Of an exact one there is nothing to note.
    current.of(target, &options, &mut Row::default())
}

/// The spacing that the calibrated sampler would choose with a basis.
///
/// # Errors
/// A dimension that this build lacks.
pub fn default_spacing(dim: Dimension, basis: Basis, particles: usize) -> Result<f64, CommandError> {
    let basis = basis.uniform().unwrap_or_default();
    in_dimension!("gaussian", dim.get(), D => Ok(parvi::defaults::spacing::<D>(basis, particles)))
}
