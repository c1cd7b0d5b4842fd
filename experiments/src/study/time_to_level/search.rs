//! The search for the number of steps that reaches the level, within a budget of time.

use super::TimeToLevel;
use crate::study::contestant::Contestant;
use crate::study::gaussian_runs;
use crate::study::prelude::*;

/// A run whose predicted time exceeds the budget by no more than this factor is begun.
const TOLERANCE: f64 = 1.2;
/// A run that takes longer than this is not repeated, in seconds.
const LONG: f64 = 1.0;
/// What is kept of a run: its steps, the sampler's time, and the squared energy distance at the end, where it did not diverge.
pub const COLUMNS: &str = "steps wall_seconds energy_distance_squared";

/// The last run and its repeats, which have the same number of steps.
pub fn last(trials: &[Row]) -> Rows<'_> {
    let last = trials.last().and_then(|trial| trial.count("steps"));
    trials.iter().collect::<Rows<'_>>().with("steps", last)
}

/// What comes after the trials so far: the next number of steps, or as many as fit into the budget where those would not; an ending.
fn next(steps: &[usize], trials: &[Row], level: f64, budget: Option<f64>) -> Result<usize, Status> {
    let done = trials.last().and_then(|last| last.count("steps")).unwrap_or(0);
    let larger = steps.iter().copied().find(|&steps| steps > done);
    let following = larger.ok_or(Status::OutOfSteps);
    let Some(last) = trials.last() else { return following };
    if last.is_within(ENERGY, level) {
        return Err(Status::Reached);
    }
    let (Some(budget), Some(seconds)) = (budget, last.number(SECONDS)) else {
        return following;
    };
    if seconds >= budget {
        return Err(Status::OutOfTime);
    }
    let following = following?;
    let per_step = seconds / done.max(1) as f64;
    if per_step * following as f64 <= TOLERANCE * budget {
        return Ok(following);
    }
    // Rounded up, so that the run takes the budget rather than a little less.
    let fitting = ((budget / per_step).ceil() as usize).min(following);
    Some(fitting).filter(|&steps| steps > done).ok_or(Status::OutOfTime)
}

/// Runs a method with more and more steps until it reaches the level or its budget of seconds is used up, and then the last
/// number of steps again if it is quick. Returns all runs in order.
pub fn search(
    study: &TimeToLevel,
    contestant: &Contestant,
    (level, budget): (f64, Option<f64>),
    observer: &mut Bar,
) -> Result<(Status, Vec<Row>), CommandError> {
    let Contestant {
        target,
        method,
        particles,
        ..
    } = contestant;
    let mut one = |steps: usize| -> Result<Row, CommandError> {
        let mut work = Sampled::new(target, method, Some(steps), (*particles, study.seed))?;
        work.run.start = study.start.start(work.run.start);
        let (seconds, run) = timed(|| gaussian_runs::sampled(&work, observer));
        let run = attempt(run)?.ok();
        let seconds = run.as_ref().map_or(seconds, |(outcome, _)| outcome.wall_seconds);
        let trial = Row::default().with("steps", steps).with(SECONDS, seconds);
        Ok(trial.with(ENERGY, run.map(|(_, energy)| energy)))
    };
    let steps: Vec<usize> = study.steps.iter().map(|steps| steps.get()).collect();
    let mut trials = Vec::new();
    let ending = loop {
        match next(&steps, &trials, level, budget) {
            Ok(steps) => trials.push(one(steps)?),
            Err(ending) => break ending,
        }
    };
    let last = trials.last().filter(|_| ending == Status::Reached);
    let quick = last.filter(|last| last.number(SECONDS).is_some_and(|seconds| seconds < LONG));
    if let Some(steps) = quick.and_then(|last| last.count("steps")) {
        for _ in 1..study.repeats.get() {
            trials.push(one(steps)?);
        }
    }
    Ok((ending, trials))
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEPS: [usize; 4] = [1, 2, 4, 8];

    fn trial(steps: usize, wall_seconds: f64, energy: Option<f64>) -> Row {
        let trial = Row::default().with("steps", steps).with(SECONDS, wall_seconds);
        trial.with(ENERGY, energy)
    }

    #[test]
    fn steps_grow_until_the_level_is_reached() {
        assert_eq!(next(&STEPS, &[], 1.0, None), Ok(1));
        assert_eq!(next(&STEPS, &[trial(1, 9.0, Some(3.0))], 1.0, None), Ok(2));
        let reached = [trial(2, 9.0, Some(1.0))];
        assert_eq!(next(&STEPS, &reached, 1.0, None), Err(Status::Reached));
        let diverged = [trial(8, 9.0, None)];
        assert_eq!(next(&STEPS, &diverged, 1.0, None), Err(Status::OutOfSteps));
        assert_eq!(next(&[], &[], 1.0, None), Err(Status::OutOfSteps));
    }

    #[test]
    fn the_time_is_that_of_the_last_number_of_steps() {
        let times = [(1, 9.0), (2, 3.0), (2, 1.0), (2, 2.0)];
        let trials = times.map(|(steps, time)| trial(steps, time, None));
        assert_eq!(last(&trials).values(SECONDS), [3.0, 1.0, 2.0]);
        assert!(last(&[]).is_empty());
    }

    #[test]
    fn a_run_too_long_for_the_budget_is_shortened_to_it() {
        let trials = [trial(4, 4.0, Some(3.0))];
        assert_eq!(next(&STEPS, &trials, 1.0, Some(7.0)), Ok(8), "within a fifth");
        assert_eq!(next(&STEPS, &trials, 1.0, Some(6.0)), Ok(6));
        assert_eq!(next(&STEPS, &trials, 1.0, Some(4.0)), Err(Status::OutOfTime));
        let slow = [trial(1, 3.0, Some(3.0))];
        assert_eq!(next(&STEPS, &slow, 1.0, Some(2.0)), Err(Status::OutOfTime));
    }
}
