//! Study `scaling`: how time per step, memory, active nodes and score evaluations grow with d, M and k.
//!
//! Two sweeps: over d and M with the sampler's own spacing, and over the nodes per axis k of the box that holds the
//! target at fixed M, where a dense grid would hold N = kᵈ nodes. Each case runs once to warm up and then several times on the clock; the
//! median counts. The memory is that of one more run in a process of its own.

mod report;

use super::derived::PER_STEP;
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

/// d, M and h in frame units; `None`: the sampler chooses it.
type Size = (Dimension, usize, Option<f64>);

/// M · 3ᵈ.
fn work((dim, particles, _): &Size) -> f64 {
    *particles as f64 * 3f64.powi(dim.get() as i32)
}

impl Scaling {
    /// The case of a size in a sweep.
    fn case(&self, size: Size, [sweep, ..]: Sweep, nodes_per_axis: Option<usize>) -> Case<Size> {
        let (dim, particles, spacing) = size;
        let nodes = nodes_per_axis.map_or(String::new(), |nodes| format!("-k{nodes}"));
        let case = Case::new(format!("{sweep}-d{dim}-m{particles}{nodes}"), size).costing(work(&size) + 1e3);
        let case = case.with("sweep", sweep).with("dim", dim).with("particles", particles);
        case.with("nodes_per_axis", nodes_per_axis)
            .with("spacing", spacing)
            .by(&self.method)
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
        let ([low, high], most) = (nodes.interval, sweep.largest_work);
        let is_interval = low < high && (high - low).is_finite();
        holds(is_interval, "nodes-sweep.box", || {
            format!("[{low}, {high}] is no interval")
        })?;
        holds(most > 0.0, "particles-sweep.largest-work", || {
            format!("{most} must be above 0")
        })?;
        for &dim in sweep.dims.iter().chain(&nodes.dims) {
            TargetSpecification::plain(&self.target, Some(dim)).dimension()?;
        }
        let mut cases = Vec::new();
        for &dim in &sweep.dims {
            let sizes = sweep.particles.iter().map(|particles| (dim, particles.get(), None));
            let sizes = sizes.filter(|size| work(size) <= most);
            cases.extend(sizes.map(|size| self.case(size, PARTICLES, None)));
        }
        for &dim in &nodes.dims {
            for count in nodes.nodes_per_axis.iter().map(|count| count.get()) {
                let size = (dim, nodes.particles.get(), Some((high - low) / count as f64));
                cases.push(self.case(size, NODES, Some(count)));
            }
        }
        Ok(cases)
    }

    fn run(&self, case: &Case<Size>, row: &mut Row, tools: Tools<'_>) -> Result<(), CommandError> {
        let (dim, particles, spacing) = case.work;
        let mut specification = self.method.clone();
        specification.options.spacing = spacing.or(specification.options.spacing);
        let target = TargetSpecification::plain(&self.target, Some(dim));
        let work = Sampled::new(&target, &specification, Some(self.steps.get()), (particles, self.seed))?;
        let mut times = Vec::new();
        for _ in 0..=self.repeats.get() {
            let Some(outcome) = row.note(work.sample(tools.observer))? else {
                return Ok(());
            };
            row.set("spacing", outcome.spacing.or(spacing));
            let per_step = outcome.wall_seconds / outcome.steps.max(1) as f64;
            times.push(Row::default().with(PER_STEP[1], per_step));
        }
        // The first is to warm up.
        let timed: Rows<'_> = times.iter().skip(1).collect();
        timed.note_range(PER_STEP[1], row, PER_STEP);
        specification.options.steps = Some(self.steps);
        let peak = peak_of_own_process(&work, &specification, tools.directory.threads);
        row.set("memory_peak_bytes", peak);
        Ok(())
    }
}
