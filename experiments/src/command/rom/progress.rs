//! Bars of trainings and of reduced runs.

use std::ops::ControlFlow;

use indicatif::ProgressBar;
use mpm_rom::experiment::Watch;
use mpm_rom::training::EpochReport;

use crate::progress::{style, unless_interrupted};

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

    /// Whether another phase begins, whose bar looks so.
    fn enters(&mut self, phase: Phase, template: &str) -> bool {
        let begins = self.phase != phase;
        if begins {
            self.phase = phase;
            self.bar.set_style(style(template));
        }
        begins
    }

    /// Takes the bar off the screen.
    pub fn clear(&self) {
        self.bar.finish_and_clear();
    }
}

impl Watch for TrainingProgress {
    fn after_run(&mut self, done: usize, runs: usize) -> ControlFlow<()> {
        self.bar.set_length(runs as u64);
        self.bar.set_position(done as u64);
        unless_interrupted()
    }

    fn after_epoch(&mut self, report: &EpochReport) -> ControlFlow<()> {
        let done = report.epoch + 1;
        if self.enters(Phase::Epochs, "{bar:30} epoch {pos}/{len}, loss {msg}, {eta} left") {
            self.bar.set_length(report.epochs);
            self.bar.set_position(done);
            self.bar.reset_eta();
        }
        self.bar.set_position(done);
        if !self.bar.is_hidden() {
            self.bar.set_message(format!("{:.3e}", report.terms.total()));
        }
        unless_interrupted()
    }

    fn after_trial(&mut self) -> ControlFlow<()> {
        if self.enters(Phase::Trials, "trial run {pos}") {
            self.bar.set_position(0);
        }
        self.bar.inc(1);
        unless_interrupted()
    }
}
