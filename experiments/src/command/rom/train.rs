//! `parvi rom train`.

use std::ops::ControlFlow;
use std::path::Path;

use mpm_rom::experiment::{Experiment, Watch, train};
use mpm_rom::training::EpochReport;

use super::figures;
use crate::machine::MemoryGauge;
use crate::progress::TrainingProgress;
use crate::{CommandError, console};

/// Full-order runs, training, the curve of the loss.
pub fn execute<const D: usize>(experiment: &Experiment, directory: &Path) -> Result<(), CommandError> {
    let memory = MemoryGauge::begin();
    let mut progress = TrainingProgress::new();
    let result = train::<D>(experiment, directory, &mut progress);
    progress.clear();
    let trained = result?;
    figures::losses(directory, &experiment.title, &trained.history)?;
    let mut pairs = vec![
        ("points", trained.points.to_string()),
        ("runs", trained.runs.to_string()),
        ("frames", trained.frames.to_string()),
        ("epochs", trained.epochs.to_string()),
        ("resumed_at", trained.resumed_at.to_string()),
        (
            "reconstruction_error_percent",
            format!("{:.6}", trained.reconstruction_error),
        ),
        ("data_seconds", format!("{:.3}", trained.data_time.as_secs_f64())),
        (
            "training_seconds",
            format!("{:.3}", trained.training_time.as_secs_f64()),
        ),
    ];
    if let Some(bytes) = memory.peak_bytes() {
        pairs.push(("peak_memory_bytes", bytes.to_string()));
    }
    console::print_pairs(&pairs)
}

impl Watch for TrainingProgress {
    fn after_run(&mut self, done: usize, runs: usize) -> ControlFlow<()> {
        self.run(done, runs)
    }

    fn after_epoch(&mut self, report: &EpochReport) -> ControlFlow<()> {
        self.epoch(report.epoch + 1, report.epochs, report.terms.total())
    }
}
