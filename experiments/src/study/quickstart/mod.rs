//! Study `quickstart`: a posterior from real data against its reference, and a two-dimensional target for the eye.

mod report;

use parvi_files::{ParticleFile, table_file};

use super::prelude::*;
use super::reference::{MOMENTS, Reference};

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
    reference: Reference,
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

/// The largest errors that count as a pass.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct Bounds {
    /// Of a mean, in posterior standard deviations.
    mean: f64,
    /// Of a standard deviation, relative.
    standard_deviation: f64,
}

/// The pieces of work, by their names in results.csv: the posterior's reference, whose raw files are `moments` and `particles`; its particles, and those for the eye, with their `trace`.
const REFERENCE: &str = "reference";
const POSTERIOR: &str = "posterior";
const PICTURE: &str = "picture";

impl Study for Quickstart {
    type Work = Sampled;

    const KIND: &'static str = "quickstart";
    const COLUMNS: &'static str = "case status reason target dim method particles steps score_evaluations density_evaluations residual \
         spacing active_nodes storage_bytes effective_sample_size pareto_k wall_seconds";
    const REPORT: Report<Self> = report::report;

    fn cases(&self) -> Result<Vec<Case<Sampled>>, CommandError> {
        let (dimension, target) = (self.picture.target.dimension()?, self.picture.target.label());
        let otherwise = || format!("`{target}` has d = {dimension}, must be 2");
        holds(dimension == 2, "picture.target", otherwise)?;
        positive("bounds.mean", &[self.bounds.mean])?;
        positive("bounds.standard-deviation", &[self.bounds.standard_deviation])?;
        let case = |piece: &str, part: &Part, particles: usize| {
            let mut method = part.method.clone();
            method.options.trace_every = self.trace_every.get();
            let work = Sampled::new(&part.target, &method, None, (particles, self.seed))?;
            work.case(piece.to_owned(), &part.method)
        };
        let reference = case(REFERENCE, &self.posterior, self.reference.points.get())?;
        let reference = reference.with("method", "importance-sampling").costing(2.0);
        let posterior = case(POSTERIOR, &self.posterior, self.posterior.particles.get())?;
        let picture = case(PICTURE, &self.picture, self.picture.particles.get())?;
        Ok(vec![reference, posterior.costing(10.0), picture])
    }

    fn run(&self, case: &Case<Sampled>, row: &mut Row, tools: Tools<'_>) -> Result<(), CommandError> {
        let file = |what: &str| tools.directory.raw_of(case.id(), what);
        let particles = if case.id() == REFERENCE {
            let (seconds, known) = timed(|| self.reference.of(&self.posterior.target));
            let known = known?;
            row_file::write(&file("moments"), MOMENTS, &known.moments)?;
            row.set("effective_sample_size", known.effective_sample_size);
            row.set("pareto_k", known.pareto_k);
            row.set(SECONDS, seconds);
            known.draws
        } else if let Some(outcome) = row.note(case.work.sample(tools.observer))? {
            table_file::write(outcome.trace.iter(), &file("trace"))?;
            outcome.particles
        } else {
            return Ok(());
        };
        let own = ParticleFile::create("out", file("particles"))?;
        Ok(own.write(&particles, &[])?)
    }
}
