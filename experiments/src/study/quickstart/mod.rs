//! Study `quickstart`: a posterior from real data against its reference, and a two-dimensional target for the eye.

mod comparison;
mod figures;
mod reference;
mod report;

use std::time::Instant;

use serde::Deserialize;

use reference::Reference;

use super::attempt::attempt;
use super::checks::{positive, refusal};
use super::definition::{self, Report, Study, Work};
use super::directory::StudyDirectory;
use super::run_row::RunRow;
use crate::CommandError;
use crate::dispatch::on_target;
use crate::options::{Bounded, MethodSpecification, ParticleCount, TargetSpecification};
use crate::output::{ParticleFile, table_file};
use crate::progress::CaseObserver;
use crate::sampling;

/// A posterior against its reference, and a two-dimensional target for the eye.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Quickstart {
    /// Seed of both runs.
    seed: u64,
    /// Steps between two entries of the trace.
    trace_every: Bounded<1, 1_000_000>,
    /// The posterior.
    posterior: Part,
    /// Its reference.
    reference: ReferencePart,
    /// What the posterior has to keep.
    bounds: Bounds,
    /// The target for the eye; d = 2.
    picture: Part,
}

/// A target, a method and a size.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct Part {
    /// Target.
    target: TargetSpecification,
    /// Method.
    method: MethodSpecification,
    /// M.
    particles: ParticleCount,
}

/// Quasi-Monte-Carlo importance sampling with a Student t proposal.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct ReferencePart {
    /// Points in all.
    points: Bounded<1024, 100_000_000>,
    /// Independent scramblings, whose spread gives the standard errors.
    scramblings: Bounded<2, 1024>,
    /// Their seed.
    seed: u64,
    /// Draws resampled from them that are kept for the figures.
    draws: Bounded<100, 1_000_000>,
}

/// The largest errors that count as a pass.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct Bounds {
    /// Of a mean, in posterior standard deviations.
    mean: f64,
    /// Of a standard deviation, relative.
    standard_deviation: f64,
}

impl Quickstart {
    /// Checks what belongs together.
    fn check(&self) -> Result<(), CommandError> {
        let dimension = self.picture.target.dimension()?;
        if dimension != 2 {
            let message = format!("`{}` has d = {dimension}, must be 2", self.picture.target.label());
            return Err(refusal("picture.target", message));
        }
        positive("bounds.mean", &[self.bounds.mean])?;
        positive("bounds.standard-deviation", &[self.bounds.standard_deviation])
    }
}

/// The three pieces of work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Case {
    /// The posterior's reference moments.
    Reference,
    /// The posterior's particles.
    Posterior,
    /// The particles for the eye.
    Picture,
}

impl Case {
    /// Its name in results.csv and in the names of raw files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Reference => "reference",
            Self::Posterior => "posterior",
            Self::Picture => "picture",
        }
    }

    /// The file of its particles.
    fn particles_file(self, directory: &StudyDirectory) -> std::path::PathBuf {
        directory.raw(&format!("{}-particles.csv", self.name()))
    }

    /// The file of its history.
    fn trace_file(self, directory: &StudyDirectory) -> std::path::PathBuf {
        directory.raw(&format!("{}-trace.csv", self.name()))
    }
}

/// The file of the reference moments.
fn moments_file(directory: &StudyDirectory) -> std::path::PathBuf {
    directory.raw("reference-moments.csv")
}

impl definition::Case for Case {
    fn id(&self) -> String {
        self.name().to_owned()
    }

    fn cost(&self) -> f64 {
        match self {
            Self::Reference => 2.0,
            Self::Posterior => 10.0,
            Self::Picture => 1.0,
        }
    }
}

/// The row of a case that has not begun.
fn row(case: Case, part: &Part, method: &str, particles: usize) -> Result<RunRow, CommandError> {
    Ok(RunRow {
        target: part.target.label(),
        dim: part.target.dimension()?,
        method: method.to_owned(),
        particles,
        ..RunRow::new(&case)
    })
}

impl Study for Quickstart {
    type Case = Case;
    type Row = RunRow;
    type Shared = ();

    const KIND: &'static str = "quickstart";
    const COLUMNS: &'static str = "case status reason target dim method particles steps score_evaluations density_evaluations residual \
         spacing active_nodes storage_bytes effective_sample_size wall_seconds";

    fn cases(&self) -> Result<Vec<Case>, CommandError> {
        self.check()?;
        Ok(vec![Case::Reference, Case::Posterior, Case::Picture])
    }

    fn run(&self, case: &Case, work: Work<'_, ()>) -> Result<RunRow, CommandError> {
        match case {
            Case::Reference => self.run_reference(work.directory),
            Case::Posterior => self.run_sampler(*case, &self.posterior, work.directory, work.observer),
            Case::Picture => self.run_sampler(*case, &self.picture, work.directory, work.observer),
        }
    }

    fn report(&self, rows: &[RunRow], directory: &StudyDirectory) -> Result<Report, CommandError> {
        report::report(self, rows, directory)
    }
}

impl Quickstart {
    fn run_reference(&self, directory: &StudyDirectory) -> Result<RunRow, CommandError> {
        let target = &self.posterior.target;
        let begin = Instant::now();
        let names = target.coordinate_names();
        let reference = on_target!(target, target, D => Reference::of::<D>(target.as_ref(), &names, &self.reference))?;
        let wall_seconds = begin.elapsed().as_secs_f64();
        table_file::write(&reference.axes, &moments_file(directory))?;
        ParticleFile::create(Case::Reference.particles_file(directory))?.write(&reference.draws, &[])?;
        let points = self.reference.points.get();
        let mut row = row(Case::Reference, &self.posterior, "importance-sampling", points)?;
        row.effective_sample_size = Some(reference.effective_sample_size);
        row.wall_seconds = Some(wall_seconds);
        Ok(row)
    }

    fn run_sampler(
        &self,
        case: Case,
        part: &Part,
        directory: &StudyDirectory,
        observer: &mut CaseObserver,
    ) -> Result<RunRow, CommandError> {
        let mut specification = part.method.clone();
        specification.options.trace_every = self.trace_every.get();
        let method = specification.method(None)?;
        let run = specification.run(part.particles.get(), self.seed);
        let mut row = row(case, part, part.method.label(), run.particles)?;
        if let Some(outcome) = row.note(attempt(sampling::sample(&part.target, &method, &run, observer))?) {
            ParticleFile::create(case.particles_file(directory))?.write(&outcome.particles, &[])?;
            table_file::write(outcome.trace.iter(), &case.trace_file(directory))?;
        }
        Ok(row)
    }
}
