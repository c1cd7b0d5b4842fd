//! Progress bars with the time left, on standard error, silent where that is no terminal.

use std::ops::ControlFlow;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};
use parvi::{Observer, Progress};

use crate::interrupt;

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar())
}

/// Whether a sampler should go on.
fn unless_interrupted() -> ControlFlow<()> {
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

/// The bar of a simulation: time simulated.
pub struct SimulationProgress {
    bar: ProgressBar,
    /// Whether the bar has moved; a run that goes on from a checkpoint does not begin at 0.
    begun: bool,
}

/// Units of its bar from begin to end.
const SIMULATION_UNITS: f64 = 1e6;

impl SimulationProgress {
    /// A bar up to the time `end`.
    pub fn new(end: f64) -> Self {
        let style = style(&format!("{{bar:30}} {{msg}} of {end}, {{eta}} left"));
        let bar = ProgressBar::new(SIMULATION_UNITS as u64).with_style(style);
        Self { bar, begun: false }
    }

    /// Takes the bar off the screen.
    pub fn clear(&self) {
        self.bar.finish_and_clear();
    }
}

impl mpm_scenes::Observer for SimulationProgress {
    fn after_step(&mut self, progress: mpm_scenes::Progress) -> ControlFlow<()> {
        let share = progress.time / progress.end * SIMULATION_UNITS;
        self.bar.set_position(share as u64);
        if !self.begun {
            self.bar.reset_eta();
            self.begun = true;
        }
        if !self.bar.is_hidden() {
            self.bar
                .set_message(format!("step {}, t = {:.4}", progress.step, progress.time));
        }
        unless_interrupted()
    }
}

/// The bar of a training: full-order runs, then epochs.
pub struct TrainingProgress {
    bar: ProgressBar,
    phase: Phase,
}

/// What the bar of a training counts.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Phase {
    Runs,
    Epochs,
    Trials,
}

impl TrainingProgress {
    /// A bar that appears with the first run or epoch.
    pub fn new() -> Self {
        let bar = ProgressBar::new(0).with_style(style("{bar:30} run {pos}/{len}, {eta} left"));
        Self {
            bar,
            phase: Phase::Runs,
        }
    }

    /// After a full-order run. A break if a stop was asked for.
    pub fn run(&mut self, done: usize, runs: usize) -> ControlFlow<()> {
        self.bar.set_length(runs as u64);
        self.bar.set_position(done as u64);
        unless_interrupted()
    }

    /// After an epoch, with its mean loss. A break if a stop was asked for.
    pub fn epoch(&mut self, done: u64, epochs: u64, loss: f64) -> ControlFlow<()> {
        if self.phase != Phase::Epochs {
            self.phase = Phase::Epochs;
            self.bar
                .set_style(style("{bar:30} epoch {pos}/{len}, loss {msg}, {eta} left"));
            self.bar.set_length(epochs);
            self.bar.set_position(done);
            self.bar.reset_eta();
        }
        self.bar.set_position(done);
        if !self.bar.is_hidden() {
            self.bar.set_message(format!("{loss:.3e}"));
        }
        unless_interrupted()
    }

    /// After a run that networks are compared by; how many there will be is not known. A break if a stop was asked for.
    pub fn trial(&mut self) -> ControlFlow<()> {
        if self.phase != Phase::Trials {
            self.phase = Phase::Trials;
            self.bar.set_style(style("trial run {pos}"));
            self.bar.set_position(0);
        }
        self.bar.inc(1);
        unless_interrupted()
    }

    /// Takes the bar off the screen.
    pub fn clear(&self) {
        self.bar.finish_and_clear();
    }
}

impl Default for TrainingProgress {
    fn default() -> Self {
        Self::new()
    }
}

/// The bar of a number of like things.
pub struct CountProgress {
    bar: ProgressBar,
}

impl CountProgress {
    /// A bar for things of this name, which appears with the first one done.
    pub fn new(name: &str) -> Self {
        let style = style(&format!("{{bar:30}} {name} {{pos}}/{{len}}, {{eta}} left"));
        Self {
            bar: ProgressBar::new(0).with_style(style),
        }
    }

    /// So many of so many are done.
    pub fn set(&self, done: usize, count: usize) {
        self.bar.set_length(count as u64);
        self.bar.set_position(done as u64);
    }

    /// Takes the bar off the screen.
    pub fn clear(&self) {
        self.bar.finish_and_clear();
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

impl Observer for CaseObserver {
    fn after_step(&mut self, progress: Progress) -> ControlFlow<()> {
        let share = progress.step as f64 / progress.steps.max(1) as f64;
        self.bar.set_position(units(self.base + self.cost * share));
        unless_interrupted()
    }
}

impl mpm_scenes::Observer for CaseObserver {
    fn after_step(&mut self, progress: mpm_scenes::Progress) -> ControlFlow<()> {
        let share = progress.time / progress.end;
        self.bar.set_position(units(self.base + self.cost * share));
        unless_interrupted()
    }
}
