//! The methods, a file for each family: name, options, and how these options become those of the library.
//!
//! A new method is a [`MethodKind`] in a file of its own, and its line of `methods!` below.

mod condensed;
mod draws;
mod mpm;
mod nuts;
mod paper;
mod smc;
mod svgd;

use std::fmt::{self, Display, Formatter};

use clap::ValueEnum;
use parvi::Method;
use serde::{Deserialize, Serialize};

use super::{MethodOptions, OptionError};

/// A method as it is asked for.
pub struct MethodKind {
    /// The name as typed.
    pub name: &'static str,
    /// The names of its options, with spaces between.
    pub options: &'static str,
    /// Whether it moves all particles by steps from a start, so that studies can vary their number. Draws come at once or one after the
    /// other.
    pub iterates: bool,
    /// The method for the sampler, with a number of steps where one is given; the options have been found to fit.
    pub build: Build,
}

/// The method of some options, with a number of steps where one is given.
type Build = fn(&MethodOptions, Option<usize>) -> Result<Method, OptionError>;

impl MethodKind {
    /// A method without steps.
    const fn of_draws(name: &'static str, options: &'static str, build: Build) -> Self {
        Self {
            name,
            options,
            iterates: false,
            build,
        }
    }

    /// Whether it has an option.
    pub fn has(&self, option: &str) -> bool {
        is_among(self.options, option)
    }
}

/// Whether a name is one of a list with spaces between.
pub fn is_among(list: &str, name: &str) -> bool {
    list.split(' ').any(|known| known == name)
}

/// The methods that have an option, as help says it: `mpm, paper-*, svgd`.
pub fn owners(option: &str) -> String {
    let all = MethodName::value_variants().iter();
    let having = all.filter(|method| method.kind().has(option));
    let named = |method: &MethodName| if method.is_paper() { "paper-*" } else { method.as_str() };
    let mut names: Vec<&str> = having.map(named).collect();
    names.dedup();
    names.join(", ")
}

/// The methods by name: variant, what `--help` says, and what the method is.
macro_rules! methods {
    ($($(#[$meta:meta])* $variant:ident = $kind:expr;)*) => {
        /// A sampling method.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, ValueEnum, Serialize, Deserialize)]
        #[serde(rename_all = "kebab-case")]
        pub enum MethodName {
            $($(#[$meta])* $variant,)*
        }

        impl MethodName {
            /// What the method is.
            pub(crate) fn kind(self) -> &'static MethodKind {
                match self {
                    $(Self::$variant => &$kind,)*
                }
            }
        }
    };
}

methods! {
    /// Material point method with the calibrated gas law
    #[default]
    Mpm = mpm::KIND;
    /// Adaptive importance sampling, condensed to particles
    Ais = draws::AIS;
    /// Tempered sequential Monte Carlo: populations with Langevin moves
    Smc = smc::KIND;
    /// Algorithm 1 of the MPM-ParVI paper
    PaperPic = paper::PIC;
    /// Algorithm 2 of the MPM-ParVI paper
    PaperApic = paper::APIC;
    /// Stein variational gradient descent
    Svgd = svgd::KIND;
    /// Independent exact draws
    Iid = draws::IID;
    /// Scrambled Sobol points
    Sobol = draws::SOBOL;
    /// No-U-Turn sampler (with the cargo feature `nuts`)
    Nuts = nuts::KIND;
    /// The draws of a bigger sample with the least kernel Stein discrepancy
    SteinThinning = condensed::STEIN_THINNING;
    /// The points with the least energy distance to a bigger sample
    SupportPoints = condensed::SUPPORT_POINTS;
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

    /// Whether it is one of the paper's two algorithms.
    pub fn is_paper(self) -> bool {
        matches!(self, Self::PaperPic | Self::PaperApic)
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
