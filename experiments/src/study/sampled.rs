//! The work of most studies: a method on a target, measured or not.

use std::time::Instant;

use parvi::{Method, Run};
use parvi_files::Outcome;
use parvi_options::{MethodSpecification, OptionError, TargetSpecification};

use super::definition::Case;
use super::derived::PER_STEP;
use super::row::RunRow;
use super::yardstick::Yardstick;
use crate::CommandError;
use crate::plots::results::{Row, Rows};
use crate::progress::Bar;
use crate::sampling;

/// A method on a target.
#[derive(Clone, Debug)]
pub struct Sampled {
    /// The target.
    pub target: TargetSpecification,
    /// The method.
    pub method: Method,
    /// Number of particles, seed and start.
    pub run: Run,
}

impl Sampled {
    /// A method with its own options, and this number of steps where one is given and it takes steps.
    ///
    /// # Errors
    /// Options that do not fit.
    pub fn new(
        target: &TargetSpecification,
        method: &MethodSpecification,
        steps: Option<usize>,
        (particles, seed): (usize, u64),
    ) -> Result<Self, OptionError> {
        Ok(Self {
            target: target.clone(),
            method: method.method(steps)?,
            run: method.run(particles, seed),
        })
    }

    /// A case for each seed, with which its name ends.
    ///
    /// # Errors
    /// Options that do not fit, and a target that there is not.
    pub fn of_seeds(
        (target, method): (&TargetSpecification, &MethodSpecification),
        (particles, steps): (usize, Option<usize>),
        (name, seeds): (&str, &[u64]),
    ) -> Result<Vec<Case<Self>>, CommandError> {
        let case = |&seed: &u64| {
            let work = Self::new(target, method, steps, (particles, seed))?;
            work.case(format!("{name}-s{seed}"), method)
        };
        seeds.iter().map(case).collect()
    }

    /// A case of it, whose row says what is run.
    ///
    /// # Errors
    /// A target that there is not.
    pub fn case(self, id: String, method: &MethodSpecification) -> Result<Case<Self>, CommandError> {
        let (target, dim) = (self.target.label(), self.target.dimension()?);
        let (particles, seed) = (self.run.particles, self.run.seed);
        let case = Case::new(id, self).by(method).with("target", target);
        let case = case.with("dim", dim).with("particles", particles);
        Ok(case.with("seed", seed))
    }

    /// Samples.
    ///
    /// # Errors
    /// What target and sampler refuse.
    pub fn sample(&self, observer: &mut Bar) -> Result<Outcome, CommandError> {
        sampling::sample(&self.target, &self.method, &self.run, observer)
    }

    /// Samples once to warm up and then so many times on the clock; notes what comes of it, and the range of the time over the steps. Whether all runs gave particles.
    ///
    /// # Errors
    /// What ends a study.
    pub fn clocked(&self, repeats: usize, row: &mut Row, observer: &mut Bar) -> Result<bool, CommandError> {
        let mut times = Vec::new();
        for _ in 0..=repeats {
            let Some(outcome) = row.note(self.sample(observer))? else {
                return Ok(false);
            };
            let per_step = outcome.wall_seconds / outcome.steps.max(1) as f64;
            times.push(Row::default().with(PER_STEP[1], per_step));
        }
        let timed: Rows<'_> = times.iter().skip(1).collect();
        timed.note_range(PER_STEP[1], row, PER_STEP);
        Ok(true)
    }

    /// Samples, or draws from the importance sample of a target without exact draws.
    ///
    /// # Errors
    /// As for [`sample`](Self::sample).
    pub fn sample_or_draw(&self, yardstick: &dyn Yardstick, observer: &mut Bar) -> Result<Outcome, CommandError> {
        if self.draws_from(yardstick) {
            return Ok(yardstick.independent_draws(self.run.particles, self.run.seed));
        }
        self.sample(observer)
    }

    /// Whether its independent draws come from an importance sample.
    pub fn draws_from(&self, yardstick: &dyn Yardstick) -> bool {
        self.method == Method::Iid && !yardstick.has_exact_draws()
    }

    /// Samples and measures, and notes what comes of it.
    ///
    /// # Errors
    /// What ends a study.
    pub fn run(&self, row: &mut Row, yardstick: &dyn Yardstick, observer: &mut Bar) -> Result<(), CommandError> {
        row.set("energy_level", yardstick.mean_distance() / self.run.particles as f64);
        if let Some(outcome) = row.note(self.sample_or_draw(yardstick, observer))? {
            row.measured(yardstick.measure(&outcome.particles))?;
        }
        Ok(())
    }
}

/// Seconds that some work took, and what it gave.
pub fn timed<T>(work: impl FnOnce() -> T) -> (f64, T) {
    let begin = Instant::now();
    let result = work();
    (begin.elapsed().as_secs_f64(), result)
}
