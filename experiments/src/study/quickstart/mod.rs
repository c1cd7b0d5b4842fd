//! Study `quickstart`: a posterior from real data against its reference, and a two-dimensional target for the eye.

mod comparison;
mod figures;
mod reference;
mod report;

use std::path::PathBuf;

use reference::Reference;

use super::prelude::*;
use crate::dispatch::on_target;
use crate::options::words;
use crate::output::{ParticleFile, table_file};

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

words! {
    /// The three pieces of work, by their names in results.csv and in the names of raw files.
    Piece {
        /// The posterior's reference moments.
        Reference,
        /// The posterior's particles.
        Posterior,
        /// The particles for the eye.
        Picture,
    }
}

impl Piece {
    fn case(self, part: &Part, particles: usize) -> Result<Case<Self>, CommandError> {
        Ok(Case::new(self.to_string(), self)
            .by(&part.method)
            .with("target", part.target.label())
            .with("dim", part.target.dimension()?)
            .with("particles", particles))
    }

    /// A file of its own: `particles`, `trace` or `moments`.
    fn file(self, directory: &StudyDirectory, what: &str) -> PathBuf {
        directory.raw(&format!("{self}-{what}.csv"))
    }
}

impl Study for Quickstart {
    type Work = Piece;

    const KIND: &'static str = "quickstart";
    const COLUMNS: &'static str = "case status reason target dim method particles steps score_evaluations density_evaluations residual \
         spacing active_nodes storage_bytes effective_sample_size wall_seconds";
    const REPORT: Report<Self> = report::report;

    fn cases(&self) -> Result<Vec<Case<Piece>>, CommandError> {
        let (dimension, target) = (self.picture.target.dimension()?, self.picture.target.label());
        let otherwise = || format!("`{target}` has d = {dimension}, must be 2");
        holds(dimension == 2, "picture.target", otherwise)?;
        positive("bounds.mean", &[self.bounds.mean])?;
        positive("bounds.standard-deviation", &[self.bounds.standard_deviation])?;
        let reference = Piece::Reference.case(&self.posterior, self.reference.points.get())?;
        let reference = reference.with("method", "importance-sampling").costing(2.0);
        let posterior = Piece::Posterior.case(&self.posterior, self.posterior.particles.get())?;
        let picture = Piece::Picture.case(&self.picture, self.picture.particles.get())?;
        Ok(vec![reference, posterior.costing(10.0), picture])
    }

    fn run(&self, case: &Case<Piece>, row: &mut Row, tools: Tools<'_>) -> Result<(), CommandError> {
        let part = match case.work {
            Piece::Reference => return self.run_reference(row, tools.directory),
            Piece::Posterior => &self.posterior,
            Piece::Picture => &self.picture,
        };
        let mut method = part.method.clone();
        method.options.trace_every = self.trace_every.get();
        let work = Sampled::new(&part.target, &method, None, (part.particles.get(), self.seed))?;
        if let Some(outcome) = row.note(work.sample(tools.observer))? {
            let file = |what: &str| case.work.file(tools.directory, what);
            ParticleFile::create(file("particles"))?.write(&outcome.particles, &[])?;
            table_file::write(outcome.trace.iter(), &file("trace"))?;
        }
        Ok(())
    }
}

impl Quickstart {
    fn run_reference(&self, row: &mut Row, directory: &StudyDirectory) -> Result<(), CommandError> {
        let target = &self.posterior.target;
        let names = target.coordinate_names();
        let (seconds, reference) =
            timed(|| on_target!(target, target, D => Reference::of::<D>(target.as_ref(), &names, &self.reference)));
        let reference = reference?;
        let file = |what: &str| Piece::Reference.file(directory, what);
        row_file::write(&file("moments"), reference::COLUMNS, &reference.axes)?;
        ParticleFile::create(file("particles"))?.write(&reference.draws, &[])?;
        row.set("effective_sample_size", reference.effective_sample_size);
        row.set("wall_seconds", seconds);
        Ok(())
    }
}
