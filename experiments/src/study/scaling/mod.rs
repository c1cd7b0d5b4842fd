//! Study `scaling`: how time per step, memory, active nodes and score evaluations grow with d, M and k.
//!
//! Two sweeps: over d and M with the sampler's own spacing, and over the nodes per axis k of the box that holds the
//! target at fixed M, where a dense grid would hold N = kᵈ nodes. Each case runs once to warm up and then several times on the clock; the
//! median counts. The memory is that of one more run in a process of its own.

mod memory;
mod quantity;
mod report;

use serde::Deserialize;

use super::attempt::{Attempt, attempt};
use super::checks::refusal;
use super::definition::{self, Report, Study, Work};
use super::directory::StudyDirectory;
use super::run_row::RunRow;
use crate::options::{Bounded, Dimension, MethodSpecification, ParticleCount, StepCount, TargetSpecification};
use crate::{CommandError, sampling, statistics};

/// Sizes to measure.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Scaling {
    /// Seed of every case.
    seed: u64,
    /// Threads; absent: as many as the environment gives.
    threads: Option<Bounded<1, 1024>>,
    /// A target of the catalogue that exists in every dimension of the sweeps.
    target: String,
    /// Steps of a run.
    steps: StepCount,
    /// Runs on the clock per case.
    repeats: Bounded<1, 1000>,
    /// The sampler.
    method: MethodSpecification,
    /// The sweep over d and M.
    particles_sweep: ParticlesSweep,
    /// The sweep over k.
    nodes_sweep: NodesSweep,
}

/// All pairs of d and M whose work M · 3ᵈ is within the budget.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct ParticlesSweep {
    /// d.
    dims: Vec<Dimension>,
    /// M.
    particles: Vec<ParticleCount>,
    /// The largest M · 3ᵈ, the number of particle–node pairs of a quadratic B-spline, that is run.
    largest_work: f64,
    /// Fits use the sizes from here on, so that the fixed cost of a step at small M does not bend them.
    fit_from: ParticleCount,
}

/// All pairs of d and k.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct NodesSweep {
    /// d.
    dims: Vec<Dimension>,
    /// M.
    particles: ParticleCount,
    /// k.
    nodes_per_axis: Vec<Bounded<2, 1_000_000>>,
    /// A second fit uses the k from here on.
    fit_from: Bounded<2, 1_000_000>,
    /// The interval per axis, in frame units, that k nodes divide: h = width / k.
    #[serde(rename = "box")]
    interval: [f64; 2],
}

/// Over d and M.
const PARTICLES: &str = "particles";
/// Over k.
const NODES: &str = "nodes";

/// One size.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    sweep: &'static str,
    dim: Dimension,
    particles: usize,
    /// k; `None`: the sampler chooses the spacing.
    nodes_per_axis: Option<usize>,
    /// h in frame units for that k.
    spacing: Option<f64>,
}

impl definition::Case for Case {
    fn id(&self) -> String {
        let nodes = self.nodes_per_axis.map_or(String::new(), |nodes| format!("-k{nodes}"));
        format!("{}-d{}-m{}{nodes}", self.sweep, self.dim, self.particles)
    }

    fn cost(&self) -> f64 {
        self.particles as f64 * 3f64.powi(self.dim.get() as i32) + 1e3
    }
}

impl Study for Scaling {
    type Case = Case;
    type Row = RunRow;
    type Shared = ();

    const KIND: &'static str = "scaling";
    const HEAD: &[&str] = &["kind"];
    const COLUMNS: &'static str = "case status reason sweep dim particles nodes_per_axis spacing steps active_nodes score_evaluations \
         density_evaluations storage_bytes memory_peak_bytes wall_seconds_per_step wall_seconds_per_step_least \
         wall_seconds_per_step_most";

    /// The cases of both sweeps, cheap ones first within each dimension.
    fn cases(&self) -> Result<Vec<Case>, CommandError> {
        let [low, high] = self.nodes_sweep.interval;
        if !(low < high && (high - low).is_finite()) {
            return Err(refusal("nodes-sweep.box", format!("[{low}, {high}] is no interval")));
        }
        let sweep = &self.particles_sweep;
        if sweep.largest_work.is_nan() || sweep.largest_work <= 0.0 {
            let message = format!("{} must be above 0", sweep.largest_work);
            return Err(refusal("particles-sweep.largest-work", message));
        }
        for &dim in sweep.dims.iter().chain(&self.nodes_sweep.dims) {
            TargetSpecification::plain(&self.target, Some(dim)).dimension()?;
        }
        let mut cases = Vec::new();
        for &dim in &sweep.dims {
            for &particles in &sweep.particles {
                let work = particles.get() as f64 * 3f64.powi(dim.get() as i32);
                if work <= sweep.largest_work {
                    let particles = particles.get();
                    cases.push(Case {
                        sweep: PARTICLES,
                        dim,
                        particles,
                        nodes_per_axis: None,
                        spacing: None,
                    });
                }
            }
        }
        for &dim in &self.nodes_sweep.dims {
            for &nodes in &self.nodes_sweep.nodes_per_axis {
                cases.push(Case {
                    sweep: NODES,
                    dim,
                    particles: self.nodes_sweep.particles.get(),
                    nodes_per_axis: Some(nodes.get()),
                    spacing: Some((high - low) / nodes.get() as f64),
                });
            }
        }
        Ok(cases)
    }

    fn run(&self, case: &Case, work: Work<'_, ()>) -> Result<RunRow, CommandError> {
        let mut specification = self.method.clone();
        specification.options.spacing = case.spacing.or(specification.options.spacing);
        let method = specification.method(Some(self.steps.get()))?;
        let run = specification.run(case.particles, self.seed);
        let target = TargetSpecification::plain(&self.target, Some(case.dim));

        let mut row = RunRow {
            sweep: case.sweep.to_owned(),
            dim: case.dim.get(),
            particles: case.particles,
            nodes_per_axis: case.nodes_per_axis,
            spacing: case.spacing,
            ..RunRow::new(case)
        };
        let mut times = Vec::new();
        for repeat in 0..=self.repeats.get() {
            let outcome = match attempt(sampling::sample(&target, &method, &run, work.observer))? {
                Attempt::Finished(outcome) => outcome,
                Attempt::Failed(status, reason) => {
                    row.fail(status, reason);
                    return Ok(row);
                }
            };
            if repeat == 0 {
                row.take(&outcome);
                row.spacing = row.spacing.or(case.spacing);
            } else {
                times.push(outcome.wall_seconds / outcome.steps.max(1) as f64);
            }
        }
        specification.options.steps = Some(self.steps);
        row.memory_peak_bytes =
            memory::peak_of_own_process(&target, &specification, &run, self.threads.map(Bounded::get));
        let quantiles = statistics::weighted_quantile(&times, None, &[0.0, 0.5, 1.0])?;
        row.wall_seconds_per_step_least = Some(quantiles[0]);
        row.wall_seconds_per_step = Some(quantiles[1]);
        row.wall_seconds_per_step_most = Some(quantiles[2]);
        Ok(row)
    }

    fn report(&self, rows: &[RunRow], _: &StudyDirectory) -> Result<Report, CommandError> {
        Ok(report::report(self, rows))
    }
}
