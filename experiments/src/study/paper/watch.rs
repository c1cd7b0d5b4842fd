//! Looks at the particles on their way.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use parvi::{Observer, ParticleView, Progress};

use crate::CommandError;
use crate::output::Particles;
use crate::study::yardstick::{Errors, Yardstick};

/// Measures the start and every so many steps, and ends a run that is far out.
pub struct Watch<'a> {
    inner: &'a mut dyn Observer,
    yardstick: &'a dyn Yardstick,
    every: usize,
    reach: f64,
    /// Errors of the start.
    pub start: Option<Errors>,
    /// Step and errors of the least ED² after it.
    pub best: Option<(usize, Errors)>,
    /// The step in which the run was ended, and what was seen.
    pub ended: Option<(usize, String)>,
    /// Time that looking took.
    pub looking: Duration,
}

impl<'a> Watch<'a> {
    /// Watches beside another observer.
    pub fn new(inner: &'a mut dyn Observer, yardstick: &'a dyn Yardstick, every: usize, reach: f64) -> Self {
        Self {
            inner,
            yardstick,
            every,
            reach,
            start: None,
            best: None,
            ended: None,
            looking: Duration::ZERO,
        }
    }

    /// Notes the particles after a step if they are better than any before.
    pub fn note(&mut self, step: usize, errors: Errors) {
        let least = |(_, best): &(usize, Errors)| best.energy_distance_squared <= errors.energy_distance_squared;
        if !self.best.as_ref().is_some_and(least) {
            self.best = Some((step, errors));
        }
    }

    /// What is wrong with particles that are far out.
    fn far(&self, errors: &Result<Errors, CommandError>) -> Option<String> {
        match errors {
            Err(error) => Some(error.to_string()),
            Ok(errors) if errors.mean > self.reach => Some(format!("a mean is off by {:.3e} sd", errors.mean)),
            Ok(errors) if errors.deviation > self.reach => {
                Some(format!("a standard deviation is off by {:.3e} of it", errors.deviation))
            }
            Ok(_) => None,
        }
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
        let errors = self.yardstick.measure(&particles);
        self.looking += begin.elapsed();
        if let Some(message) = self.far(&errors) {
            self.ended = Some((view.step, message));
            return ControlFlow::Break(());
        }
        match errors {
            Ok(errors) if view.step == 0 => self.start = Some(errors),
            Ok(errors) => self.note(view.step, errors),
            Err(_) => {}
        }
        ControlFlow::Continue(())
    }
}
