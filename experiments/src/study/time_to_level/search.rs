//! The search for the number of steps that reaches the level, within a budget of time.

use serde::{Deserialize, Serialize};

use super::{Case, TimeToLevel};
use crate::CommandError;
use crate::progress::CaseObserver;
use crate::statistics::weighted_quantile;
use crate::study::attempt::Attempt;
use crate::study::gaussian_runs::measured;

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

/// How a search ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Ending {
    /// The level was reached.
    Reached,
    /// A run took the whole budget without reaching it.
    OutOfTime,
    /// Even the largest number of steps did not reach it.
    OutOfSteps,
}

/// Least, median and largest time of the last run and its repeats, which have the same number of steps.
///
/// # Errors
/// [`CommandError::Statistics`] without any run.
pub fn seconds(trials: &[Trial]) -> Result<[f64; 3], CommandError> {
    let repeats = trials
        .iter()
        .rev()
        .take_while(|trial| Some(trial.steps) == trials.last().map(|last| last.steps));
    let times: Vec<f64> = repeats.map(|trial| trial.wall_seconds).collect();
    let quantiles = weighted_quantile(&times, None, &[0.0, 0.5, 1.0])?;
    Ok([quantiles[0], quantiles[1], quantiles[2]])
}

/// What comes after the trials so far.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Next {
    /// A run with so many steps.
    Run(usize),
    /// Nothing.
    End(Ending),
}

/// Decides from the trials so far: the next number of steps, or as many as fit into the budget where those would not.
fn next(steps: &[usize], trials: &[Trial], level: f64, budget: Option<f64>) -> Next {
    let Some(last) = trials.last() else {
        return steps
            .first()
            .map_or(Next::End(Ending::OutOfSteps), |&steps| Next::Run(steps));
    };
    if last.reaches(level) {
        return Next::End(Ending::Reached);
    }
    let following = steps.iter().copied().find(|&steps| steps > last.steps);
    let Some(budget) = budget else {
        return following.map_or(Next::End(Ending::OutOfSteps), Next::Run);
    };
    if last.wall_seconds >= budget {
        return Next::End(Ending::OutOfTime);
    }
    let Some(following) = following else {
        return Next::End(Ending::OutOfSteps);
    };
    let per_step = last.wall_seconds / last.steps.max(1) as f64;
    if per_step * following as f64 <= TOLERANCE * budget {
        return Next::Run(following);
    }
    // Rounded up, so that the run takes the budget rather than a little less.
    let fitting = ((budget / per_step).ceil() as usize).min(following);
    if fitting > last.steps {
        Next::Run(fitting)
    } else {
        Next::End(Ending::OutOfTime)
    }
}

/// Runs a method with more and more steps until it reaches the level or its budget of seconds is used up, and then the last
/// number of steps again if it is quick. Returns all runs in order.
pub fn search(
    study: &TimeToLevel,
    case: &Case,
    level: f64,
    budget: Option<f64>,
    observer: &mut CaseObserver,
) -> Result<(Ending, Vec<Trial>), CommandError> {
    let mut run = case.method.run(case.particles, study.seed);
    run.start = study.start.start(run.start);
    let mut one = |steps: usize| -> Result<Trial, CommandError> {
        let method = case.method.method(Some(steps))?;
        let begin = std::time::Instant::now();
        let (wall_seconds, energy_distance_squared) = match measured(case.dim, &method, &run, observer)? {
            Attempt::Finished((outcome, energy)) => (outcome.wall_seconds, Some(energy)),
            Attempt::Failed(..) => (begin.elapsed().as_secs_f64(), None),
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
            Next::Run(steps) => trials.push(one(steps)?),
            Next::End(ending) => break ending,
        }
    };
    if let Some(last) = trials.last().copied()
        && ending == Ending::Reached
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
        assert_eq!(next(&STEPS, &[], 1.0, None), Next::Run(1));
        assert_eq!(next(&STEPS, &[trial(1, 9.0, Some(3.0))], 1.0, None), Next::Run(2));
        let reached = [trial(2, 9.0, Some(1.0))];
        assert_eq!(next(&STEPS, &reached, 1.0, None), Next::End(Ending::Reached));
        let diverged = [trial(8, 9.0, None)];
        assert_eq!(next(&STEPS, &diverged, 1.0, None), Next::End(Ending::OutOfSteps));
        assert_eq!(next(&[], &[], 1.0, None), Next::End(Ending::OutOfSteps));
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
        assert_eq!(next(&STEPS, &trials, 1.0, Some(7.0)), Next::Run(8), "within a fifth");
        assert_eq!(next(&STEPS, &trials, 1.0, Some(6.0)), Next::Run(6));
        assert_eq!(next(&STEPS, &trials, 1.0, Some(4.0)), Next::End(Ending::OutOfTime));
        let slow = [trial(1, 3.0, Some(3.0))];
        assert_eq!(next(&STEPS, &slow, 1.0, Some(2.0)), Next::End(Ending::OutOfTime));
    }
}
