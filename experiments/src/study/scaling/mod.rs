//! Study `scaling`: how time per step, memory, active nodes and score evaluations grow with d, M and k.
//!
//! Two sweeps: over d and M with the sampler's own spacing, and over the nodes per axis k of the box that holds the
//! target at fixed M, where a dense grid would hold N = kᵈ nodes. Each case runs once to warm up and then several times on the clock; the
//! median counts. The memory is that of one more run in a process of its own.

mod configuration;
mod memory;
mod quantity;
mod report;

use parvi::Run;
use serde::{Deserialize, Serialize};

pub use configuration::Scaling;

use super::attempt::{Attempt, Status, attempt};
use super::definition::{self, Report, Study};
use super::directory::StudyDirectory;
use super::results;
use crate::options::{Bounded, TargetSpecification};
use crate::progress::CaseObserver;
use crate::sampling::{self, Outcome};
use crate::{CommandError, statistics};

/// Which sweep a case belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Sweep {
    /// Over d and M.
    Particles,
    /// Over k.
    Nodes,
}

/// One size.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    sweep: Sweep,
    dim: crate::options::Dimension,
    particles: usize,
    /// k; `None`: the sampler chooses the spacing.
    nodes_per_axis: Option<usize>,
    /// h in frame units for that k.
    spacing: Option<f64>,
}

impl definition::Case for Case {
    fn id(&self) -> String {
        match self.nodes_per_axis {
            Some(nodes) => format!("nodes-d{}-m{}-k{nodes}", self.dim, self.particles),
            None => format!("particles-d{}-m{}", self.dim, self.particles),
        }
    }

    fn cost(&self) -> f64 {
        self.particles as f64 * 3f64.powi(self.dim.get() as i32) + 1e3
    }
}

/// What a case gave. Columns that begin with `wall` or `memory` depend on the machine; the others only on the seed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    case: String,
    status: Status,
    reason: String,
    sweep: Sweep,
    dim: usize,
    particles: usize,
    nodes_per_axis: Option<usize>,
    spacing: Option<f64>,
    steps: Option<usize>,
    active_nodes: Option<usize>,
    score_evaluations: Option<u64>,
    density_evaluations: Option<u64>,
    storage_bytes: Option<usize>,
    memory_peak_bytes: Option<u64>,
    wall_seconds_per_step: Option<f64>,
    wall_seconds_per_step_least: Option<f64>,
    wall_seconds_per_step_most: Option<f64>,
}

impl results::Row for Row {
    fn case(&self) -> &str {
        &self.case
    }
}

impl Row {
    fn new(case: &Case) -> Self {
        Self {
            case: definition::Case::id(case),
            status: Status::Finished,
            reason: String::new(),
            sweep: case.sweep,
            dim: case.dim.get(),
            particles: case.particles,
            nodes_per_axis: case.nodes_per_axis,
            spacing: case.spacing,
            steps: None,
            active_nodes: None,
            score_evaluations: None,
            density_evaluations: None,
            storage_bytes: None,
            memory_peak_bytes: None,
            wall_seconds_per_step: None,
            wall_seconds_per_step_least: None,
            wall_seconds_per_step_most: None,
        }
    }

    fn note(&mut self, outcome: &Outcome) {
        self.spacing = outcome.spacing.or(self.spacing);
        self.steps = Some(outcome.steps);
        self.active_nodes = outcome.active_nodes;
        self.score_evaluations = Some(outcome.score_evaluations);
        self.density_evaluations = Some(outcome.density_evaluations);
        self.storage_bytes = outcome.storage_bytes;
    }
}

impl Study for Scaling {
    type Case = Case;
    type Row = Row;
    type Shared = ();

    const KIND: &'static str = "scaling";

    fn seeds(&self) -> Vec<u64> {
        vec![self.seed]
    }

    fn threads(&self) -> Option<usize> {
        self.threads.map(Bounded::get)
    }

    fn cases(&self) -> Result<Vec<Case>, CommandError> {
        self.all_cases()
    }

    fn run(
        &self,
        case: &Case,
        (): &mut (),
        _directory: &StudyDirectory,
        observer: &mut CaseObserver,
    ) -> Result<Row, CommandError> {
        let mut specification = self.method.clone();
        specification.options.spacing = case.spacing.or(specification.options.spacing);
        let method = specification.method(Some(self.steps.get()))?;
        let mut run = Run::new(case.particles, self.seed);
        run.start = specification.options.start();
        let target = TargetSpecification::plain(&self.target, Some(case.dim));

        let mut row = Row::new(case);
        let mut times = Vec::new();
        for repeat in 0..=self.repeats.get() {
            let outcome = match attempt(sampling::sample(&target, &method, &run, observer))? {
                Attempt::Finished(outcome) => outcome,
                Attempt::Failed(status, reason) => {
                    (row.status, row.reason) = (status, reason);
                    return Ok(row);
                }
            };
            if repeat == 0 {
                row.note(&outcome);
            } else {
                times.push(outcome.wall_seconds / outcome.steps.max(1) as f64);
            }
        }
        specification.options.steps = Some(self.steps);
        row.memory_peak_bytes = memory::peak_of_own_process(&target, &specification, &run, self.threads());
        let quantiles = statistics::weighted_quantile(&times, None, &[0.0, 0.5, 1.0])?;
        row.wall_seconds_per_step_least = Some(quantiles[0]);
        row.wall_seconds_per_step = Some(quantiles[1]);
        row.wall_seconds_per_step_most = Some(quantiles[2]);
        Ok(row)
    }

    fn report(&self, rows: &[Row], directory: &StudyDirectory) -> Result<Report, CommandError> {
        report::report(self, rows, directory)
    }
}
