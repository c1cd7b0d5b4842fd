//! Study `catalogue`: what the defaults of a method reach on every target, from starts near and far.
//!
//! Nothing is set per target. Errors are measured in coordinates in which the target has mean zero and unit covariance, and
//! stated relative to those of as many independent draws. The first method of the list is judged by [`requirement`]; the
//! others stand beside it.

mod claims;
mod figure;
mod report;
mod requirement;

use requirement::Requirement;

use super::prelude::*;
use super::start_law::{StartLaw, begin};

/// All methods on all targets from all starts.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Catalogue {
    /// One run per seed.
    seeds: Vec<u64>,
    /// M.
    particles: ParticleCount,
    /// Dimensions; of each target those that it has.
    dims: Vec<Dimension>,
    /// Targets by name; absent: every target of the catalogue that needs no data file.
    targets: Option<Vec<Place>>,
    /// Where the particles begin.
    starts: Vec<StartLaw>,
    /// The methods; the first is judged.
    methods: Vec<MethodSpecification>,
    /// Quasi-random points that stand for a target; a power of two keeps their balance.
    reference_points: Bounded<1000, 10_000_000>,
    /// Seed of the reference.
    reference_seed: u64,
    /// Directions of the sliced Wasserstein distance.
    directions: Bounded<1, 100_000>,
    /// Sets of independent draws whose median is the yardstick of that distance.
    draws: Bounded<1, 1000>,
}

impl Catalogue {
    /// Every target in each of its dimensions, in the order of the list and then of `dims`.
    fn all_targets(&self) -> Result<Vec<TargetSpecification>, CommandError> {
        Ok(places(self.targets.as_deref(), &self.dims)?.concat())
    }

    /// What is asked on every target, by its label.
    fn asked(&self) -> Result<Vec<(String, Requirement)>, CommandError> {
        let asked = |target: &TargetSpecification| Ok((target.label(), Requirement::of(target)?));
        self.all_targets()?.iter().map(asked).collect()
    }

    fn yardstick(&self) -> YardstickOptions {
        let (points, seed) = (self.reference_points.get(), self.reference_seed);
        YardstickOptions::of_energy(points, seed, Coordinates::Standardised).over(self.directions.get())
    }

    /// The label of the method that the requirements are for.
    fn judged(&self) -> &str {
        self.methods.first().map_or("", MethodSpecification::label)
    }
}

impl Study for Catalogue {
    type Work = Sampled;

    const KIND: &'static str = "catalogue";
    const COLUMNS: &'static str = "case status reason outcome target dim method start_mean start_sd particles seed energy_distance_squared \
         energy_level sliced_wasserstein sliced_level mean_error deviation_error mass_error residual steps score_evaluations \
         density_evaluations wall_seconds reference_size reference_mean_error reference_deviation_error";
    const REPORT: Report<Self> = report::report;

    /// The cases, target by target, so that a target's reference is made once.
    fn cases(&self) -> Result<Vec<Case<Sampled>>, CommandError> {
        all_given!(self: seeds, dims, starts, methods);
        for start in &self.starts {
            start.check("starts")?;
        }
        for method in &self.methods {
            let options = &method.options;
            unset("methods.options.start-mean", &options.start_mean, "starts")?;
            unset("methods.options.start-sd", &options.start_sd, "starts")?;
        }
        let judged = self.methods[0].name;
        let otherwise = || format!("the first, `{judged}`, takes no steps, so it has no starts");
        holds(judged.iterates(), "methods", otherwise)?;
        let targets = self.all_targets()?;
        let mut cases = Vec::new();
        for target in &targets {
            for method in &self.methods {
                // Draws have no start.
                let starts: Vec<Option<StartLaw>> = match method.name.iterates() {
                    true => self.starts.iter().copied().map(Some).collect(),
                    false => vec![None],
                };
                for start in starts {
                    let of_start = start.map(|start| format!("-mean{}-sd{}", start.mean, start.standard_deviation));
                    let of_start = of_start.unwrap_or_default();
                    let name = format!("{}-{}-m{}{of_start}", target.label(), method.label(), self.particles);
                    let (size, cost) = ((self.particles.get(), None), cost(target, start));
                    let here = Sampled::of_seeds((target, method), size, (&name, &self.seeds))?.into_iter();
                    cases.extend(here.map(|case| begin(case, start).costing(cost)));
                }
            }
        }
        distinct("targets, dims, methods, starts or seeds", cases)
    }

    fn run(&self, case: &Case<Sampled>, row: &mut Row, tools: Tools<'_>) -> Result<(), CommandError> {
        // The level is that of as many draws as there are particles.
        let sets = IndependentSets {
            count: self.draws.get(),
            size: self.particles.get(),
        };
        let yardstick = tools.yardstick;
        let (yardstick, level) = yardstick.levelled(&case.work.target, &self.yardstick(), Some(sets), row)?;
        row.set("sliced_level", level);
        case.work.run(row, yardstick, tools.observer)
    }
}

/// Milliseconds, roughly: the distance to the reference and the run; the many rows of `wells` are dear.
fn cost(target: &TargetSpecification, start: Option<StartLaw>) -> f64 {
    let run = if target.name == "wells" { 2000.0 } else { 100.0 };
    200.0 + start.map_or(0.0, |_| run)
}
