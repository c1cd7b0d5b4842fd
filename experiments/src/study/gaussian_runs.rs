//! Runs on the standard Gaussian N(0, I), measured in the exact squared energy distance: what several studies share.

use parvi::{Method, Run};
use parvi_metrics::{Cloud, GaussianEnergy};
use serde::de::DeserializeOwned;

use super::attempt::{Attempt, Status, attempt};
use super::definition::{self, Report, Study, Work};
use super::directory::StudyDirectory;
use super::results::single_line;
use super::run_row::RunRow;
use crate::CommandError;
use crate::dispatch::in_dimension;
use crate::options::{
    Basis, Dimension, MethodName, MethodSpecification, ParticleCount, StepCount, TargetSpecification,
};
use crate::output::Particles;
use crate::progress::CaseObserver;
use crate::sampling::{self, Outcome};

/// A study all of whose cases are such runs.
pub trait GaussianStudy: DeserializeOwned + Sync {
    /// The `kind` in the configuration.
    const KIND: &'static str;

    /// As [`Study::cases`].
    ///
    /// # Errors
    /// Parts of the configuration that do not fit together.
    fn cases(&self) -> Result<Vec<Case>, CommandError>;

    /// As [`Study::report`].
    fn report(&self, rows: &[RunRow]) -> Report;
}

impl<S: GaussianStudy> Study for S {
    type Case = Case;
    type Row = RunRow;
    type Shared = ();

    const KIND: &'static str = S::KIND;
    const COLUMNS: &'static str = "case status reason dim particles series spacing_factor requested_spacing requested_steps seed \
         energy_distance_squared energy_level steps score_evaluations density_evaluations spacing active_nodes wall_seconds";

    fn cases(&self) -> Result<Vec<Case>, CommandError> {
        GaussianStudy::cases(self)
    }

    fn run(&self, case: &Case, work: Work<'_, ()>) -> Result<RunRow, CommandError> {
        run_case(case, work.observer)
    }

    fn report(&self, rows: &[RunRow], _: &StudyDirectory) -> Result<Report, CommandError> {
        Ok(GaussianStudy::report(self, rows))
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

impl Case {
    /// A case for every seed.
    pub fn of_seeds<'a>(self, seeds: &'a [u64]) -> impl Iterator<Item = Self> + use<'a> {
        seeds.iter().map(move |&seed| Self { seed, ..self.clone() })
    }
}

/// Runs a case: samples N(0, I) and measures the particles. A run that diverges is a row with its reason.
fn run_case(case: &Case, observer: &mut CaseObserver) -> Result<RunRow, CommandError> {
    let method = case.method.method(None)?;
    let run = case.method.run(case.particles, case.seed);
    let mut row = RunRow {
        dim: case.dim.get(),
        particles: case.particles,
        series: case.series.clone(),
        spacing_factor: case.spacing_factor,
        requested_spacing: case.method.options.spacing,
        requested_steps: case.method.options.steps.map(StepCount::get),
        seed: Some(case.seed),
        energy_level: Some(energy_level(case.dim, case.particles)?),
        ..RunRow::new(case)
    };
    match measured(case.dim, &method, &run, observer)? {
        Attempt::Failed(status, reason) => row.fail(status, reason),
        Attempt::Finished((outcome, energy)) => {
            row.take(&outcome);
            row.energy_distance_squared = Some(energy);
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
    match in_dimension!("gaussian", dim.get(), D => energy::<D>(&outcome.particles)) {
        Ok(energy) => Ok(Attempt::Finished((outcome, energy))),
        // A cloud so far out that a distance overflows has diverged as well.
        Err(CommandError::Metric(error)) => Ok(Attempt::Failed(Status::Diverged, single_line(error))),
        Err(error) => Err(error),
    }
}

/// The squared energy distance of particles from N(0, I).
fn energy<const D: usize>(particles: &Particles) -> Result<f64, CommandError> {
    let points = particles.points::<D>().unwrap_or_default();
    let cloud = Cloud::with_optional_weights(&points, particles.weights())?;
    Ok(GaussianEnergy::<D>::standard()?.squared(&cloud)?)
}

/// E‖Y − Y'‖ / M for Y, Y' ~ N(0, I): the expected squared energy distance of M independent draws.
pub fn energy_level(dim: Dimension, particles: usize) -> Result<f64, CommandError> {
    in_dimension!("gaussian", dim.get(), D => Ok(GaussianEnergy::<D>::standard()?.mean_distance() / particles as f64))
}

/// The spacing that the calibrated sampler would choose with a basis.
pub fn default_spacing(dim: Dimension, basis: Basis, particles: usize) -> Result<f64, CommandError> {
    let basis = basis.uniform().unwrap_or_default();
    in_dimension!("gaussian", dim.get(), D => Ok(parvi::defaults::spacing::<D>(basis, particles)))
}

fn standard_gaussian(dim: Dimension) -> TargetSpecification {
    TargetSpecification::plain("gaussian", Some(dim))
}
