//! Study `scaling`: how time per step, memory, active nodes and score evaluations grow with d, M and k.
//!
//! Two sweeps: over d and M with the sampler's own spacing, and over the nodes per axis k of the box that holds the
//! target at fixed M, where a dense grid would hold N = kᵈ nodes. Each case runs once to warm up and then several times on the clock; the
//! median counts. The memory is that of one more run in a process of its own.

mod report;

use super::own_process::peak_of_own_process;
use super::prelude::*;

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

/// A sweep over sizes: its name in tables and files, the column of the size that it varies, the symbol of that and the label of its axis.
type Sweep = [&'static str; 4];

/// Over d and M.
const PARTICLES: Sweep = ["particles", "particles", "M", "number of particles M"];
/// Over k.
const NODES: Sweep = ["nodes", "nodes_per_axis", "k", "nodes per axis k"];

/// Particles on a target with a spacing in frame units; `None`: the sampler chooses it.
type Size = (TargetSpecification, usize, Option<f64>);

/// M · 3ᵈ.
fn work(dim: Dimension, particles: usize) -> f64 {
    particles as f64 * stencil(dim.get())
}

impl Scaling {
    /// The case of d, M and k in a sweep.
    fn case(&self, sweep: Sweep, size: (Dimension, usize, Option<usize>)) -> Result<Case<Size>, CommandError> {
        let ([low, high], (dim, particles, nodes)) = (self.nodes_sweep.interval, size);
        let spacing = nodes.map(|nodes| (high - low) / nodes as f64);
        let of_nodes = nodes.map_or(String::new(), |nodes| format!("-k{nodes}"));
        let name = format!("{}-d{dim}-m{particles}{of_nodes}", sweep[0]);
        let target = TargetSpecification::plain(&self.target, Some(dim));
        target.dimension()?;
        let case = Case::new(name, (target, particles, spacing)).costing(work(dim, particles) + 1e3);
        let case = case.by(&self.method).with("sweep", sweep[0]).with("dim", dim);
        let case = case.with("particles", particles).with("spacing", spacing);
        Ok(case.with("nodes_per_axis", nodes))
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
        let (sweep, nodes) = (&self.particles_sweep, &self.nodes_sweep);
        let most = sweep.largest_work;
        interval("nodes-sweep.box", nodes.interval)?;
        let otherwise = || format!("{most} must be above 0");
        holds(most > 0.0, "particles-sweep.largest-work", otherwise)?;
        let mut cases = Vec::new();
        for &dim in &sweep.dims {
            let sizes = sweep.particles.iter().map(|particles| particles.get());
            for particles in sizes.filter(|&particles| work(dim, particles) <= most) {
                cases.push(self.case(PARTICLES, (dim, particles, None))?);
            }
        }
        for &dim in &nodes.dims {
            for count in nodes.nodes_per_axis.iter().map(|count| count.get()) {
                cases.push(self.case(NODES, (dim, nodes.particles.get(), Some(count)))?);
            }
        }
        distinct("dims, particles or nodes-per-axis", cases)
    }

    fn run(&self, case: &Case<Size>, row: &mut Row, tools: Tools<'_>) -> Result<(), CommandError> {
        let (target, particles, spacing) = &case.work;
        let mut method = self.method.clone();
        method.options.spacing = spacing.or(method.options.spacing);
        method.options.steps = Some(self.steps);
        let work = Sampled::new(target, &method, None, (*particles, self.seed))?;
        let is_finished = work.clocked(self.repeats.get(), row, tools.observer)?;
        let known = row.number("spacing").or(*spacing);
        row.set("spacing", known);
        if is_finished {
            let peak = peak_of_own_process(&work, &method, tools.directory.threads);
            row.set("memory_peak_bytes", peak);
        }
        Ok(())
    }
}
