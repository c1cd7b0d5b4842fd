//! `parvi rom train`.

use std::path::Path;
use std::time::Duration;

use mpm_rom::experiment::{Experiment, Trained, train_experiment};

use super::figures;
use super::progress::TrainingProgress;
use crate::CommandError;
use crate::console::{self, Pair};
use crate::machine::{MemoryGauge, PEAK_MEMORY_KEY};
use crate::plots::results::Value;

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
fn pairs(trained: &Trained, memory: &MemoryGauge) -> Vec<Pair> {
    let seconds = |time: Duration| format!("{:.3}", time.as_secs_f64()).into();
    let error = |value: f64| Value::from(format!("{value:.6}"));
    let starts = Some(trained.starts.len()).filter(|&count| count > 0);
    let best = trained.starts.iter().map(|start| start.position_error);
    let best = best.min_by(f64::total_cmp).map(error);
    vec![
        ("variant", trained.name.as_str().into()),
        ("points", trained.points.into()),
        ("runs", trained.runs.into()),
        ("frames", trained.frames.into()),
        ("epochs", trained.epochs.into()),
        ("resumed_at", trained.resumed_at.into()),
        ("reconstruction_error_percent", error(trained.reconstruction_error)),
        ("gradient_error", error(trained.gradient_error)),
        ("data_seconds", seconds(trained.data_time)),
        ("training_seconds", seconds(trained.training_time)),
        ("starts", starts.into()),
        ("training_runs_error_percent", best.into()),
        (PEAK_MEMORY_KEY, memory.peak_bytes().into()),
    ]
}
