//! Where the particles of a study begin.

use std::fmt::{self, Display, Formatter};

use parvi::Start;
use serde::Deserialize;

use super::checks::{finite, positive};
use super::definition::Case;
use super::sampled::Sampled;
use crate::CommandError;
use crate::plots::results::{Row, Rows};

/// N(mean · 1, standard-deviation² I), in the coordinates of the target's frame.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct StartLaw {
    /// Mean of every coordinate, in target scales.
    pub mean: f64,
    /// Standard deviation of every coordinate, in target scales.
    pub standard_deviation: f64,
}

impl Display for StartLaw {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        write!(formatter, "N({}, {}²)", self.mean, self.standard_deviation)
    }
}

impl StartLaw {
    /// Refuses a law that cannot be drawn from; `field` is its place in the configuration.
    pub fn check(&self, field: &str) -> Result<(), CommandError> {
        positive(&format!("{field}.standard-deviation"), &[self.standard_deviation])?;
        finite(&format!("{field}.mean"), self.mean)
    }

    /// The same for the sampler; how it is drawn from is left as in `otherwise`.
    pub fn start(&self, otherwise: Start) -> Start {
        Start {
            mean: self.mean,
            standard_deviation: self.standard_deviation,
            ..otherwise
        }
    }

    /// Whether a run began there.
    pub fn is_of(&self, row: &Row) -> bool {
        row.is("start_mean", self.mean) && row.is("start_sd", self.standard_deviation)
    }

    /// The runs that began there; those without a start belong to every one.
    pub fn runs<'a>(&self, rows: &Rows<'a>) -> Rows<'a> {
        rows.having(|row| row.number("start_mean").is_none() || self.is_of(row))
    }
}

/// The case with a start, which its row says.
pub fn begin(mut case: Case<Sampled>, start: Option<StartLaw>) -> Case<Sampled> {
    let run = &mut case.work.run;
    run.start = start.map_or(run.start, |law| law.start(run.start));
    case.with("start_mean", start.map(|start| start.mean))
        .with("start_sd", start.map(|start| start.standard_deviation))
}
