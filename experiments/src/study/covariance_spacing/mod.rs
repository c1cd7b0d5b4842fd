//! Study `covariance-spacing`: how far the covariance of resting particles is from the target's, against the spacing.
//!
//! For a Gaussian target, resting nodes have exact moments at any spacing; resting particles only approximately,
//! because forces in the null space of the transfer can remain. The study measures what is left: max_ij |Ĉ − I|_ij of
//! M particles that were driven to rest without shifts of the grid and without a moment correction.

mod configuration;
mod report;

use parvi::Run;
use serde::{Deserialize, Serialize};

pub use configuration::CovarianceSpacing;

use super::attempt::{Attempt, Status, attempt};
use super::definition::{self, Report, Study};
use super::directory::StudyDirectory;
use super::moments::SampleMoments;
use super::results;
use crate::options::TargetSpecification;
use crate::progress::CaseObserver;
use crate::{CommandError, sampling};

/// One dimension, spacing and seed.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    dim: crate::options::Dimension,
    spacing: f64,
    seed: u64,
}

impl definition::Case for Case {
    fn id(&self) -> String {
        format!("d{}-h{}-s{}", self.dim, self.spacing, self.seed)
    }

    fn cost(&self) -> f64 {
        3f64.powi(self.dim.get() as i32)
    }
}

/// What a case gave.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    case: String,
    status: Status,
    reason: String,
    dim: usize,
    particles: usize,
    spacing: f64,
    seed: u64,
    steps: Option<usize>,
    covariance_error: Option<f64>,
    mean_error: Option<f64>,
    residual: Option<f64>,
    active_nodes: Option<usize>,
    score_evaluations: Option<u64>,
    density_evaluations: Option<u64>,
    wall_seconds: Option<f64>,
}

impl results::Row for Row {
    fn case(&self) -> &str {
        &self.case
    }
}

impl Study for CovarianceSpacing {
    type Case = Case;
    type Row = Row;
    type Shared = ();

    const KIND: &'static str = "covariance-spacing";

    fn seeds(&self) -> Vec<u64> {
        self.seeds.clone()
    }

    fn threads(&self) -> Option<usize> {
        self.threads.map(crate::options::Bounded::get)
    }

    fn cases(&self) -> Result<Vec<Case>, CommandError> {
        self.check()?;
        let mut cases = Vec::new();
        for series in &self.series {
            for &spacing in &series.spacings {
                cases.extend(self.seeds.iter().map(|&seed| Case {
                    dim: series.dim,
                    spacing,
                    seed,
                }));
            }
        }
        Ok(cases)
    }

    fn run(
        &self,
        case: &Case,
        (): &mut (),
        _directory: &StudyDirectory,
        observer: &mut CaseObserver,
    ) -> Result<Row, CommandError> {
        let mut specification = self.method.clone();
        specification.options.spacing = Some(case.spacing);
        let method = specification.method(None)?;
        let mut run = Run::new(self.particles.get(), case.seed);
        run.start = specification.options.start();
        let target = TargetSpecification::plain("gaussian", Some(case.dim));
        let mut row = Row {
            case: definition::Case::id(case),
            status: Status::Finished,
            reason: String::new(),
            dim: case.dim.get(),
            particles: run.particles,
            spacing: case.spacing,
            seed: case.seed,
            steps: None,
            covariance_error: None,
            mean_error: None,
            residual: None,
            active_nodes: None,
            score_evaluations: None,
            density_evaluations: None,
            wall_seconds: None,
        };
        match attempt(sampling::sample(&target, &method, &run, observer))? {
            Attempt::Failed(status, reason) => (row.status, row.reason) = (status, reason),
            Attempt::Finished(outcome) => {
                let moments = SampleMoments::of(&outcome.particles);
                row.steps = Some(outcome.steps);
                row.covariance_error = Some(moments.distance_from_identity());
                row.mean_error = Some(moments.largest_mean());
                row.residual = outcome.residual;
                row.active_nodes = outcome.active_nodes;
                row.score_evaluations = Some(outcome.score_evaluations);
                row.density_evaluations = Some(outcome.density_evaluations);
                row.wall_seconds = Some(outcome.wall_seconds);
            }
        }
        Ok(row)
    }

    fn report(&self, rows: &[Row], directory: &StudyDirectory) -> Result<Report, CommandError> {
        report::report(self, rows, directory)
    }
}
