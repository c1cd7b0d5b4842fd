//! Study `stability`: random configurations, in frames that are wrong on purpose, and how they end.
//!
//! Whatever is asked of a sampler, it gives finite particles or an error that says what went wrong. A panic or a particle that is
//! not finite is a fault; a refusal is a finding. Every case depends on the study's seed and its own number only.

mod draw;
mod figure;
mod report;
mod trial;

use draw::{Configuration, draw};

use super::prelude::*;
use crate::dispatch::on_target;

/// Random configurations.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Stability {
    /// Seed of all draws; case i depends on it and on i only.
    seed: u64,
    /// The number of configurations.
    cases: Bounded<1, 10_000_000>,
    /// Dimensions; of each target those that it has.
    dims: Vec<Dimension>,
    /// Names of targets; absent: every target of the catalogue that needs no data file.
    targets: Option<Vec<String>>,
}

impl Study for Stability {
    type Work = Configuration;

    const KIND: &'static str = "stability";
    const COLUMNS: &'static str = "case ending reason message failed_step escaped reach residual target dim method basis particles steps \
         scale turned start_mean start_sd start_draws spacing_factor spacing time_step_factor time_step score transfer flip_share friction \
         shifts rotation settling settling_shifts moment_correction guards material seed wall_seconds";
    const REPORT: Report<Self> = report::report;

    /// The cases, in the order of their numbers.
    fn cases(&self) -> Result<Vec<Case<Configuration>>, CommandError> {
        let plain = |names: &Vec<String>| names.iter().map(|name| Place::plain(name)).collect();
        let listed: Option<Vec<Place>> = self.targets.as_ref().map(plain);
        let places = places(listed.as_deref(), &self.dims)?;
        let case = |index: usize| case(index, draw(self.seed, index, &places));
        Ok((0..self.cases.get()).map(case).collect())
    }

    fn run(&self, case: &Case<Configuration>, row: &mut Row, tools: Tools<'_>) -> Result<(), CommandError> {
        let work = &case.work;
        on_target!(&work.target, target, D => trial::run::<D>(target.as_ref(), work, row, tools.observer))
    }
}

/// A configuration as a case, whose row has the options by their names.
fn case(index: usize, drawn: Configuration) -> Case<Configuration> {
    let steps = drawn.options.steps.map_or(0, StepCount::get);
    let cost = 1e4 + (drawn.particles * drawn.basis.stencil(drawn.dim) * steps) as f64;
    let mut case = Case::new(format!("case-{index:05}"), drawn.clone())
        .costing(cost)
        .with("ending", Status::Finite)
        .with("escaped", "false")
        .with("target", drawn.target.name)
        .with("dim", drawn.dim)
        .with("method", drawn.method.as_str())
        .with("particles", drawn.particles)
        .with("scale", drawn.scale)
        .with("turned", drawn.turn.is_some().to_string())
        .with("spacing_factor", drawn.spacing_factor)
        .with("time_step_factor", drawn.time_step_factor)
        .with("seed", drawn.seed)
        .with("wall_seconds", 0.0);
    for (option, value) in drawn.options.values() {
        case.row.set(option, value);
    }
    case
}

/// Whether the run gave nothing that could be of use: an error, a panic, numbers that are none, or particles far off.
fn diverged(row: &Row) -> bool {
    row.status() != Status::Finite || row.is("escaped", "true")
}
