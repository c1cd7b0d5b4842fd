//! `parvi rom train`.

use std::path::Path;
use std::time::Duration;

use mpm_rom::experiment::{Experiment, Trained, train_experiment};

use super::figures;
use super::progress::TrainingProgress;
use crate::machine::MemoryGauge;
use crate::{CommandError, console};

/// Full-order runs, training of all networks, the curves of their losses.
pub fn execute(experiment: &Experiment, directory: &Path) -> Result<(), CommandError> {
    let memory = MemoryGauge::begin();
    let mut progress = TrainingProgress::new();
    let result = train_experiment(experiment, directory, &mut progress);
    progress.clear();
    for trained in result? {
        let (place, title) = match trained.name.as_str() {
            "" => (directory.to_owned(), experiment.title.clone()),
            name => (directory.join(name), format!("{}, {name}", experiment.title)),
        };
        figures::losses(&place, &title, &trained.history)?;
        console::print_pairs(&pairs(&trained, &memory))?;
    }
    Ok(())
}

/// What standard output says of a network.
fn pairs(trained: &Trained, memory: &MemoryGauge) -> Vec<(&'static str, String)> {
    let seconds = |time: Duration| format!("{:.3}", time.as_secs_f64());
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
        ("gradient_error", format!("{:.6}", trained.gradient_error)),
        ("data_seconds", seconds(trained.data_time)),
        ("training_seconds", seconds(trained.training_time)),
    ];
    if !trained.name.is_empty() {
        pairs.insert(0, ("variant", trained.name.clone()));
    }
    if let Some(best) = trained
        .starts
        .iter()
        .min_by(|a, b| a.position_error.total_cmp(&b.position_error))
    {
        pairs.push(("starts", trained.starts.len().to_string()));
        pairs.push(("training_runs_error_percent", format!("{:.6}", best.position_error)));
    }
    if let Some(bytes) = memory.peak_bytes() {
        pairs.push(("peak_memory_bytes", bytes.to_string()));
    }
    pairs
}
