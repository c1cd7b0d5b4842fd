//! A method with its options, as a configuration states it.

use parvi::{Method, Run, SampleError};
use serde::de::Error;
use serde::{Deserialize, Deserializer};

use super::{Basis, MethodName, MethodOptions, OptionError};

/// `{ name = "mpm", options = { spacing = 0.5 } }`; options that do not fit the method are refused while reading.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(remote = "Self", deny_unknown_fields)]
pub struct MethodSpecification {
    /// The method.
    pub name: MethodName,
    /// A name of its own in tables and figures, where one method appears with several options.
    pub label: Option<String>,
    /// Its options.
    #[serde(default)]
    pub options: MethodOptions,
}

impl<'de> Deserialize<'de> for MethodSpecification {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let stated = Self::deserialize(deserializer)?;
        stated.checked().map_err(D::Error::custom)
    }
}

impl MethodSpecification {
    /// The same, if its options fit.
    ///
    /// # Errors
    /// An option that does not fit, or that no study has.
    pub fn checked(self) -> Result<Self, OptionError> {
        self.options.method(self.name)?;
        self.options.check_study(self.name)?;
        Ok(self)
    }

    /// The name in tables and figures.
    pub fn label(&self) -> &str {
        self.label.as_deref().unwrap_or(self.name.as_str())
    }

    /// Refuses a method that this build lacks, before anything is run.
    ///
    /// # Errors
    /// [`SampleError::NotBuilt`].
    pub fn check_built(&self) -> Result<(), SampleError> {
        let needs = [
            ("mesh", cfg!(feature = "mesh"), self.options.basis == Some(Basis::Mesh)),
            ("nuts", cfg!(feature = "nuts"), self.options.uses_chains(self.name)),
            (
                "paper",
                cfg!(feature = "paper"),
                matches!(self.name, MethodName::PaperPic | MethodName::PaperApic),
            ),
        ];
        match needs.into_iter().find(|&(_, built, needed)| needed && !built) {
            Some((name, ..)) => Err(SampleError::NotBuilt {
                method: name,
                feature: name,
            }),
            None => Ok(()),
        }
    }

    /// A run that begins where the options say.
    pub fn run(&self, particles: usize, seed: u64) -> Run {
        let mut run = Run::new(particles, seed);
        run.start = self.options.start();
        run
    }

    /// The method for the sampler, with another number of steps where one is given and the method takes steps.
    pub fn method(&self, steps: Option<usize>) -> Result<Method, OptionError> {
        let mut options = self.options.clone();
        if self.name.iterates()
            && let Some(steps) = steps
        {
            options.steps = i64::try_from(steps).ok().and_then(super::StepCount::new);
        }
        options.method(self.name)
    }
}
