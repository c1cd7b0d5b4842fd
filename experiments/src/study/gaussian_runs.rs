//! Runs on the standard Gaussian N(0, I), measured in the exact squared energy distance: what several studies share.

use parvi::{Method, Run};
use parvi_metrics::{Cloud, GaussianEnergy};
use parvi_targets::BoxedTarget;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::attempt::{Attempt, Status, attempt};
use super::definition::{self, Report, Study};
use super::directory::StudyDirectory;
use super::document::Document;
use super::results::{self, single_line};
use crate::CommandError;
use crate::dispatch::{TargetTask, with_target};
use crate::options::{
    Basis, Bounded, Dimension, MethodName, MethodSpecification, ParticleCount, StepCount, TargetSpecification,
};
use crate::output::Particles;
use crate::progress::CaseObserver;
use crate::sampling::{self, Outcome};
use crate::statistics::summarize;

/// The configuration of a study all of whose cases are such runs.
pub trait GaussianPlan: DeserializeOwned + Sync {
    /// One run per seed.
    fn seeds(&self) -> &[u64];

    /// Threads; `None`: as many as the environment gives.
    fn threads(&self) -> Option<Bounded<1, 1024>>;

    /// As [`Study::cases`].
    ///
    /// # Errors
    /// Parts of the configuration that do not fit together.
    fn cases(&self) -> Result<Vec<Case>, CommandError>;
}

/// A study all of whose cases are such runs.
pub trait GaussianStudy: GaussianPlan {
    /// The `kind` in the configuration.
    const KIND: &'static str;

    /// As [`Study::report`].
    ///
    /// # Errors
    /// Figures or files that cannot be made.
    fn report(&self, rows: &[Row], directory: &StudyDirectory) -> Result<Report, CommandError>;
}

impl<S: GaussianStudy> Study for S {
    type Case = Case;
    type Row = Row;
    type Shared = ();

    const KIND: &'static str = S::KIND;

    fn seeds(&self) -> Vec<u64> {
        GaussianPlan::seeds(self).to_vec()
    }

    fn threads(&self) -> Option<usize> {
        GaussianPlan::threads(self).map(Bounded::get)
    }

    fn cases(&self) -> Result<Vec<Case>, CommandError> {
        GaussianPlan::cases(self)
    }

    fn run(
        &self,
        case: &Case,
        (): &mut (),
        _directory: &StudyDirectory,
        observer: &mut CaseObserver,
    ) -> Result<Row, CommandError> {
        run_case(case, observer)
    }

    fn report(&self, rows: &[Row], directory: &StudyDirectory) -> Result<Report, CommandError> {
        GaussianStudy::report(self, rows, directory)
    }
}

/// One run.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// d.
    pub dim: Dimension,
    /// M.
    pub particles: usize,
    /// The method or basis, as tables and figures name it.
    pub series: String,
    /// The sampler with all its options.
    pub method: MethodSpecification,
    /// The spacing in units of the basis's own default; `None` where the study does not vary it so.
    pub spacing_factor: Option<f64>,
    /// Seed of the run.
    pub seed: u64,
}

impl definition::Case for Case {
    fn id(&self) -> String {
        let mut id = format!("d{}-m{}-{}", self.dim, self.particles, self.series);
        match (self.spacing_factor, self.method.options.spacing) {
            (Some(factor), _) => id.push_str(&format!("-f{factor}")),
            (None, Some(spacing)) => id.push_str(&format!("-h{spacing}")),
            (None, None) => {}
        }
        if let Some(steps) = self.method.options.steps {
            id.push_str(&format!("-t{steps}"));
        }
        format!("{id}-s{}", self.seed)
    }

