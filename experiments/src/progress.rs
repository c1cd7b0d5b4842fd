//! Progress bars with the time left, on standard error, silent where that is no terminal.

use std::ops::ControlFlow;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};
use parvi::{Observer, Progress};

use crate::interrupt;

/// A bar's layout.
pub(crate) fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar())
}

/// Whether a sampler should go on.
pub(crate) fn unless_interrupted() -> ControlFlow<()> {
    if interrupt::requested() {
        ControlFlow::Break(())
    } else {
        ControlFlow::Continue(())
    }
}

/// The bar of a single run: steps.
pub struct StepProgress {
    bar: ProgressBar,
}

impl StepProgress {
    /// A bar that appears with the first step.
    pub fn new() -> Self {
        let bar = ProgressBar::new(0).with_style(style("{bar:30} step {pos}/{len}, {eta} left"));
        Self { bar }
    }

    /// Takes the bar off the screen.
    pub fn clear(&self) {
        self.bar.finish_and_clear();
    }
}

impl Default for StepProgress {
    fn default() -> Self {
        Self::new()
    }
}

impl Observer for StepProgress {
    fn after_step(&mut self, progress: Progress) -> ControlFlow<()> {
        if progress.step == 1 {
            self.bar.set_length(progress.steps as u64);
        }
        self.bar.set_position(progress.step as u64);
        unless_interrupted()
    }
}

/// Units of the study's bar per unit of cost.
const RESOLUTION: f64 = 1000.0;

/// The bar of a study: cases, weighted by what they are expected to cost.
pub struct StudyProgress {
    bar: ProgressBar,
    done: f64,
}

impl StudyProgress {
    /// A bar for work of the given total cost, a part of which is done.
    pub fn new(total: f64, done: f64) -> Self {
        let bar = ProgressBar::new(units(total)).with_style(style("{bar:30} {percent:>3} %, {eta} left  {msg}"));
        bar.set_position(units(done));
        bar.reset_eta();
        bar.enable_steady_tick(Duration::from_millis(500));
        Self { bar, done }
    }

    /// Begins a case; its observer moves the bar within it.
    pub fn begin(&self, case: &str, cost: f64) -> CaseObserver {
        self.bar.set_message(case.to_owned());
        CaseObserver {
            bar: self.bar.clone(),
            base: self.done,
            cost,
        }
    }

    /// Ends a case.
    pub fn end(&mut self, cost: f64) {
        self.done += cost;
        self.bar.set_position(units(self.done));
    }

    /// Takes the bar off the screen.
    pub fn clear(&self) {
        self.bar.finish_and_clear();
    }
}

fn units(cost: f64) -> u64 {
    (cost * RESOLUTION).clamp(0.0, 1e15) as u64
}

/// Watches the runs of one case and stops them on Ctrl-C.
pub struct CaseObserver {
    bar: ProgressBar,
    base: f64,
    cost: f64,
}

impl CaseObserver {
    /// This share of the case is done. A break if a stop was asked for.
    pub fn advance(&self, share: f64) -> ControlFlow<()> {
        self.bar.set_position(units(self.base + self.cost * share));
        unless_interrupted()
    }
}

impl Observer for CaseObserver {
    fn after_step(&mut self, progress: Progress) -> ControlFlow<()> {
        self.advance(progress.step as f64 / progress.steps.max(1) as f64)
    }
}
