//! The runs of a basis at the spacing that suits it best.

use super::BasisComparison;
use crate::options::{Basis, Dimension};
use crate::study::run_row::{ENERGY, RunRow, SECONDS, median};

/// A basis in one dimension at its best spacing.
pub struct Choice<'a> {
    /// The best spacing in units of the basis's default.
    pub factor: f64,
    /// Numbers of steps with their runs, few steps first.
    pub by_steps: Vec<(usize, Vec<&'a RunRow>)>,
}

/// The runs of one setting, one per seed.
pub fn runs(rows: &[RunRow], dim: Dimension, basis: Basis, factor: f64, steps: usize) -> Vec<&RunRow> {
    let name = basis.to_string();
    let here = |row: &&RunRow| {
        row.dim == dim.get()
            && row.series == name
            && row.spacing_factor == Some(factor)
            && row.requested_steps == Some(steps)
    };
    rows.iter().filter(here).collect()
}

impl<'a> Choice<'a> {
    /// The spacing with the lowest median error at the largest number of steps; `None` before any of those runs.
    pub fn of(study: &BasisComparison, rows: &'a [RunRow], dim: Dimension, basis: Basis) -> Option<Self> {
        let counts = study.step_counts();
        let &most = counts.last()?;
        let error = |factor: f64| Some((factor, median(&runs(rows, dim, basis, factor, most), ENERGY)?));
        let (factor, _) = study
            .spacings
            .iter()
            .filter_map(|&factor| error(factor))
            .min_by(|left, right| left.1.total_cmp(&right.1))?;
        let by_steps = counts
            .into_iter()
            .map(|steps| (steps, runs(rows, dim, basis, factor, steps)))
            .filter(|(_, runs)| !runs.is_empty())
            .collect();
        Some(Self { factor, by_steps })
    }

    /// The spacing h used.
    pub fn spacing(&self) -> Option<f64> {
        let mut runs = self.by_steps.iter().flat_map(|(_, runs)| runs);
        runs.find_map(|row| row.requested_spacing)
    }

    /// Whether a better spacing may lie beyond the configured ones.
    pub fn is_at_the_edge(&self, study: &BasisComparison) -> bool {
        let smaller = study.spacings.iter().any(|&factor| factor < self.factor);
        let larger = study.spacings.iter().any(|&factor| factor > self.factor);
        !(smaller && larger)
    }

    /// The median time of the largest number of steps.
    pub fn longest(&self) -> Option<f64> {
        median(&self.by_steps.last()?.1, SECONDS)
    }

    /// The largest number of steps whose median time is at most `seconds`, with its median error.
    pub fn within(&self, seconds: f64) -> Option<(usize, f64)> {
        let fits = |runs: &[&RunRow]| median(runs, SECONDS).is_some_and(|time| time <= seconds);
        let (steps, runs) = self.by_steps.iter().rev().find(|(_, runs)| fits(runs))?;
        Some((*steps, median(runs, ENERGY)?))
    }
}
