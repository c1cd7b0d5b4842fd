//! Progress bars with the time left, on standard error, silent where that is no terminal.

use std::ops::ControlFlow;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};
use parvi::{Observer, Progress};

use crate::interrupt;

/// Whether a sampler should go on.
pub(crate) fn unless_interrupted() -> ControlFlow<()> {
    if interrupt::requested() {
        ControlFlow::Break(())
    } else {
        ControlFlow::Continue(())
    }
}

/// A bar that appears with the first thing done, from which on the time left is told.
pub struct Bar {
    bar: ProgressBar,
    begun: bool,
}

impl Bar {
    /// A bar with this layout.
    pub fn new(template: &str) -> Self {
        let bar = ProgressBar::new(0);
        bar.set_style(style(template));
        Self { bar, begun: false }
    }

    /// So many of so many are done.
    pub fn set(&mut self, done: u64, count: u64) {
        self.bar.set_length(count);
        self.bar.set_position(done);
        if !self.begun {
            self.bar.reset_eta();
            self.begun = true;
        }
    }

    /// What it says, where it is seen.
    #[cfg(any(feature = "mechanics", feature = "rom"))]
    pub fn say(&self, message: impl FnOnce() -> String) {
        if !self.bar.is_hidden() {
            self.bar.set_message(message());
        }
    }

    /// Begins anew with another layout.
    #[cfg(feature = "rom")]
    pub fn restyle(&mut self, template: &str) {
        self.bar.set_style(style(template));
        self.begun = false;
    }

    /// Takes the bar off the screen.
    pub fn clear(&self) {
        self.bar.finish_and_clear();
    }
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar())
}

/// The bar of a number of like things, `step` or `run`.
pub struct CountProgress(Bar);

impl CountProgress {
    /// A bar for things of this name.
    pub fn new(name: &str) -> Self {
        Self(Bar::new(&format!("{{bar:30}} {name} {{pos}}/{{len}}, {{eta}} left")))
    }

    /// So many of so many are done.
    pub fn set(&mut self, done: usize, count: usize) {
        self.0.set(done as u64, count as u64);
    }

    /// Takes the bar off the screen.
    pub fn clear(&self) {
        self.0.clear();
    }
}

/// As the bar of a single run: steps.
impl Observer for CountProgress {
    fn after_step(&mut self, progress: Progress) -> ControlFlow<()> {
        self.set(progress.step, progress.steps);
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
