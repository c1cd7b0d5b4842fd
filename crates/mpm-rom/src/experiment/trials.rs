//! The training runs that something is tried on.

use super::spread::spread;

/// Training runs that networks and choices of points are tried on, at most. What is tried may do well in most cases and fail in one.
const RUNS: usize = 8;

/// The numbers of training cases that something is tried on. Those with the largest errors of the best trial come first: what is worse shows there soonest. An experiment has one at least.
pub(super) struct Trials(pub Vec<usize>);

impl Trials {
    pub fn of(cases: &[Vec<f64>]) -> Self {
        Self(spread(cases, RUNS))
    }

    /// Puts the cases with the largest errors first.
    pub fn sort_by_errors(&mut self, mut errors: Vec<(usize, f64)>) {
        errors.sort_by(|a, b| b.1.total_cmp(&a.1));
        self.0 = errors.into_iter().map(|(case, _)| case).collect();
    }
}
