//! Study `paper`: what Algorithms 1 and 2 of the MPM-ParVI paper reach, as written and with guards.
//!
//! A base setting and its changes, one list of them at a time, on one list of targets. Particles are looked at on their way, since the paper has "transient
//! or steady" configurations; a run that diverges is a row with its step and reason.

mod answers;
mod body;
mod configuration;
mod figure;
mod report;
mod table;
mod variant;
mod watch;

use parvi::{Run, SampleError};

pub use configuration::{Paper, Setting};
use watch::{Seen, Watch};

use super::prelude::*;
use crate::sampling;

impl Study for Paper {
    type Work = Setting;

    const KIND: &'static str = "paper";
    const COLUMNS: &'static str = "case method variant target dim material schedule score volumes friction spacing time_step steps particles \
         seed status reason failed_step message energy_level start_energy final_energy final_sliced final_mean final_deviation final_mass \
         best_step best_energy best_sliced evaluations active_nodes storage_bytes wall_seconds \
         reference_size reference_mean_error reference_deviation_error";
    const REPORT: Report<Self> = report::report;

    fn cases(&self) -> Result<Vec<Case<Setting>>, CommandError> {
        self.all_cases()?.into_iter().map(Setting::case).collect()
    }

    fn run(&self, case: &Case<Setting>, row: &mut Row, tools: Tools<'_>) -> Result<(), CommandError> {
        let (setting, is_body) = (&case.work, case.work.rival.is_none());
        let yardstick = tools.yardstick.of(&setting.target, &self.yardstick(), row)?;
        let mut run = Run::new(setting.particles.get(), setting.seed);
        row.set("energy_level", yardstick.mean_distance() / run.particles as f64);
        (run.start.mean, run.start.standard_deviation) = (self.start_mean, self.start_sd);
        let (target, method) = (setting.target.clone(), setting.method()?);
        let work = Sampled { target, method, run };
        let mut watch = Watch {
            inner: tools.observer,
            yardstick,
            every: self.look_every.get(),
            reach: self.reach,
            seen: Seen::default(),
        };
        let result = match is_body {
            true => sampling::sample(&work.target, &work.method, &work.run, &mut watch),
            false => work.sample_or_draw(yardstick, watch.inner),
        };
        let mut seen = watch.seen;
        if let Some((step, message)) = seen.ended.take() {
            let failure = Failure::new(Status::Diverged, message);
            row.fail_in(("outside range", Some(step)), failure);
        } else {
            let error = result.as_ref().err().filter(|_| is_body);
            let why = error.map_or(("other", None), reason);
            match attempt(result)? {
                Err(failure) => row.fail_in(why, failure),
                Ok(outcome) => {
                    let steps = is_body.then_some(outcome.steps);
                    row.set("active_nodes", outcome.active_nodes.filter(|_| is_body));
                    row.set("storage_bytes", outcome.storage_bytes.filter(|_| is_body));
                    row.set("wall_seconds", outcome.wall_seconds - seen.looking.as_secs_f64());
                    row.set("evaluations", outcome.evaluations());
                    let errors = end(row, attempt(yardstick.measure(&outcome.particles))?, steps);
                    if let Some((step, errors)) = steps.zip(errors) {
                        seen.note(step, errors);
                    }
                }
            }
        }
        row.set("start_energy", seen.start.map(|errors| errors.energy_distance_squared));
        if let Some((step, errors)) = seen.best {
            row.set("best_step", step);
            row.set("best_energy", errors.energy_distance_squared);
            row.set("best_sliced", errors.sliced_wasserstein);
        }
        Ok(())
    }
}

/// Why the sampler gave nothing, in a word or two, and in which step.
type Reason = (&'static str, Option<usize>);

/// Notes the errors of the particles at the end, which is after so many steps of a body.
fn end(row: &mut Row, errors: Attempt<Errors>, step: Option<usize>) -> Option<Errors> {
    let failed = |failure: Failure| row.fail_in(("outside range", step), failure);
    let errors = errors.map_err(failed).ok()?;
    row.set("final_energy", errors.energy_distance_squared);
    row.set("final_sliced", errors.sliced_wasserstein);
    row.set("final_mean", errors.mean);
    row.set("final_deviation", errors.deviation);
    row.set("final_mass", errors.mass);
    Some(errors)
}

fn reason(error: &CommandError) -> Reason {
    let CommandError::Sample(error) = error else {
        let overflows = matches!(error, CommandError::NotFinite(_));
        return (if overflows { "not finite" } else { "other" }, None);
    };
    let word = match error {
        SampleError::ScoreNotFinite { .. } | SampleError::Diverged { .. } => "not finite",
        SampleError::Mechanics { source, .. } => match format!("{source:?}") {
            text if text.contains("NaN") || text.contains("inf") => "not finite",
            text if text.starts_with("PositionOutOfRange") => "outside range",
            text if text.starts_with("Deformation") => "turned inside out",
            _ => "other",
        },
        _ => "other",
    };
    (word, error.step())
}
