//! The runs of a basis at the spacing that suits it best.

use super::BasisComparison;
use crate::study::prelude::*;

/// A basis in one dimension at its best spacing.
pub struct Choice<'a> {
    /// The best spacing in units of the basis's default.
    pub factor: f64,
    /// Numbers of steps with their runs, few steps first.
    pub by_steps: Vec<(usize, Rows<'a>)>,
}

/// The runs of a basis at one spacing, one per number of steps and seed.
pub fn at<'a>(rows: &Rows<'a>, dim: Dimension, basis: Basis, factor: f64) -> Rows<'a> {
    let here = rows.with("dim", dim).with("series", basis.to_string());
    here.with("spacing_factor", factor)
}

impl<'a> Choice<'a> {
    /// The spacing with the lowest median error at the largest number of steps; `None` before any of those runs.
    pub fn of(study: &BasisComparison, rows: &Rows<'a>, dim: Dimension, basis: Basis) -> Option<Self> {
        let counts = study.step_counts();
        let &most = counts.last()?;
        let error = |factor: f64| {
            let here = at(rows, dim, basis, factor).with("requested_steps", most);
            Some((factor, here.median(ENERGY)?))
        };
        let errors = study.spacings.iter().filter_map(|&factor| error(factor));
        let (factor, _) = errors.min_by(|left, right| left.1.total_cmp(&right.1))?;
        let here = at(rows, dim, basis, factor);
        let runs = counts
            .into_iter()
            .map(|steps| (steps, here.with("requested_steps", steps)));
        let by_steps = runs.filter(|(_, runs)| !runs.is_empty()).collect();
        Some(Self { factor, by_steps })
    }

    /// The spacing h used.
    pub fn spacing(&self) -> Option<f64> {
        let mut runs = self.by_steps.iter().flat_map(|(_, runs)| runs.iter());
        runs.find_map(|row| row.number("requested_spacing"))
    }

    /// Whether a better spacing may lie beyond the configured ones.
    pub fn is_at_the_edge(&self, study: &BasisComparison) -> bool {
        let smaller = study.spacings.iter().any(|&factor| factor < self.factor);
        let larger = study.spacings.iter().any(|&factor| factor > self.factor);
        !(smaller && larger)
    }

    /// The median time of the largest number of steps.
    pub fn longest(&self) -> Option<f64> {
        self.by_steps.last()?.1.median(SECONDS)
    }

    /// The largest number of steps whose median time is at most `seconds`, with its median error.
    pub fn within(&self, seconds: f64) -> Option<(usize, f64)> {
        let fits = |runs: &Rows<'_>| runs.median(SECONDS).is_some_and(|time| time <= seconds);
        let (steps, runs) = self.by_steps.iter().rev().find(|(_, runs)| fits(runs))?;
        Some((*steps, runs.median(ENERGY)?))
    }
}
