//! `parvi simulate`: a scene of the material point method from its file.

mod figures;

use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use mpm_scenes::{Outcome, Scene, Summary, ValidationRow};

use super::file_kind::FileKind;
use crate::progress::Bar;
use crate::{CommandError, console, interrupt};

/// What to simulate and where.
#[derive(Args)]
pub struct Arguments {
    /// The scene
    #[arg(value_name = "SCENE.toml")]
    scene: PathBuf,
    /// Directory of the files; a part of the same run in it is continued
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

/// Runs the scene, draws its series and says what came out.
pub fn execute(arguments: &Arguments) -> Result<(), CommandError> {
    FileKind::Scene.check(&arguments.scene)?;
    let scene = Scene::read(&arguments.scene)?;
    interrupt::listen();
    let mut progress = Bar::new(&format!("{{bar:30}} {{msg}} of {}, {{eta}} left", scene.time.end));
    let start = Instant::now();
    let result = mpm_scenes::simulate(&scene, &arguments.out, &mut progress);
    let seconds = start.elapsed().as_secs_f64();
    progress.clear();
    // A run that failed has a series too, which may show why; its own error is the one to report.
    let drawn = figures::draw(&arguments.out, &scene.title);
    let summary = result?;
    drawn?;
    warn(&summary.validation);
    console::print_pairs(&pairs(arguments, &summary, seconds))?;
    match summary.outcome {
        Outcome::Finished => Ok(()),
        Outcome::Interrupted => Err(CommandError::Interrupted {
            hint: "; the same line started again goes on".to_owned(),
        }),
    }
}

/// Draws the series of a run again.
pub fn report(directory: &Path) -> Result<(), CommandError> {
    let scene = Scene::read(directory.join(mpm_scenes::output::names::SCENE))?;
    figures::draw(directory, &scene.title)
}

/// The comparisons that failed.
fn warn(validation: &[ValidationRow]) {
    for row in validation.iter().filter(|row| !row.passes()) {
        let (reference, tolerance) = (row.reference, row.tolerance);
        let what = match row.measured {
            measured if measured.is_nan() => format!("the run gives no value, {reference} is expected"),
            measured => format!("{measured} differs from {reference} by more than {tolerance}"),
        };
        console::notice(&format!("{}: {what}", row.quantity));
    }
}

/// What standard output says; a key without a value is left out.
fn pairs(arguments: &Arguments, summary: &Summary, seconds: f64) -> Vec<(&'static str, String)> {
    let work = summary.particles as f64 * summary.steps_here as f64;
    let mut pairs = vec![
        ("scene", arguments.scene.display().to_string()),
        ("steps", summary.steps.to_string()),
        ("time", summary.time.to_string()),
        ("particles", summary.particles.to_string()),
        ("wall_seconds", format!("{seconds:.6}")),
    ];
    if work > 0.0 {
        pairs.push(("nanoseconds_per_particle_step", format!("{:.1}", 1e9 * seconds / work)));
    }
    if let Some(time) = summary.resumed_at {
        pairs.push(("resumed_at", time.to_string()));
    }
    pairs.push(("outcome", summary.outcome.name().to_owned()));
    let passed = summary.validation.iter().all(ValidationRow::passes);
    if !summary.validation.is_empty() {
        pairs.push(("validation", if passed { "passed" } else { "failed" }.to_owned()));
    }
    pairs
}