    fn cost(&self) -> f64 {
        // Microseconds, roughly: the pairs of the energy distance, and per step M² pairs or M nodes times those of a stencil.
        let (count, steps) = (self.particles as f64, self.method.options.steps.map(StepCount::get));
        let sampling = match self.method.name {
            MethodName::Iid | MethodName::Sobol => 0.0,
            MethodName::Ais => 100.0 * count,
            MethodName::Svgd => steps.unwrap_or(500) as f64 * 3e-3 * count * count,
            MethodName::Nuts => 10.0 * (count + 2e3),
            MethodName::SteinThinning => 5e-3 * count * self.pool_size(),
            MethodName::SupportPoints => steps.unwrap_or(100) as f64 * 2e-3 * count * self.pool_size(),
            _ => {
                let dim = self.dim.get();
                let nodes = match self.method.options.basis.unwrap_or(Basis::Lattice) {
                    Basis::Lattice | Basis::Mesh => dim as f64 + 1.0,
                    Basis::Linear => 2f64.powi(dim as i32),
                    Basis::Quadratic => 3f64.powi(dim as i32),
                    Basis::Cubic => 4f64.powi(dim as i32),
                };
                steps.unwrap_or(100) as f64 * 1e-2 * count * nodes
            }
        };
        1e3 + 1e-3 * count * count + sampling
    }
}

impl Case {
    /// The size of the sample that the particles are condensed from.
    fn pool_size(&self) -> f64 {
        let size = self.method.options.pool_size.map(ParticleCount::get);
        size.unwrap_or_else(|| parvi::defaults::pool_size(self.particles)) as f64
    }
}

/// What a run gave. Columns that begin with `wall` depend on the machine; the others only on the seed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// The case's name.
    pub case: String,
    /// How the run ended.
    pub status: Status,
    /// Why it gave nothing.
    pub reason: String,
    /// d.
    pub dim: usize,
    /// M.
    pub particles: usize,
    /// The method or basis.
    pub series: String,
    /// The spacing in units of the default, where it was asked for so.
    pub spacing_factor: Option<f64>,
    /// The spacing h asked for.
    pub requested_spacing: Option<f64>,
    /// The steps asked for.
    pub requested_steps: Option<usize>,
    /// Seed of the run.
    pub seed: u64,
    /// Squared energy distance from N(0, I), exact in the expectation over the Gaussian.
    pub energy_distance_squared: Option<f64>,
    /// Expectation of the same for M independent draws, E‖Y − Y'‖ / M.
    pub energy_level: f64,
    /// Steps taken.
    pub steps: Option<usize>,
    /// Evaluations of the score at one point.
    pub score_evaluations: Option<u64>,
    /// Evaluations of the log density at one point.
    pub density_evaluations: Option<u64>,
    /// Spacing h used, in standard deviations.
    pub spacing: Option<f64>,
    /// Nodes with mass in the last step.
    pub active_nodes: Option<usize>,
    /// Time of the sampler alone.
    pub wall_seconds: Option<f64>,
}

impl results::Row for Row {
    fn case(&self) -> &str {
        &self.case
    }
}

/// A quantity of a row, where the run has it.
pub type Quantity = fn(&Row) -> Option<f64>;
/// Squared energy distance.
pub const ENERGY: Quantity = |row| row.energy_distance_squared;
/// Its root, the energy distance.
pub const ENERGY_ROOT: Quantity = |row| row.energy_distance_squared.map(|value| value.max(0.0).sqrt());
/// Wall time.
pub const SECONDS: Quantity = |row| row.wall_seconds;
/// Active nodes per particle.
pub const NODES_PER_PARTICLE: Quantity = |row| Some(row.active_nodes? as f64 / row.particles as f64);

/// The values of a quantity in those rows that have it.
pub fn values(rows: &[&Row], quantity: Quantity) -> Vec<f64> {
    rows.iter().filter_map(|row| quantity(row)).collect()
}

/// The median of a quantity over the rows that have it.
pub fn median(rows: &[&Row], quantity: Quantity) -> Option<f64> {
    summarize(&values(rows, quantity)).ok().map(|summary| summary.median)
}

/// The largest value of a quantity in the rows that have it.
pub fn largest(rows: &[&Row], quantity: Quantity) -> Option<f64> {
    values(rows, quantity).into_iter().reduce(f64::max)
}

/// Names the runs that gave nothing, with their reasons; says nothing if there are none.
pub fn failures(rows: &[Row], document: &mut Document) {
    let failed: Vec<String> = rows
        .iter()
        .filter(|row| row.status != Status::Finished)
        .map(|row| format!("- `{}`: {}: {}", row.case, row.status.as_str(), row.reason))
        .collect();
    if !failed.is_empty() {
        document.heading("Runs that did not finish");
        document.paragraph(failed.join("\n"));
    }
}

