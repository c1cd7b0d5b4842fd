//! A method with its options, as a configuration states it.

use parvi::{Method, Run};
use serde::Deserialize;

use super::{Basis, MethodName, MethodOptions, OptionError, ParticleCount, StepCount, checked_when_read};

/// `{ name = "svgd", label = "Stein", options = { steps = 50 }, largest-particles = 2048 }`; options that do not fit the method are refused while reading.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(remote = "Self", deny_unknown_fields, rename_all = "kebab-case")]
pub struct MethodSpecification {
    /// The method.
    pub name: MethodName,
    /// A name of its own in tables and figures, where one method appears with several options.
    pub label: Option<String>,
    /// Its options.
    #[serde(default)]
    pub options: MethodOptions,
    /// Cases of a study with more particles are left out; `None`: there are none.
    pub largest_particles: Option<ParticleCount>,
}

checked_when_read!(MethodSpecification);

impl MethodSpecification {
    /// Refuses options that do not fit, or that no study has.
    pub fn check(&self) -> Result<(), OptionError> {
        self.options.method(self.name)?;
        self.options.check_study(self.name)
    }

    /// The name in tables and figures.
    pub fn label(&self) -> &str {
        self.label.as_deref().unwrap_or(self.name.as_str())
    }

    /// The names of several.
    pub fn labels(methods: &[Self]) -> impl Iterator<Item = &str> + Clone {
        methods.iter().map(Self::label)
    }

    /// The feature that has the method, where this build lacks it.
    pub fn lacks(&self) -> Option<&'static str> {
        let needs = [
            ("mesh", cfg!(feature = "mesh"), self.options.basis == Some(Basis::Mesh)),
            ("nuts", cfg!(feature = "nuts"), self.options.uses_chains(self.name)),
            ("paper", cfg!(feature = "paper"), self.name.is_paper()),
        ];
        let mut lacking = needs.into_iter().filter(|&(_, built, needed)| needed && !built);
        lacking.next().map(|(feature, ..)| feature)
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
        if let Some(steps) = steps.filter(|_| self.name.iterates()) {
            options.steps = i64::try_from(steps).ok().and_then(StepCount::new);
        }
        options.method(self.name)
    }
}
