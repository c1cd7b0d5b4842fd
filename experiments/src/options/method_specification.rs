//! A method with its options, as a configuration states it.

use parvi::{Method, Run, SampleError};
use serde::Deserialize;

use super::{MethodName, MethodOptions, OptionError};

/// `{ name = "mpm", options = { spacing = 0.5 } }`; options that do not fit the method are refused while reading.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(try_from = "Stated")]
pub struct MethodSpecification {
    /// The method.
    pub name: MethodName,
    /// A name of its own in tables and figures, where one method appears with several options.
    pub label: Option<String>,
    /// Its options.
    pub options: MethodOptions,
}

/// What the configuration says, before it is checked.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Stated {
    name: MethodName,
    label: Option<String>,
    #[serde(default)]
    options: MethodOptions,
}

impl TryFrom<Stated> for MethodSpecification {
    type Error = OptionError;

    fn try_from(stated: Stated) -> Result<Self, OptionError> {
        Self::new(stated.name, stated.label, stated.options)
    }
}

impl MethodSpecification {
    /// A method with options that fit it.
    ///
    /// # Errors
    /// An option that does not fit, or that no study has.
    pub fn new(name: MethodName, label: Option<String>, options: MethodOptions) -> Result<Self, OptionError> {
        options.method(name)?;
        options.check_study(name)?;
        Ok(Self { name, label, options })
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
