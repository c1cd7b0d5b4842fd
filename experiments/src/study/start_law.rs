//! Where the particles of a study begin.

use std::fmt::{self, Display, Formatter};

use parvi::Start;
use serde::Deserialize;

use super::checks::{finite, positive};
use crate::CommandError;

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
}
