//! The bar of a training.

use std::ops::ControlFlow;

use mpm_rom::experiment::Watch;
use mpm_rom::training::EpochReport;

use crate::progress::{Bar, unless_interrupted};

/// Full-order runs.
const RUNS: &str = "{bar:30} run {pos}/{len}, {eta} left";
/// Epochs, after these.
const EPOCHS: &str = "{bar:30} epoch {pos}/{len}, loss {msg}, {eta} left";
/// Reduced runs on trial.
const TRIALS: &str = "trial run {pos}";

/// The bar of a training: full-order runs, then epochs.
pub struct TrainingProgress {
    bar: Bar,
    /// The layout of the phase at hand.
    phase: &'static str,
    trials: usize,
}

impl TrainingProgress {
    /// A bar that appears with the first run or epoch.
    pub fn new() -> Self {
        let (bar, phase) = (Bar::new(RUNS), RUNS);
        Self { bar, phase, trials: 0 }
    }

    /// So many of so many are done in a phase, which may be another one.
    fn set(&mut self, phase: &'static str, done: usize, count: usize) -> ControlFlow<()> {
        if self.phase != phase {
            self.phase = phase;
            self.bar.restyle(phase);
        }
        self.bar.set(done, count);
        unless_interrupted()
    }

    /// Takes the bar off the screen.
    pub fn clear(&self) {
        self.bar.clear();
    }
}

impl Watch for TrainingProgress {
    fn after_run(&mut self, done: usize, runs: usize) -> ControlFlow<()> {
        self.set(self.phase, done, runs)
    }

    fn after_epoch(&mut self, report: &EpochReport) -> ControlFlow<()> {
        self.trials = 0;
        self.bar.say(|| format!("{:.3e}", report.terms.total()));
        self.set(EPOCHS, report.epoch as usize + 1, report.epochs as usize)
    }

    fn after_trial(&mut self) -> ControlFlow<()> {
        self.trials += 1;
        self.set(TRIALS, self.trials, self.trials)
    }
}
