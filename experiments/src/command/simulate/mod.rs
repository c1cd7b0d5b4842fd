//! `parvi simulate`: a scene of the material point method from its file.

mod figures;

use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use mpm_scenes::{Outcome, Scene, Summary, ValidationRow};

use super::file_kind::FileKind;
use crate::console::{self, Pair};
use crate::progress::Bar;
use crate::{CommandError, interrupt};

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
    for caution in scene.cautions() {
        console::notice(&caution);
    }
    interrupt::listen_once_begun();
    let mut progress = Bar::new(&format!("{{bar:30}} {{msg}} of {}, {{eta}} left", scene.time.end));
    let start = Instant::now();
    let result = mpm_scenes::simulate(&scene, &arguments.out, &mut progress);
    let seconds = start.elapsed().as_secs_f64();
    progress.clear();
    // A run that failed has a series too, which may show why; its own error is the one to report, also where it has none.
    let drawn = figures::draw(&arguments.out, &scene.title);
    let summary = result?;
    drawn?;
    warn(&summary.validation);
    console::print_pairs(&pairs(arguments, &summary, seconds))?;
    match summary.outcome {
        Outcome::Finished => Ok(()),
        Outcome::Interrupted => Err(CommandError::Interrupted(
            "; the same line started again goes on".to_owned(),
        )),
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

/// What standard output says.
fn pairs(arguments: &Arguments, summary: &Summary, seconds: f64) -> Vec<Pair> {
    let work = summary.particles as f64 * summary.steps_here as f64;
    let nanoseconds = (work > 0.0).then(|| format!("{:.1}", 1e9 * seconds / work));
    let passed = summary.validation.iter().all(ValidationRow::passes);
    let word = if passed { "passed" } else { "failed" };
    vec![
        ("scene", arguments.scene.display().to_string().into()),
        ("steps", summary.steps.into()),
        ("time", summary.time.into()),
        ("particles", summary.particles.into()),
        ("wall_seconds", format!("{seconds:.6}").into()),
        ("nanoseconds_per_particle_step", nanoseconds.into()),
        ("resumed_at", summary.resumed_at.into()),
        ("outcome", summary.outcome.name().into()),
        ("validation", (!summary.validation.is_empty()).then_some(word).into()),
    ]
}