/// Runs a case: samples N(0, I) and measures the particles. A run that diverges is a row with its reason.
pub fn run_case(case: &Case, observer: &mut CaseObserver) -> Result<Row, CommandError> {
    let method = case.method.method(None)?;
    let mut run = Run::new(case.particles, case.seed);
    run.start = case.method.options.start();
    let steps = case.method.options.steps.map(StepCount::get);
    let mut row = Row {
        case: definition::Case::id(case),
        status: Status::Finished,
        reason: String::new(),
        dim: case.dim.get(),
        particles: case.particles,
        series: case.series.clone(),
        spacing_factor: case.spacing_factor,
        requested_spacing: case.method.options.spacing,
        requested_steps: steps,
        seed: case.seed,
        energy_distance_squared: None,
        energy_level: energy_level(case.dim, case.particles)?,
        steps: None,
        score_evaluations: None,
        density_evaluations: None,
        spacing: None,
        active_nodes: None,
        wall_seconds: None,
    };
    match measured(case.dim, &method, &run, observer)? {
        Attempt::Failed(status, reason) => (row.status, row.reason) = (status, reason),
        Attempt::Finished((outcome, energy)) => {
            row.energy_distance_squared = Some(energy);
            row.steps = Some(outcome.steps);
            row.score_evaluations = Some(outcome.score_evaluations);
            row.density_evaluations = Some(outcome.density_evaluations);
            row.spacing = outcome.spacing;
            row.active_nodes = outcome.active_nodes;
            row.wall_seconds = Some(outcome.wall_seconds);
        }
    }
    Ok(row)
}

/// Samples N(0, I) and measures the particles' squared energy distance from it.
pub fn measured(
    dim: Dimension,
    method: &Method,
    run: &Run,
    observer: &mut CaseObserver,
) -> Result<Attempt<(Outcome, f64)>, CommandError> {
    let outcome = match attempt(sampling::sample(&standard_gaussian(dim), method, run, observer))? {
        Attempt::Finished(outcome) => outcome,
        Attempt::Failed(status, reason) => return Ok(Attempt::Failed(status, reason)),
    };
    let particles = &outcome.particles;
    match with_target(&standard_gaussian(dim), Measure { particles }) {
        Ok(energy) => Ok(Attempt::Finished((outcome, energy))),
        // A cloud so far out that a distance overflows has diverged as well.
        Err(CommandError::Metric(error)) => Ok(Attempt::Failed(Status::Diverged, single_line(error))),
        Err(error) => Err(error),
    }
}

/// E‖Y − Y'‖ / M for Y, Y' ~ N(0, I): the expected squared energy distance of M independent draws.
pub fn energy_level(dim: Dimension, particles: usize) -> Result<f64, CommandError> {
    Ok(with_target(&standard_gaussian(dim), MeanDistance)? / particles as f64)
}

/// The spacing that the calibrated sampler would choose with a basis.
pub fn default_spacing(dim: Dimension, basis: Basis, particles: usize) -> Result<f64, CommandError> {
    with_target(&standard_gaussian(dim), DefaultSpacing { basis, particles })
}

fn standard_gaussian(dim: Dimension) -> TargetSpecification {
    TargetSpecification::plain("gaussian", Some(dim))
}

struct Measure<'a> {
    particles: &'a Particles,
}

impl TargetTask for Measure<'_> {
    type Output = f64;

    fn run<const D: usize>(self, _target: BoxedTarget<D>) -> Result<f64, CommandError> {
        let points = self.particles.points::<D>().unwrap_or_default();
        let cloud = Cloud::with_optional_weights(&points, self.particles.weights())?;
        Ok(GaussianEnergy::<D>::standard()?.squared(&cloud)?)
    }
}

struct MeanDistance;

impl TargetTask for MeanDistance {
    type Output = f64;

    fn run<const D: usize>(self, _target: BoxedTarget<D>) -> Result<f64, CommandError> {
        Ok(GaussianEnergy::<D>::standard()?.mean_distance())
    }
}

struct DefaultSpacing {
    basis: Basis,
    particles: usize,
}

impl TargetTask for DefaultSpacing {
    type Output = f64;

    fn run<const D: usize>(self, _target: BoxedTarget<D>) -> Result<f64, CommandError> {
        Ok(parvi::defaults::spacing::<D>(
            self.basis.uniform().unwrap_or_default(),
            self.particles,
        ))
    }
}
