//! The search for the least number – steps of particles, or draws of a chain – with which a contestant is as good as is asked.

use super::prelude::*;

/// What is searched, and when it is given up.
#[derive(Clone, Debug)]
pub struct Search {
    /// Sizes to try, growing.
    pub sizes: Vec<usize>,
    /// How the search ends where none of them does.
    pub beyond: Status,
    /// The squared energy distance that the median of the runs of a size has to reach.
    pub goal: f64,
    /// Seconds; a size whose runs take longer is the last.
    budget: Option<f64>,
    /// A size whose predicted time exceeds the budget by more than this factor is lowered to one that fits.
    tolerance: f64,
}

impl Search {
    /// Without a prediction.
    pub fn of(sizes: Vec<usize>, beyond: Status, goal: f64, budget: Option<f64>) -> Self {
        Self {
            sizes,
            beyond,
            goal,
            budget,
            tolerance: f64::INFINITY,
        }
    }

    /// The same with sizes lowered to what fits into the budget, where their predicted time exceeds it by more than a factor.
    pub fn lowered(self, tolerance: f64) -> Self {
        Self { tolerance, ..self }
    }

    /// What comes after the latest runs, which have this size: the next one, or as much as fits into the budget where that would not; an ending.
    pub fn next(&self, size: usize, latest: &Rows<'_>) -> Result<usize, Status> {
        if median_energy(latest) <= self.goal {
            return Err(Status::Reached);
        }
        let larger = self.sizes.iter().copied().find(|&larger| larger > size);
        let larger = larger.ok_or(self.beyond);
        let (Some(budget), Some(seconds)) = (self.budget, latest.median(SECONDS)) else {
            return larger;
        };
        if seconds >= budget {
            return Err(Status::OutOfTime);
        }
        let (larger, each) = (larger?, seconds / size as f64);
        if each * larger as f64 <= self.tolerance * budget {
            return Ok(larger);
        }
        // Rounded up, so that the run takes the budget rather than a little less.
        let fitting = ((budget / each).ceil() as usize).min(larger);
        Some(fitting).filter(|&fitting| fitting > size).ok_or(Status::OutOfTime)
    }
}

/// What a search came to: how it ended, the size of the last runs, and the largest one that missed the error before it was reached.
pub type Found = (Status, usize, Option<usize>);

/// Sizes that double: `{ from = 1000, to = 128000 }`.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Doubled {
    /// The first.
    from: Bounded<2, 100_000_000>,
    /// None is larger.
    to: Bounded<2, 100_000_000>,
}

impl Doubled {
    /// The sizes.
    pub fn sizes(self) -> Vec<usize> {
        let larger = |size: &usize| size.checked_mul(2).filter(|size| *size <= self.to.get());
        std::iter::successors(Some(self.from.get()), larger).collect()
    }

    /// Refuses a range without sizes; `field` is its place in the configuration.
    ///
    /// # Errors
    /// Such a range.
    pub fn check(self, field: &str) -> Result<(), CommandError> {
        let Self { from, to } = self;
        holds(from <= to, &format!("{field}.to"), || {
            format!("{to} is below `from` = {from}")
        })
    }
}

/// The median of the squared energy distance, the larger of the two in the middle; a run that diverged is infinitely far.
pub fn median_energy(runs: &Rows<'_>) -> f64 {
    let energy = |trial: &Row| trial.number(ENERGY).unwrap_or(f64::INFINITY);
    let mut energies: Vec<f64> = runs.iter().map(energy).collect();
    energies.sort_by(f64::total_cmp);
    energies.get(energies.len() / 2).copied().unwrap_or(f64::INFINITY)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn trial(size: usize, wall_seconds: f64, energy: Option<f64>) -> Row {
        let trial = Row::default().with("size", size).with(SECONDS, wall_seconds);
        trial.with(ENERGY, energy)
    }

    fn search(sizes: &[usize], budget: Option<f64>, tolerance: f64) -> Search {
        Search::of(sizes.to_vec(), Status::OutOfSizes, 1.0, budget).lowered(tolerance)
    }

    fn after(search: &Search, size: usize, seconds: f64, energy: Option<f64>) -> Result<usize, Status> {
        let latest = [trial(size, seconds, energy)];
        search.next(size, &latest.iter().collect())
    }

    #[test]
    fn sizes_grow_until_the_error_is_reached() {
        let patient = search(&[1, 2, 4, 8], None, 1.2);
        assert_eq!(after(&patient, 1, 9.0, Some(3.0)), Ok(2));
        assert_eq!(after(&patient, 2, 9.0, Some(1.0)), Err(Status::Reached));
        assert_eq!(after(&patient, 8, 9.0, None), Err(Status::OutOfSizes));
        let [from, to] = [10, 45].map(|size| Bounded::new(size).unwrap());
        let doubled = search(&Doubled { from, to }.sizes(), Some(9.0), f64::INFINITY);
        assert_eq!(after(&doubled, 10, 1.0, Some(1.1)), Ok(20));
        assert_eq!(after(&doubled, 20, 10.0, Some(1.0)), Err(Status::Reached));
        assert_eq!(after(&doubled, 20, 9.0, None), Err(Status::OutOfTime));
        assert_eq!(after(&doubled, 40, 1.0, Some(1.1)), Err(Status::OutOfSizes));
    }

    #[test]
    fn a_run_too_long_for_the_budget_is_shortened_to_it() {
        let within = |budget: f64| search(&[1, 2, 4, 8], Some(budget), 1.2);
        assert_eq!(after(&within(7.0), 4, 4.0, Some(3.0)), Ok(8), "within a fifth");
        assert_eq!(after(&within(6.0), 4, 4.0, Some(3.0)), Ok(6));
        assert_eq!(after(&within(4.0), 4, 4.0, Some(3.0)), Err(Status::OutOfTime));
        assert_eq!(after(&within(2.0), 1, 3.0, Some(3.0)), Err(Status::OutOfTime));
    }
}
