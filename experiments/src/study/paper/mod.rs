//! Study `paper`: what Algorithms 1 and 2 of the MPM-ParVI paper reach, as written and with guards.
//!
//! A base setting and its changes, one list of them at a time, on one list of targets. Particles are looked at on their way, since the paper has "transient
//! or steady" configurations; a run that diverges is a row with its step and reason.

mod answers;
mod body;
mod configuration;
mod figure;
mod material;
mod report;
mod row;
mod table;
mod watch;

use std::time::Instant;

use parvi::{Method, Run, SampleError};

use body::Body;
pub use configuration::Paper;
use row::Row;
use watch::Watch;

use super::attempt::{Attempt, Status, attempt};
use super::checks::refusal;
use super::definition::{self, Report, Study, Work};
use super::directory::StudyDirectory;
use super::results::single_line;
use super::yardstick::{CurrentYardstick, Yardstick, measured, measured_run};
use crate::CommandError;
use crate::options::{MethodSpecification, TargetSpecification};
use crate::progress::CaseObserver;
use crate::sampling;

/// A run: of a body, or of a rival.
#[derive(Clone, Debug)]
pub struct Case {
    target: TargetSpecification,
    body: Body,
    rival: Option<MethodSpecification>,
    steps: usize,
    particles: usize,
    seed: u64,
}

impl Case {
    fn method(&self) -> String {
        let of_body = || format!("algorithm {}", self.body.algorithm);
        self.rival
            .as_ref()
            .map_or_else(of_body, |rival| rival.label().to_owned())
    }

    /// Everything but target and seed, by name.
    fn parts(&self) -> Vec<(&'static str, String)> {
        let size = ("M", self.particles.to_string());
        if self.rival.is_some() {
            return vec![("method", self.method()), size];
        }
        let mut parts = self.body.parts().to_vec();
        parts.extend([size, ("T", self.steps.to_string())]);
        parts
    }
}

impl definition::Case for Case {
    fn id(&self) -> String {
        let parts: Vec<String> = self
            .parts()
            .into_iter()
            .map(|(name, text)| format!("{name} {text}"))
            .collect();
        format!("{}, {}, seed {}", self.target.label(), parts.join(", "), self.seed)
    }

    fn method(&self) -> Option<&MethodSpecification> {
        self.rival.as_ref()
    }

    fn cost(&self) -> f64 {
        let looks = 100.0;
        let dim = self.target.dimension().unwrap_or(1);
        (self.particles * self.steps) as f64 * (3f64.powi(dim as i32) + looks)
    }
}

impl Study for Paper {
    type Case = Case;
    type Row = Row;
    type Shared = CurrentYardstick;

    const KIND: &'static str = "paper";

    fn seeds(&self) -> Vec<u64> {
        self.all_seeds()
    }

    fn cases(&self) -> Result<Vec<Case>, CommandError> {
        self.all_cases()
    }

    fn run(&self, case: &Case, work: Work<'_, CurrentYardstick>) -> Result<Row, CommandError> {
        let yardstick = work.shared.of(&case.target, &self.yardstick(), None)?;
        let level = yardstick.mean_distance() / case.particles as f64;
        let mut row = Row::new(case, case.target.dimension()?, level);
        let mut run = Run::new(case.particles, case.seed);
        (run.start.mean, run.start.standard_deviation) = (self.start_mean, self.start_sd);
        match &case.rival {
            Some(rival) => run_rival(case, &rival.method(None)?, &run, yardstick, work.observer, &mut row)?,
            None => self.run_body(case, &run, yardstick, work.observer, &mut row)?,
        }
        Ok(row)
    }

    fn report(&self, rows: &[Row], _: &StudyDirectory) -> Result<Report, CommandError> {
        report::report(self, rows)
    }
}

impl Paper {
    fn run_body(
        &self,
        case: &Case,
        run: &Run,
        yardstick: &dyn Yardstick,
        observer: &mut CaseObserver,
        row: &mut Row,
    ) -> Result<(), CommandError> {
        let material = case.body.material.material();
        let material = material.map_err(|error| refusal("materials", error.to_string()))?;
        let method = Method::Paper(case.body.options(material, case.steps));
        let mut watch = Watch::new(observer, yardstick, self.look_every.get(), self.reach);
        let begin = Instant::now();
        let result = sampling::sample(&case.target, &method, run, &mut watch);
        let seconds = begin.elapsed().saturating_sub(watch.looking).as_secs_f64();
        if let Some((step, message)) = watch.ended.take() {
            row.fail(Status::Diverged, "outside range", Some(step), single_line(message));
        } else {
            let why = result.as_ref().err().map(reason);
            match attempt(result)? {
                Attempt::Failed(status, message) => {
                    let (word, step) = why.unwrap_or(("other", None));
                    row.fail(status, word, step, message);
                }
                Attempt::Finished(outcome) => {
                    row.evaluations = Some(outcome.evaluations());
                    row.active_nodes = outcome.active_nodes;
                    row.storage_bytes = outcome.storage_bytes;
                    row.wall_seconds = Some(seconds);
                    match measured(yardstick, &outcome)? {
                        Attempt::Finished(errors) => {
                            watch.note(outcome.steps, errors);
                            row.end(&errors);
                        }
                        Attempt::Failed(status, message) => {
                            row.fail(status, "outside range", Some(outcome.steps), message);
                        }
                    }
                }
            }
        }
        row.start_energy = watch.start.map(|errors| errors.energy_distance_squared);
        row.best_step = watch.best.map(|(step, _)| step);
        row.best_energy = watch.best.map(|(_, errors)| errors.energy_distance_squared);
        row.best_sliced = watch.best.map(|(_, errors)| errors.sliced_wasserstein);
        Ok(())
    }
}

fn run_rival(
    case: &Case,
    method: &Method,
    run: &Run,
    yardstick: &dyn Yardstick,
    observer: &mut CaseObserver,
    row: &mut Row,
) -> Result<(), CommandError> {
    match measured_run(&case.target, method, run, yardstick, observer)? {
        Attempt::Failed(status, message) => row.fail(status, "other", None, message),
        Attempt::Finished(measured) => {
            row.evaluations = Some(measured.outcome.evaluations());
            row.wall_seconds = Some(measured.outcome.wall_seconds);
            match measured.errors {
                Attempt::Finished(errors) => row.end(&errors),
                Attempt::Failed(status, message) => row.fail(status, "outside range", None, message),
            }
        }
    }
    Ok(())
}

/// Why the sampler gave nothing, and in which step.
fn reason(error: &CommandError) -> (&'static str, Option<usize>) {
    match error {
        CommandError::NotFinite { .. } => ("not finite", None),
        CommandError::Sample(SampleError::ScoreNotFinite { step, .. } | SampleError::Diverged { step, .. }) => {
            ("not finite", Some(*step))
        }
        CommandError::Sample(SampleError::Mechanics { step, source }) => {
            let text = format!("{source:?}");
            let word = match () {
                () if text.contains("NaN") || text.contains("inf") => "not finite",
                () if text.starts_with("PositionOutOfRange") => "outside range",
                () if text.starts_with("Deformation") => "turned inside out",
                () => "other",
            };
            (word, Some(*step))
        }
        _ => ("other", None),
    }
}
