//! The methods by name.

use std::fmt::{self, Display, Formatter};

use clap::ValueEnum;
use serde::{Deserialize, Serialize};

/// A sampling method.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MethodName {
    /// Material point method with the calibrated gas law
    #[default]
    Mpm,
    /// Adaptive importance sampling, condensed to particles
    Ais,
    /// Algorithm 1 of the MPM-ParVI paper
    PaperPic,
    /// Algorithm 2 of the MPM-ParVI paper
    PaperApic,
    /// Stein variational gradient descent
    Svgd,
    /// Independent exact draws
    Iid,
    /// Scrambled Sobol points
    Sobol,
    /// No-U-Turn sampler (with the cargo feature `nuts`)
    Nuts,
    /// The draws of a bigger sample with the least kernel Stein discrepancy
    SteinThinning,
    /// The points with the least energy distance to a bigger sample
    SupportPoints,
}

impl MethodName {
    /// The name as typed.
    pub fn as_str(self) -> &'static str {
        self.kind().name
    }

    /// Whether the method moves all particles by steps from a start, so that studies can vary their number.
    pub fn iterates(self) -> bool {
        self.kind().iterates
    }
}

impl Display for MethodName {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.as_str())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_names_are_those_of_the_command_line() {
        for &method in MethodName::value_variants() {
            assert_eq!(MethodName::from_str(method.as_str(), false), Ok(method));
        }
    }
}
