//! The methods, a file for each family: name, options, and how the options of the command become those of the library.
//!
//! A new method is a [`MethodKind`] in a file of its own, and its variant of [`MethodName`] with its arm in [`MethodName::kind`].

mod condensed;
mod draws;
mod mpm;
mod nuts;
mod paper;
mod svgd;

use parvi::Method;

use super::{MethodName, MethodOptions, OptionError};

/// A method as the command knows it.
pub struct MethodKind {
    /// The name as typed.
    pub name: &'static str,
    /// The names of its options, with spaces between.
    pub options: &'static str,
    /// Whether it moves all particles by steps from a start, so that studies can vary their number. Draws come at once or one after the
    /// other.
    pub iterates: bool,
    /// The method for the sampler, with a number of steps where one is given; the options have been found to fit.
    pub build: fn(&MethodOptions, Option<usize>) -> Result<Method, OptionError>,
}

impl MethodKind {
    /// Whether it has an option.
    pub fn has(&self, option: &str) -> bool {
        self.options.split(' ').any(|name| name == option)
    }
}

impl MethodName {
    /// What the method is.
    pub fn kind(self) -> &'static MethodKind {
        match self {
            Self::Mpm => &mpm::KIND,
            Self::Ais => &draws::AIS,
            Self::PaperPic => &paper::PIC,
            Self::PaperApic => &paper::APIC,
            Self::Svgd => &svgd::KIND,
            Self::Iid => &draws::IID,
            Self::Sobol => &draws::SOBOL,
            Self::Nuts => &nuts::KIND,
            Self::SteinThinning => &condensed::STEIN_THINNING,
            Self::SupportPoints => &condensed::SUPPORT_POINTS,
        }
    }
}
