//! Looks at the particles on their way.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use parvi::{Observer, ParticleView, Progress};
use parvi_files::Particles;

use crate::CommandError;
use crate::progress::Bar;
use crate::study::yardstick::{Errors, Yardstick};

/// Measures the start and every so many steps, and ends a run that is far out.
pub struct Watch<'a> {
    /// Another observer beside it.
    pub inner: &'a mut Bar,
    /// Of the target.
    pub yardstick: &'a dyn Yardstick,
    /// Steps between two looks.
    pub every: usize,
    /// How far out is far.
    pub reach: f64,
    /// What it has seen.
    pub seen: Seen,
}

/// What a watch has seen.
#[derive(Default)]
pub struct Seen {
    /// Errors of the start.
    pub start: Option<Errors>,
    /// Step and errors of the least ED² after it.
    pub best: Option<(usize, Errors)>,
    /// The step in which the run was ended, and what was seen.
    pub ended: Option<(usize, String)>,
    /// Time that looking took.
    pub looking: Duration,
}

impl Seen {
    /// Notes the particles after a step if they are better than any before.
    pub fn note(&mut self, step: usize, errors: Errors) {
        let least = |(_, best): &(usize, Errors)| best.energy_distance_squared <= errors.energy_distance_squared;
        if !self.best.as_ref().is_some_and(least) {
            self.best = Some((step, errors));
        }
    }
}

/// The errors of particles, or what is wrong with such as are far out.
fn within(reach: f64, errors: Result<Errors, CommandError>) -> Result<Errors, String> {
    match errors.map_err(|error| error.to_string())? {
        far if far.mean > reach => Err(format!("a mean is off by {:.3e} sd", far.mean)),
        far if far.deviation > reach => Err(format!("a standard deviation is off by {:.3e} of it", far.deviation)),
        errors => Ok(errors),
    }
}

impl Observer for Watch<'_> {
    fn after_step(&mut self, progress: Progress) -> ControlFlow<()> {
        self.inner.after_step(progress)
    }

    fn see(&mut self, view: &ParticleView<'_>) -> ControlFlow<()> {
        if !view.step.is_multiple_of(self.every) {
            return ControlFlow::Continue(());
        }
        let begin = Instant::now();
        let particles = Particles::from_coordinates(view.dimension(), view.positions(), None);
        let errors = within(self.reach, self.yardstick.measure(&particles));
        self.seen.looking += begin.elapsed();
        match errors {
            Ok(errors) if view.step == 0 => self.seen.start = Some(errors),
            Ok(errors) => self.seen.note(view.step, errors),
            Err(message) => {
                self.seen.ended = Some((view.step, message));
                return ControlFlow::Break(());
            }
        }
        ControlFlow::Continue(())
    }
}
