//! Integers with a range, checked where they are read.

use std::fmt::{self, Display, Formatter};
use std::str::FromStr;

use parvi_plot::results::Value;
use serde::Deserialize;

/// An integer from `LEAST` to `MOST`.
///
/// In a configuration a value outside of the range is an error at its own line and column.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Deserialize)]
#[serde(try_from = "i64")]
pub struct Bounded<const LEAST: i64, const MOST: i64>(i64);

/// A number of particles M.
pub type ParticleCount = Bounded<2, 100_000_000>;
/// A number of steps.
pub type StepCount = Bounded<1, 100_000_000>;
/// A number of rounds.
pub type RoundCount = Bounded<0, 100_000_000>;
/// A number of evaluations.
pub type EvaluationCount = Bounded<1, 1_000_000_000_000>;
/// A number of draws to throw away.
pub type WarmUp = Bounded<0, 100_000_000>;
/// A dimension d.
pub type Dimension = Bounded<1, 8>;

impl<const LEAST: i64, const MOST: i64> Bounded<LEAST, MOST> {
    /// The number, if it lies in the range.
    pub fn new(value: i64) -> Option<Self> {
        (LEAST..=MOST).contains(&value).then_some(Self(value))
    }

    /// The number as a size.
    pub fn get(self) -> usize {
        // The range of every use starts at zero or above.
        usize::try_from(self.0).unwrap_or(0)
    }
}

impl<const LEAST: i64, const MOST: i64> TryFrom<i64> for Bounded<LEAST, MOST> {
    type Error = String;

    fn try_from(value: i64) -> Result<Self, String> {
        Self::new(value).ok_or_else(|| format!("{value} is out of range: must be from {LEAST} to {MOST}"))
    }
}

impl<const LEAST: i64, const MOST: i64> FromStr for Bounded<LEAST, MOST> {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let value = text.parse::<i64>();
        Self::try_from(value.map_err(|_| format!("must be an integer from {LEAST} to {MOST}"))?)
    }
}

impl<const LEAST: i64, const MOST: i64> Display for Bounded<LEAST, MOST> {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}", self.0)
    }
}

impl<const LEAST: i64, const MOST: i64> From<Bounded<LEAST, MOST>> for Value {
    fn from(count: Bounded<LEAST, MOST>) -> Self {
        count.get().into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_belong_to_the_range() {
        assert_eq!(Dimension::new(8).unwrap().get(), 8);
        assert_eq!(Dimension::new(9), None);
        assert_eq!(
            "0".parse::<Dimension>().unwrap_err(),
            "0 is out of range: must be from 1 to 8"
        );
        assert_eq!(
            "two".parse::<ParticleCount>().unwrap_err(),
            "must be an integer from 2 to 100000000"
        );
    }
}
