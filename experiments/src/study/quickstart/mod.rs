//! Study `quickstart`: a posterior from real data against its reference, and a two-dimensional target for the eye.

mod comparison;
mod configuration;
mod figures;
mod reference;
mod report;

use std::time::Instant;

use parvi::Run;
use serde::{Deserialize, Serialize};

use configuration::Part;
pub use configuration::Quickstart;
use reference::ReferenceTask;

use super::attempt::{Attempt, Status, attempt};
use super::definition::{self, Report, Study};
use super::directory::StudyDirectory;
use super::trace_row::TraceRow;
use super::{results, table_file};
use crate::CommandError;
use crate::dispatch::with_target;
use crate::options::Bounded;
use crate::output::ParticleFile;
use crate::progress::CaseObserver;
use crate::sampling;

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

/// What a case gave. `wall_seconds` depends on the machine, everything else only on the seeds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    case: String,
    status: Status,
    reason: String,
    target: String,
    dim: usize,
    method: String,
    particles: usize,
    steps: Option<usize>,
    score_evaluations: Option<u64>,
    density_evaluations: Option<u64>,
    residual: Option<f64>,
    spacing: Option<f64>,
    active_nodes: Option<usize>,
    storage_bytes: Option<usize>,
    effective_sample_size: Option<f64>,
    wall_seconds: Option<f64>,
}

impl results::Row for Row {
    fn case(&self) -> &str {
        &self.case
    }
}

impl Row {
    fn new(case: Case, part: &Part, method: &str, particles: usize) -> Result<Self, CommandError> {
        Ok(Self {
            case: case.name().to_owned(),
            status: Status::Finished,
            reason: String::new(),
            target: part.target.label(),
            dim: part.target.dimension()?,
            method: method.to_owned(),
            particles,
            steps: None,
            score_evaluations: None,
            density_evaluations: None,
            residual: None,
            spacing: None,
            active_nodes: None,
            storage_bytes: None,
            effective_sample_size: None,
            wall_seconds: None,
        })
    }
}

impl Study for Quickstart {
    type Case = Case;
    type Row = Row;
    type Shared = ();

    const KIND: &'static str = "quickstart";

    fn seeds(&self) -> Vec<u64> {
        vec![self.seed]
    }

    fn threads(&self) -> Option<usize> {
        self.threads.map(Bounded::get)
    }

    fn cases(&self) -> Result<Vec<Case>, CommandError> {
        self.check()?;
        Ok(vec![Case::Reference, Case::Posterior, Case::Picture])
    }

    fn run(
        &self,
        case: &Case,
        (): &mut (),
        directory: &StudyDirectory,
        observer: &mut CaseObserver,
    ) -> Result<Row, CommandError> {
        match case {
            Case::Reference => self.run_reference(directory),
            Case::Posterior => self.run_sampler(*case, &self.posterior, directory, observer),
            Case::Picture => self.run_sampler(*case, &self.picture, directory, observer),
        }
    }

    fn report(&self, rows: &[Row], directory: &StudyDirectory) -> Result<Report, CommandError> {
        report::report(self, rows, directory)
    }
}

impl Quickstart {
    fn run_reference(&self, directory: &StudyDirectory) -> Result<Row, CommandError> {
        let target = &self.posterior.target;
        let begin = Instant::now();
        let task = ReferenceTask {
            part: &self.reference,
            names: target.coordinate_names(),
        };
        let reference = with_target(target, task)?;
        let wall_seconds = begin.elapsed().as_secs_f64();
        reference::write(&reference.axes, &moments_file(directory))?;
        ParticleFile::create(Case::Reference.particles_file(directory))?.write(&reference.draws, &[])?;
        let mut row = Row::new(
            Case::Reference,
            &self.posterior,
            "importance-sampling",
            self.reference.points.get(),
        )?;
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
    ) -> Result<Row, CommandError> {
        let mut specification = part.method.clone();
        specification.options.trace_every = self.trace_every.get();
        let method = specification.method(None)?;
        let mut run = Run::new(part.particles.get(), self.seed);
        run.start = specification.options.start();
        let mut row = Row::new(case, part, part.method.label(), run.particles)?;
        match attempt(sampling::sample(&part.target, &method, &run, observer))? {
            Attempt::Failed(status, reason) => (row.status, row.reason) = (status, reason),
            Attempt::Finished(outcome) => {
                ParticleFile::create(case.particles_file(directory))?.write(&outcome.particles, &[])?;
                table_file::write(outcome.trace.iter().map(TraceRow::from), &case.trace_file(directory))?;
                row.steps = Some(outcome.steps);
                row.score_evaluations = Some(outcome.score_evaluations);
                row.density_evaluations = Some(outcome.density_evaluations);
                row.residual = outcome.residual;
                row.spacing = outcome.spacing;
                row.active_nodes = outcome.active_nodes;
                row.storage_bytes = outcome.storage_bytes;
                row.wall_seconds = Some(outcome.wall_seconds);
            }
        }
        Ok(row)
    }
}
