//! Study `stability`: random configurations, in frames that are wrong on purpose, and how they end.
//!
//! Whatever is asked of a sampler, it gives finite particles or an error that says what went wrong. A panic or a particle that is
//! not finite is a fault; a refusal is a finding. Every case depends on the study's seed and its own number only.

mod draw;
mod figure;
mod report;
mod row;
mod trial;

use parvi_targets::{Dimensions, target_info};
use serde::Deserialize;

use draw::{Case, Place, draw};
use row::Row;

use super::checks::{not_empty, refusal, targets_without_data};
use super::definition::{Report, Study, Work};
use super::directory::StudyDirectory;
use crate::CommandError;
use crate::dispatch::on_target;
use crate::options::{Bounded, Dimension};

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

impl Stability {
    /// The targets with the dimensions that they have among `dims`.
    fn places(&self) -> Result<Vec<Place>, CommandError> {
        not_empty("dims", &self.dims)?;
        let names: Vec<&str> = match &self.targets {
            Some(names) => names.iter().map(String::as_str).collect(),
            None => targets_without_data().collect(),
        };
        let mut places = Vec::new();
        for name in names {
            let info = target_info(name).map_err(|error| refusal("targets", error.to_string()))?;
            let allowed = match info.dimensions {
                Dimensions::Fixed(only) => only..=only,
                Dimensions::Range { minimum, maximum, .. } => minimum..=maximum,
                Dimensions::FromData => {
                    return Err(refusal("targets", format!("`{name}` needs a data file")));
                }
            };
            let inside = |dim: &&Dimension| allowed.contains(&dim.get());
            let dims: Vec<Dimension> = self.dims.iter().filter(inside).copied().collect();
            if !dims.is_empty() {
                let fixed = matches!(info.dimensions, Dimensions::Fixed(_));
                let name = name.to_owned();
                places.push(Place { name, dims, fixed });
            }
        }
        not_empty("targets", &places)?;
        Ok(places)
    }
}

impl Study for Stability {
    type Case = Case;
    type Row = Row;
    type Shared = ();

    const KIND: &'static str = "stability";

    /// The cases, in the order of their numbers.
    fn cases(&self) -> Result<Vec<Case>, CommandError> {
        let places = self.places()?;
        Ok((0..self.cases.get())
            .map(|index| draw(self.seed, index, &places))
            .collect())
    }

    fn run(&self, case: &Case, work: Work<'_, ()>) -> Result<Row, CommandError> {
        on_target!(&case.target, target, D => trial::run::<D>(target.as_ref(), case, work.observer))
    }

    fn report(&self, rows: &[Row], _: &StudyDirectory) -> Result<Report, CommandError> {
        Ok(report::report(self, rows))
    }
}
