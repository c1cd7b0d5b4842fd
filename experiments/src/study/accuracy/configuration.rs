//! The configuration of the study `accuracy`.

use serde::Deserialize;

use crate::CommandError;
use crate::options::{Bounded, Dimension, MethodName, MethodOptions, MethodSpecification, OptionError, ParticleCount};
use crate::study::checks::{distinct, not_empty, refusal};
use crate::study::gaussian_runs::{Case, GaussianPlan};

/// All methods in all dimensions at all numbers of particles.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Accuracy {
    #[serde(rename = "kind")]
    _kind: String,
    /// One run per seed.
    pub seeds: Vec<u64>,
    /// Threads; absent: as many as the environment gives.
    threads: Option<Bounded<1, 1024>>,
    /// d.
    pub dims: Vec<Dimension>,
    /// M.
    pub particles: Vec<ParticleCount>,
    /// The methods.
    pub methods: Vec<Entry>,
}

/// A method and how far it is taken: `{ name = "svgd", label = "Stein", options = { … }, largest-particles = 2048 }`.
#[derive(Clone, Debug, Deserialize)]
#[serde(try_from = "Stated")]
pub struct Entry {
    /// The method.
    pub method: MethodSpecification,
    /// The largest M at which it runs; `None`: all.
    pub largest_particles: Option<ParticleCount>,
}

/// What the configuration says, before it is checked.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct Stated {
    name: MethodName,
    label: Option<String>,
    #[serde(default)]
    options: MethodOptions,
    largest_particles: Option<ParticleCount>,
}

impl TryFrom<Stated> for Entry {
    type Error = OptionError;

    fn try_from(stated: Stated) -> Result<Self, OptionError> {
        let method = MethodSpecification::new(stated.name, stated.label, stated.options)?;
        Ok(Self {
            method,
            largest_particles: stated.largest_particles,
        })
    }
}

impl GaussianPlan for Accuracy {
    fn seeds(&self) -> &[u64] {
        &self.seeds
    }

    fn threads(&self) -> Option<Bounded<1, 1024>> {
        self.threads
    }

    /// The cases, dimension by dimension, few particles first.
    fn cases(&self) -> Result<Vec<Case>, CommandError> {
        not_empty("seeds", &self.seeds)?;
        not_empty("dims", &self.dims)?;
        not_empty("particles", &self.particles)?;
        not_empty("methods", &self.methods)?;
        let mut labels: Vec<&str> = self.methods.iter().map(|entry| entry.method.label()).collect();
        labels.sort_unstable();
        if let Some(pair) = labels.windows(2).find(|pair| pair[0] == pair[1]) {
            let message = format!("two are called `{}`; give one of them a `label` of its own", pair[0]);
            return Err(refusal("methods", message));
        }
        let mut cases = Vec::new();
        for &dim in &self.dims {
            for &particles in &self.particles {
                let within = |entry: &&Entry| entry.largest_particles.is_none_or(|most| particles <= most);
                for entry in self.methods.iter().filter(within) {
                    cases.extend(self.seeds.iter().map(|&seed| Case {
                        dim,
                        particles: particles.get(),
                        series: entry.method.label().to_owned(),
                        method: entry.method.clone(),
                        spacing_factor: None,
                        seed,
                    }));
                }
            }
        }
        distinct("dims, particles or seeds", &cases)?;
        Ok(cases)
    }
}
