//! How the factor of the score varies over a run.

use std::fmt::{self, Display, Formatter};

use serde::Deserialize;

use crate::SampleError;
use crate::start::check;

/// Factor α(t) before the external force (MPM-ParVI paper, Eq. 3, and limitation 2 for one that varies in time); t = 1…T are the steps.
///
/// The calibrated sampler needs α > 0. The paper's algorithms take either sign. In files `{ shape = "geometric", from = 0.1, to = 1.0 }`.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(tag = "shape", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Annealing {
    /// The same in every step.
    Constant {
        /// α.
        alpha: f64,
    },
    /// Geometric from the first value in the first step to the second in the last: a^{1−s} b^s, s = (t − 1)/(T − 1). Both have one sign.
    Geometric {
        /// α in the first step.
        from: f64,
        /// α in the last step.
        to: f64,
    },
    /// Linear from the first value in the first step to the second in the last: a + (b − a) s.
    Linear {
        /// α in the first step.
        from: f64,
        /// α in the last step.
        to: f64,
    },
    /// C times linear from the first value to the second, each time over T/C steps; α = b in the last step
    /// (D'Angelo & Fortuin, *Annealed Stein variational gradient descent*, 2021, for the idea).
    Cyclic {
        /// α where a cycle begins.
        from: f64,
        /// α where a cycle ends.
        to: f64,
        /// C ≥ 1.
        cycles: usize,
    },
}

impl Annealing {
    /// The two ends between which α stays.
    fn ends(self) -> [f64; 2] {
        match self {
            Self::Constant { alpha } => [alpha, alpha],
            Self::Geometric { from, to } | Self::Linear { from, to } | Self::Cyclic { from, to, .. } => [from, to],
        }
    }

    /// The same schedule, if every α is positive and finite.
    pub(crate) fn checked(self) -> Result<Self, SampleError> {
        for alpha in self.ends() {
            check("alpha", alpha, alpha > 0.0 && alpha.is_finite(), "positive and finite")?;
        }
        self.of_either_sign()
    }

    /// The same schedule, if every α is finite and the schedule has a meaning.
    ///
    /// # Errors
    /// [`SampleError::InvalidOption`] for the value that is out of its range.
    pub fn of_either_sign(self) -> Result<Self, SampleError> {
        let [from, to] = self.ends();
        check("alpha", from, from.is_finite(), "finite")?;
        check("alpha", to, to.is_finite(), "finite")?;
        if let Self::Geometric { .. } = self {
            let expected = "of the same sign at both ends and not 0, for a geometric schedule";
            check("alpha", to, from * to.signum() > 0.0 && to != 0.0, expected)?;
        }
        if let Self::Cyclic { cycles, .. } = self {
            check("cycles of alpha", cycles as f64, cycles >= 1, "at least 1")?;
        }
        Ok(self)
    }

    /// α of the last step.
    pub fn last(self) -> f64 {
        self.ends()[1]
    }

    /// α in step `step` of `steps`, counted from 1.
    pub fn at(self, step: usize, steps: usize) -> f64 {
        let progress = (step.max(1) - 1) as f64 / steps.saturating_sub(1).max(1) as f64;
        match self {
            Self::Constant { alpha } => alpha,
            Self::Geometric { from, to } => from.signum() * (from.abs().powf(1.0 - progress) * to.abs().powf(progress)),
            Self::Linear { from, to } => from + (to - from) * progress,
            Self::Cyclic { from, to, cycles } => {
                // More cycles than steps are as many: all steps end one.
                let place = (step.max(1) - 1) * cycles.min(steps) % steps.max(1);
                let last = steps.saturating_sub(cycles);
                let share = if place < last { place as f64 / last as f64 } else { 1.0 };
                from + (to - from) * share
            }
        }
    }
}

/// `0.5`, `geometric 0.1…1`, `4 × linear 0.1…1`.
impl Display for Annealing {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Constant { alpha } => write!(formatter, "{alpha}"),
            Self::Geometric { from, to } => write!(formatter, "geometric {from}…{to}"),
            Self::Linear { from, to } => write!(formatter, "linear {from}…{to}"),
            Self::Cyclic { from, to, cycles } => write!(formatter, "{cycles} × linear {from}…{to}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_schedule_begins_and_ends_where_it_says() {
        let (from, to) = (0.5, 2.0);
        let schedules = [
            Annealing::Geometric { from, to },
            Annealing::Linear { from, to },
            Annealing::Cyclic { from, to, cycles: 3 },
        ];
        for schedule in schedules {
            for steps in [7, 12, 100] {
                assert_eq!(schedule.at(1, steps), from, "{schedule:?}");
                assert!((schedule.at(steps, steps) - to).abs() < 1e-15, "{schedule:?}, {steps}");
                assert!((1..=steps).all(|t| (from..=to).contains(&schedule.at(t, steps))));
            }
            assert_eq!(schedule.last(), to);
        }
        assert_eq!(Annealing::Geometric { from: 1.0, to: 4.0 }.at(2, 3), 2.0);
        assert_eq!(Annealing::Linear { from: 1.0, to: 4.0 }.at(2, 3), 2.5);
    }

    #[test]
    fn a_cycle_begins_anew() {
        let schedule = Annealing::Cyclic {
            from: 0.0,
            to: 3.0,
            cycles: 2,
        };
        let alphas: Vec<f64> = (1..=8).map(|step| schedule.at(step, 8)).collect();
        assert_eq!(alphas, [0.0, 1.0, 2.0, 3.0, 0.0, 1.0, 2.0, 3.0]);
    }

    #[test]
    fn cycles_may_be_any_number() {
        for cycles in [8, 9, 1000, usize::MAX] {
            let (from, to) = (0.5, 3.0);
            let schedule = Annealing::Cyclic { from, to, cycles };
            assert!((1..=8).all(|step| schedule.at(step, 8) == to), "{cycles}");
        }
    }

    #[test]
    fn a_negative_factor_is_for_the_paper_alone() {
        let repelling = Annealing::Geometric { from: -1.0, to: -4.0 };
        assert!(repelling.checked().is_err());
        assert_eq!(repelling.of_either_sign().expect("one sign").at(2, 3), -2.0);
        for wrong in [
            Annealing::Geometric { from: -1.0, to: 4.0 },
            Annealing::Geometric { from: 1.0, to: 0.0 },
            Annealing::Linear {
                from: f64::NAN,
                to: 1.0,
            },
            Annealing::Constant { alpha: f64::INFINITY },
            Annealing::Cyclic {
                from: 1.0,
                to: 2.0,
                cycles: 0,
            },
        ] {
            assert!(wrong.of_either_sign().is_err(), "{wrong:?}");
        }
    }
}
