//! The search for the number of steps that reaches the level, within a budget of time.

use serde::Serialize;

use super::TimeToLevel;
use crate::statistics::weighted_quantile;
use crate::study::gaussian_runs;
use crate::study::prelude::*;

/// A run whose predicted time exceeds the budget by no more than this factor is begun.
const TOLERANCE: f64 = 1.2;
/// A run that takes longer than this is not repeated, in seconds.
const LONG: f64 = 1.0;

/// One run from the start.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trial {
    /// Steps.
    pub steps: usize,
    /// Time of the sampler.
    pub wall_seconds: f64,
    /// Squared energy distance at the end; `None`: diverged.
    pub energy_distance_squared: Option<f64>,
}

impl Trial {
    /// Whether it ended at the level or below.
    pub fn reaches(&self, level: f64) -> bool {
        self.energy_distance_squared.is_some_and(|energy| energy <= level)
    }
}

/// Least, median and largest time of the last run and its repeats, which have the same number of steps.
///
/// # Errors
/// [`CommandError::Statistics`] without any run.
pub fn seconds(trials: &[Trial]) -> Result<[f64; 3], CommandError> {
    let last = trials.last().map(|last| last.steps);
    let repeats = trials.iter().rev().take_while(|trial| Some(trial.steps) == last);
    let times: Vec<f64> = repeats.map(|trial| trial.wall_seconds).collect();
    let quantiles = weighted_quantile(&times, None, &[0.0, 0.5, 1.0])?;
    Ok([quantiles[0], quantiles[1], quantiles[2]])
}

/// What comes after the trials so far: the next number of steps, or as many as fit into the budget where those would not; an ending.
fn next(steps: &[usize], trials: &[Trial], level: f64, budget: Option<f64>) -> Result<usize, Status> {
    let done = trials.last().map_or(0, |last| last.steps);
    let following = steps
        .iter()
        .copied()
        .find(|&steps| steps > done)
        .ok_or(Status::OutOfSteps);
    let Some(last) = trials.last() else { return following };
    if last.reaches(level) {
        return Err(Status::Reached);
    }
    let Some(budget) = budget else { return following };
    if last.wall_seconds >= budget {
        return Err(Status::OutOfTime);
    }
    let following = following?;
    let per_step = last.wall_seconds / last.steps.max(1) as f64;
    if per_step * following as f64 <= TOLERANCE * budget {
        return Ok(following);
    }
    // Rounded up, so that the run takes the budget rather than a little less.
    let fitting = ((budget / per_step).ceil() as usize).min(following);
    if fitting > last.steps {
        Ok(fitting)
    } else {
        Err(Status::OutOfTime)
    }
}

/// Runs a method with more and more steps until it reaches the level or its budget of seconds is used up, and then the last
/// number of steps again if it is quick. Returns all runs in order.
pub fn search(
    study: &TimeToLevel,
    dim: Dimension,
    method: &MethodSpecification,
    (level, budget): (f64, Option<f64>),
    observer: &mut CaseObserver,
) -> Result<(Status, Vec<Trial>), CommandError> {
    let target = TargetSpecification::plain("gaussian", Some(dim));
    let mut one = |steps: usize| -> Result<Trial, CommandError> {
        let mut work = Sampled::new(&target, method, Some(steps), (study.particles.get(), study.seed))?;
        work.run.start = study.start.start(work.run.start);
        let (seconds, run) = timed(|| gaussian_runs::sampled(&work, observer));
        let (wall_seconds, energy_distance_squared) = match attempt(run)? {
            Ok((outcome, energy)) => (outcome.wall_seconds, Some(energy)),
            Err(_) => (seconds, None),
        };
        Ok(Trial {
            steps,
            wall_seconds,
            energy_distance_squared,
        })
    };
    let steps: Vec<usize> = study.steps.iter().map(|steps| steps.get()).collect();
    let mut trials = Vec::new();
    let ending = loop {
        match next(&steps, &trials, level, budget) {
            Ok(steps) => trials.push(one(steps)?),
            Err(ending) => break ending,
        }
    };
    if let Some(last) = trials.last().copied()
        && ending == Status::Reached
        && last.wall_seconds < LONG
    {
        for _ in 1..study.repeats.get() {
            trials.push(one(last.steps)?);
        }
    }
    Ok((ending, trials))
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEPS: [usize; 4] = [1, 2, 4, 8];

    fn trial(steps: usize, wall_seconds: f64, energy: Option<f64>) -> Trial {
        Trial {
            steps,
            wall_seconds,
            energy_distance_squared: energy,
        }
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
        assert_eq!(
            seconds(&times.map(|(steps, time)| trial(steps, time, None))).unwrap(),
            [1.0, 2.0, 3.0]
        );
        assert!(seconds(&[]).is_err());
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
