//! Study `scaling`: how time per step, memory, active nodes and score evaluations grow with d, M and k.
//!
//! Two sweeps: over d and M with the sampler's own spacing, and over the nodes per axis k of the box that holds the
//! target at fixed M, where a dense grid would hold N = kᵈ nodes. Each case runs once to warm up and then several times on the clock; the
//! median counts. The memory is that of one more run in a process of its own.

mod memory;
mod quantity;
mod report;

use super::prelude::*;
use crate::statistics;

/// Sizes to measure.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Scaling {
    /// Seed of every case.
    seed: u64,
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

/// One size.
#[derive(Clone, Debug)]
pub struct Size {
    dim: Dimension,
    particles: usize,
    /// h in frame units; `None`: the sampler chooses it.
    spacing: Option<f64>,
}

impl Size {
    /// M · 3ᵈ.
    fn work(&self) -> f64 {
        self.particles as f64 * 3f64.powi(self.dim.get() as i32)
    }

    /// The case of a sweep.
    fn case(self, sweep: &str, nodes_per_axis: Option<usize>) -> Case<Self> {
        let nodes = nodes_per_axis.map_or(String::new(), |nodes| format!("-k{nodes}"));
        let Self {
            dim,
            particles,
            spacing,
        } = self;
        Case::new(format!("{sweep}-d{dim}-m{particles}{nodes}"), self.clone())
            .costing(self.work() + 1e3)
            .with("sweep", sweep)
            .with("dim", dim)
            .with("particles", particles)
            .with("nodes_per_axis", nodes_per_axis)
            .with("spacing", spacing)
    }
}

impl Study for Scaling {
    type Work = Size;

    const KIND: &'static str = "scaling";
    const COLUMNS: &'static str = "case status reason sweep dim particles nodes_per_axis spacing steps active_nodes score_evaluations \
         density_evaluations storage_bytes memory_peak_bytes wall_seconds_per_step wall_seconds_per_step_least \
         wall_seconds_per_step_most";
    const REPORT: Report<Self> = report::report;

    /// The cases of both sweeps, cheap ones first within each dimension.
    fn cases(&self) -> Result<Vec<Case<Size>>, CommandError> {
        let nodes = &self.nodes_sweep;
        let [low, high] = nodes.interval;
        if !(low < high && (high - low).is_finite()) {
            return Err(refusal("nodes-sweep.box", format!("[{low}, {high}] is no interval")));
        }
        let sweep = &self.particles_sweep;
        if sweep.largest_work.is_nan() || sweep.largest_work <= 0.0 {
            let message = format!("{} must be above 0", sweep.largest_work);
            return Err(refusal("particles-sweep.largest-work", message));
        }
        for &dim in sweep.dims.iter().chain(&nodes.dims) {
            TargetSpecification::plain(&self.target, Some(dim)).dimension()?;
        }
        let mut cases = Vec::new();
        for &dim in &sweep.dims {
            for particles in sweep.particles.iter().map(|count| count.get()) {
                let spacing = None;
                let size = Size {
                    dim,
                    particles,
                    spacing,
                };
                if size.work() <= sweep.largest_work {
                    cases.push(size.case(quantity::PARTICLES.name, None));
                }
            }
        }
        for &dim in &nodes.dims {
            for count in nodes.nodes_per_axis.iter().map(|count| count.get()) {
                let size = Size {
                    dim,
                    particles: nodes.particles.get(),
                    spacing: Some((high - low) / count as f64),
                };
                cases.push(size.case(quantity::NODES.name, Some(count)));
            }
        }
        Ok(cases)
    }

    fn run(&self, case: &Case<Size>, row: &mut Row, tools: Tools<'_>) -> Result<(), CommandError> {
        let size = &case.work;
        let mut specification = self.method.clone();
        specification.options.spacing = size.spacing.or(specification.options.spacing);
        let target = TargetSpecification::plain(&self.target, Some(size.dim));
        let size = (size.particles, self.seed);
        let work = Sampled::new(&target, &specification, Some(self.steps.get()), size)?;
        let mut times = Vec::new();
        for repeat in 0..=self.repeats.get() {
            let outcome = match attempt(work.sample(tools.observer))? {
                Ok(outcome) => outcome,
                Err(failure) => {
                    row.fail(failure);
                    return Ok(());
                }
            };
            if repeat == 0 {
                row.take(&outcome);
                row.set("spacing", outcome.spacing.or(case.work.spacing));
            } else {
                times.push(outcome.wall_seconds / outcome.steps.max(1) as f64);
            }
        }
        specification.options.steps = Some(self.steps);
        let peak = memory::peak_of_own_process(&target, &specification, &work.run, tools.directory.threads);
        row.set("memory_peak_bytes", peak);
        let quantiles = statistics::weighted_quantile(&times, None, &[0.0, 0.5, 1.0])?;
        row.set("wall_seconds_per_step_least", quantiles[0]);
        row.set("wall_seconds_per_step", quantiles[1]);
        row.set("wall_seconds_per_step_most", quantiles[2]);
        Ok(())
    }
}
