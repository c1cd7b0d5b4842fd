//! The search for the size – draws of a chain, or steps of particles – at which a rival's error is as small as the method's.

use crate::study::prelude::*;

/// What is kept of a run: draws, or the steps of a method that takes steps, 0 for its own number; its seed; evaluations and time, those of a
/// warm-up included; the squared energy distance, for independent draws its expectation, where it did not diverge.
pub const COLUMNS: &str = "size seed score_evaluations density_evaluations wall_seconds energy_distance_squared";

/// The runs of one size, one per seed.
pub fn of_size(trials: &[Row], size: usize) -> Rows<'_> {
    trials.iter().collect::<Rows<'_>>().with("size", size)
}

/// The median of the squared energy distance, the larger of the two in the middle; a run that diverged is infinitely far.
pub fn median_energy(runs: &Rows<'_>) -> f64 {
    let energy = |trial: &Row| trial.number(ENERGY).unwrap_or(f64::INFINITY);
    let mut energies: Vec<f64> = runs.iter().map(energy).collect();
    energies.sort_by(f64::total_cmp);
    energies.get(energies.len() / 2).copied().unwrap_or(f64::INFINITY)
}

/// Sizes that double: `{ from = 1000, to = 128000 }`.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Range {
    /// The first.
    pub from: Bounded<2, 100_000_000>,
    /// None is larger.
    pub to: Bounded<2, 100_000_000>,
}

impl Range {
    /// Refuses a range without sizes; `field` is its place in the configuration.
    pub fn check(self, field: &str) -> Result<(), CommandError> {
        let Self { from, to } = self;
        holds(from <= to, &format!("{field}.to"), || {
            format!("{to} is below `from` = {from}")
        })
    }
}

/// What comes after the latest runs, which have this size: the next one, or an ending.
pub fn next(sizes: Range, size: usize, latest: &Rows<'_>, goal: f64, budget: f64) -> Result<usize, Status> {
    if median_energy(latest) <= goal {
        return Err(Status::Reached);
    }
    if latest.median(SECONDS).is_some_and(|seconds| seconds >= budget) {
        return Err(Status::OutOfTime);
    }
    let larger = size.checked_mul(2).filter(|size| *size <= sizes.to.get());
    larger.ok_or(Status::OutOfSizes)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn trial(size: usize, wall_seconds: f64, energy: Option<f64>) -> Row {
        let trial = Row::default().with("size", size).with(SECONDS, wall_seconds);
        trial.with(ENERGY, energy)
    }

    #[test]
    fn sizes_double_until_the_error_is_reached() {
        let [from, to] = [10, 45].map(|size| Bounded::new(size).unwrap());
        let after = |size, seconds, energy| {
            let latest = [trial(size, seconds, energy)];
            next(Range { from, to }, size, &of_size(&latest, size), 1.0, 9.0)
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
        assert_eq!(median_energy(&of_size(&trials, 10)), 0.3);
        assert_eq!(median_energy(&of_size(&trials[..2], 10)), f64::INFINITY);
        assert_eq!(median_energy(&of_size(&trials, 30)), f64::INFINITY);
    }
}
