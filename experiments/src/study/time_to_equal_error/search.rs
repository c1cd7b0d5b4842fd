//! The search for the size – draws of a chain, or steps of particles – at which a rival's error is as small as the method's.

use serde::Serialize;

use crate::statistics::summarize;
use crate::study::prelude::*;

/// One run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trial {
    /// Draws, or the steps of a method that takes steps; 0 for its own number.
    pub size: usize,
    /// Seed.
    pub seed: u64,
    /// Evaluations of the score at one point, those of a warm-up included.
    pub score_evaluations: Option<u64>,
    /// Evaluations of the log density at one point.
    pub density_evaluations: Option<u64>,
    /// Time of the sampler, its warm-up included.
    pub wall_seconds: f64,
    /// Squared energy distance, for independent draws its expectation; `None`: diverged.
    pub energy_distance_squared: Option<f64>,
}

/// The runs of one size, one per seed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Medians {
    /// The size.
    pub size: usize,
    /// Score evaluations, of the runs that did not diverge.
    pub score_evaluations: Option<f64>,
    /// Evaluations of the log density, of the same runs.
    pub density_evaluations: Option<f64>,
    /// Least, median and largest time.
    pub wall_seconds: [f64; 3],
    /// Squared energy distance; infinite if half of the runs or more diverged.
    pub energy_distance_squared: f64,
}

impl Medians {
    /// Of the trials of one size.
    ///
    /// # Errors
    /// [`CommandError::Statistics`] if there is none.
    pub fn of(trials: &[Trial], size: usize) -> Result<Self, CommandError> {
        let here: Vec<&Trial> = trials.iter().filter(|trial| trial.size == size).collect();
        let walls: Vec<f64> = here.iter().map(|trial| trial.wall_seconds).collect();
        let walls = summarize(&walls)?;
        let energies: Vec<f64> = here.iter().filter_map(|trial| trial.energy_distance_squared).collect();
        let diverged = here.len() - energies.len();
        let median = |count: fn(&Trial) -> Option<u64>| {
            let counts: Vec<f64> = here.iter().filter_map(|trial| Some(count(trial)? as f64)).collect();
            summarize(&counts).ok().map(|summary| summary.median)
        };
        Ok(Self {
            size,
            score_evaluations: median(|trial| trial.score_evaluations),
            density_evaluations: median(|trial| trial.density_evaluations),
            wall_seconds: [walls.minimum, walls.median, walls.maximum],
            energy_distance_squared: if 2 * diverged >= here.len() {
                f64::INFINITY
            } else {
                upper_median(energies, diverged)
            },
        })
    }

    /// Notes them as those of the last runs.
    pub fn fill(&self, row: &mut Row) {
        let energy = Some(self.energy_distance_squared).filter(|energy| energy.is_finite());
        row.set("size", Some(self.size).filter(|size| *size > 0));
        row.set("score_evaluations", self.score_evaluations);
        row.set("density_evaluations", self.density_evaluations);
        row.set(ENERGY, energy);
        let columns = ["wall_seconds_least", "wall_seconds", "wall_seconds_most"];
        for (column, seconds) in columns.into_iter().zip(self.wall_seconds) {
            row.set(column, seconds);
        }
    }

    /// The median time.
    pub fn seconds(&self) -> f64 {
        self.wall_seconds[1]
    }
}

/// The median of the values and of so many infinite ones, fewer than these; the larger of the two in the middle.
fn upper_median(mut values: Vec<f64>, infinite: usize) -> f64 {
    values.sort_by(f64::total_cmp);
    let middle = (values.len() + infinite) / 2;
    values.get(middle).copied().unwrap_or(f64::INFINITY)
}

/// Sizes that double.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Doubling {
    /// The first.
    pub first: usize,
    /// None is larger.
    pub last: usize,
}

/// What comes after the runs so far: the next size, or an ending.
pub fn next(sizes: Doubling, latest: &Medians, goal: f64, budget: f64) -> Result<usize, Status> {
    if latest.energy_distance_squared <= goal {
        return Err(Status::Reached);
    }
    if latest.seconds() >= budget {
        return Err(Status::OutOfTime);
    }
    let larger = latest.size.checked_mul(2).filter(|size| *size <= sizes.last);
    larger.ok_or(Status::OutOfSizes)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZES: Doubling = Doubling { first: 10, last: 45 };

    fn trial(size: usize, wall_seconds: f64, energy: Option<f64>) -> Trial {
        Trial {
            size,
            seed: 0,
            score_evaluations: Some(size as u64),
            density_evaluations: Some(0),
            wall_seconds,
            energy_distance_squared: energy,
        }
    }

    #[test]
    fn sizes_double_until_the_error_is_reached() {
        let after = |size, seconds, energy| {
            let latest = Medians::of(&[trial(size, seconds, energy)], size).unwrap();
            next(SIZES, &latest, 1.0, 9.0)
        };
        assert_eq!(after(10, 1.0, Some(1.1)), Ok(20));
        assert_eq!(after(20, 10.0, Some(1.0)), Err(Status::Reached));
        assert_eq!(after(20, 9.0, None), Err(Status::OutOfTime));
        assert_eq!(after(40, 1.0, Some(1.1)), Err(Status::OutOfSizes));
    }

    #[test]
    fn medians_count_diverged_runs_as_infinitely_far() {
        let trials = [
            trial(10, 3.0, Some(0.3)),
            trial(10, 1.0, None),
            trial(10, 2.0, Some(0.1)),
            trial(20, 9.0, Some(0.0)),
        ];
        let medians = Medians::of(&trials, 10).unwrap();
        assert_eq!(medians.wall_seconds, [1.0, 2.0, 3.0]);
        assert_eq!(medians.energy_distance_squared, 0.3);
        assert_eq!(medians.score_evaluations, Some(10.0));
        let half = Medians::of(&trials[..2], 10).unwrap();
        assert_eq!(half.energy_distance_squared, f64::INFINITY);
        assert!(Medians::of(&trials, 30).is_err());
    }
}
