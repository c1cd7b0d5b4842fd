//! The runs of a basis at the spacing that suits it best.

use super::BasisComparison;
use crate::study::prelude::*;

/// A basis in one dimension at its best spacing.
pub struct Choice<'a> {
    /// The best spacing in units of the basis's default.
    pub factor: f64,
    /// The runs at that spacing.
    pub runs: Rows<'a>,
}

impl<'a> Choice<'a> {
    /// The spacing with the lowest median error at the largest number of steps, of runs in one dimension; `None` before any of those.
    pub fn of(study: &BasisComparison, here: &Rows<'a>, basis: Basis) -> Option<Self> {
        let &most = study.step_counts().last()?;
        let here = here.with("series", basis.to_string());
        let error = |runs: &Rows<'_>| runs.with("requested_steps", most).median(ENERGY);
        let (factor, runs) = here.best("spacing_factor", study.spacings.iter().copied(), error)?;
        Some(Self { factor, runs })
    }

    /// The runs with so many steps.
    pub fn with_steps(&self, steps: usize) -> Rows<'a> {
        self.runs.with("requested_steps", steps)
    }

    /// Whether a better spacing may lie beyond the configured ones.
    pub fn is_at_the_edge(&self, study: &BasisComparison) -> bool {
        let smaller = study.spacings.iter().any(|&factor| factor < self.factor);
        let larger = study.spacings.iter().any(|&factor| factor > self.factor);
        !(smaller && larger)
    }

    /// The largest number of steps whose median time is at most `seconds`, with its median error × 10³.
    pub fn within(&self, study: &BasisComparison, seconds: f64) -> Option<(usize, f64)> {
        let fits = |steps: &usize| {
            let time = self.with_steps(*steps).median(SECONDS);
            time.is_some_and(|time| time <= seconds)
        };
        let steps = study.step_counts().into_iter().rev().find(fits)?;
        Some((steps, self.with_steps(steps).median("energy_thousandths")?))
    }
}
