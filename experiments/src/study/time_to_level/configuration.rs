//! The configuration of the study `time-to-level`.

use serde::Deserialize;

use super::Case;
use crate::CommandError;
use crate::options::{Bounded, Dimension, MethodSpecification, ParticleCount, StepCount};
use crate::study::checks::{distinct, not_empty, positive, refusal, unset};
use crate::study::start_law::StartLaw;

/// A method and its rivals, from the same start to the same error.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct TimeToLevel {
    #[serde(rename = "kind")]
    _kind: String,
    /// Seed of every run.
    pub seed: u64,
    /// Threads; absent: as many as the environment gives.
    pub threads: Option<Bounded<1, 1024>>,
    /// d.
    pub dims: Vec<Dimension>,
    /// M.
    pub particles: ParticleCount,
    /// Where all methods begin, away from the target.
    pub start: StartLaw,
    /// Numbers of steps to try, growing; a run begins anew with each.
    pub steps: Vec<StepCount>,
    /// Runs on the clock with the number of steps that reaches the level, where one takes less than a second.
    pub repeats: Bounded<1, 1000>,
    /// A rival stops once a run has taken this many times the time of the method.
    pub largest_ratio: f64,
    /// The method that sets the clock.
    pub method: MethodSpecification,
    /// What it is compared with.
    pub rivals: Vec<MethodSpecification>,
}

impl TimeToLevel {
    /// The cases: in every dimension the method first, then its rivals.
    pub fn all_cases(&self) -> Result<Vec<Case>, CommandError> {
        not_empty("dims", &self.dims)?;
        not_empty("steps", &self.steps)?;
        if let Some(pair) = self.steps.windows(2).find(|pair| pair[0] >= pair[1]) {
            return Err(refusal("steps", format!("{} before {} do not grow", pair[0], pair[1])));
        }
        positive("largest-ratio", &[self.largest_ratio])?;
        self.start.check("start")?;
        self.check_method("method", &self.method)?;
        for rival in &self.rivals {
            self.check_method("rivals", rival)?;
        }
        let mut cases = Vec::new();
        for &dim in &self.dims {
            let methods = std::iter::once(&self.method).chain(&self.rivals);
            cases.extend(methods.enumerate().map(|(index, method)| Case {
                dim,
                particles: self.particles.get(),
                index,
                method: method.clone(),
            }));
        }
        distinct("dims or rivals", &cases)?;
        Ok(cases)
    }

    /// Refuses a method without steps and options that the study sets for all.
    fn check_method(&self, field: &str, method: &MethodSpecification) -> Result<(), CommandError> {
        if !method.name.iterates() {
            return Err(refusal(
                &format!("{field}.name"),
                format!("`{}` takes no steps", method.name),
            ));
        }
        unset(&format!("{field}.options.steps"), &method.options.steps, "steps")?;
        unset(
            &format!("{field}.options.start-mean"),
            &method.options.start_mean,
            "start",
        )?;
        unset(&format!("{field}.options.start-sd"), &method.options.start_sd, "start")
    }
}
