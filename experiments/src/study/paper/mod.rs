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
mod table;
mod variant;
mod watch;

use parvi::{Method, Run, SampleError};

pub use configuration::{Paper, Setting};
use watch::Watch;

use super::prelude::*;
use crate::sampling::{self, Outcome};

impl Study for Paper {
    type Work = Setting;

    const KIND: &'static str = "paper";
    const COLUMNS: &'static str = "case method variant target dim material schedule score volumes friction spacing time_step steps particles \
         seed status reason failed_step message energy_level start_energy final_energy final_sliced final_mean final_deviation final_mass \
         best_step best_energy best_sliced evaluations active_nodes storage_bytes wall_seconds";
    const REPORT: Report<Self> = report::report;

    fn methods(&self) -> Vec<&MethodSpecification> {
        self.rivals.iter().collect()
    }

    fn cases(&self) -> Result<Vec<Case<Setting>>, CommandError> {
        self.all_cases()?.into_iter().map(Setting::case).collect()
    }

    fn run(&self, case: &Case<Setting>, row: &mut Row, tools: Tools<'_>) -> Result<(), CommandError> {
        let setting = &case.work;
        let yardstick = tools.yardstick.of(&setting.target, &self.yardstick())?;
        row.set(
            "energy_level",
            yardstick.mean_distance() / setting.particles.get() as f64,
        );
        let mut run = Run::new(setting.particles.get(), setting.seed);
        (run.start.mean, run.start.standard_deviation) = (self.start_mean, self.start_sd);
        let Some(rival) = &setting.rival else {
            return self.run_body(setting, &run, yardstick, tools.observer, row);
        };
        let (target, method) = (setting.target.clone(), rival.method(None)?);
        match attempt(Sampled { target, method, run }.sample_or_draw(yardstick, tools.observer))? {
            Err(failure) => fail(row, "other", None, failure),
            Ok(outcome) => {
                row.set("wall_seconds", outcome.wall_seconds);
                end(row, &outcome, yardstick, None)?;
            }
        }
        Ok(())
    }
}

impl Paper {
    fn run_body(
        &self,
        setting: &Setting,
        run: &Run,
        yardstick: &dyn Yardstick,
        observer: &mut Bar,
        row: &mut Row,
    ) -> Result<(), CommandError> {
        let material = setting.material.material();
        let material = material.map_err(|error| refusal("materials", error.to_string()))?;
        let method = Method::Paper(setting.options(material));
        let mut watch = Watch::new(observer, yardstick, self.look_every.get(), self.reach);
        let (seconds, result) = timed(|| sampling::sample(&setting.target, &method, run, &mut watch));
        if let Some((step, message)) = watch.ended.take() {
            let failure = Failure::new(Status::Diverged, message);
            fail(row, "outside range", Some(step), failure);
        } else {
            let why = result.as_ref().err().map(reason);
            match attempt(result)? {
                Err(failure) => {
                    let (word, step) = why.unwrap_or(("other", None));
                    fail(row, word, step, failure);
                }
                Ok(outcome) => {
                    row.set("active_nodes", outcome.active_nodes);
                    row.set("storage_bytes", outcome.storage_bytes);
                    row.set("wall_seconds", seconds - watch.looking.as_secs_f64());
                    if let Some(errors) = end(row, &outcome, yardstick, Some(outcome.steps))? {
                        watch.note(outcome.steps, errors);
                    }
                }
            }
        }
        row.set("start_energy", watch.start.map(|errors| errors.energy_distance_squared));
        if let Some((step, errors)) = watch.best {
            row.set("best_step", step);
            row.set("best_energy", errors.energy_distance_squared);
            row.set("best_sliced", errors.sliced_wasserstein);
        }
        Ok(())
    }
}

/// Notes a run without particles: why, in a word or two, and the step in which that was seen.
fn fail(row: &mut Row, reason: &str, step: Option<usize>, failure: Failure) {
    row.set("status", failure.status);
    row.set("message", failure.reason);
    row.set("reason", reason);
    row.set("failed_step", step);
}

/// Notes particles and their errors at the end, which is after so many steps of a body.
fn end(
    row: &mut Row,
    outcome: &Outcome,
    yardstick: &dyn Yardstick,
    step: Option<usize>,
) -> Result<Option<Errors>, CommandError> {
    row.set("evaluations", outcome.evaluations());
    let errors = match attempt(yardstick.measure(&outcome.particles))? {
        Ok(errors) => errors,
        Err(failure) => {
            fail(row, "outside range", step, failure);
            return Ok(None);
        }
    };
    row.set("final_energy", errors.energy_distance_squared);
    row.set("final_sliced", errors.sliced_wasserstein);
    row.set("final_mean", errors.mean);
    row.set("final_deviation", errors.deviation);
    row.set("final_mass", errors.mass);
    Ok(Some(errors))
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
