//! Study `scenes`: families of runs of scenes (meshes, kernels, transfers, shapes), of each of which one number is read and judged, alone or beside another run.
//!
//! A case is a scene with changes of some of its keys. Its run is in `raw/` under the fingerprint of the changed scene, so that families which
//! read different numbers of the same runs share them, and a run that was cut off goes on from its checkpoint.

mod axis;
mod case;
mod configuration;
mod family;
mod figure;
mod history;
mod judgement;
mod reading;
mod report;
mod row;
mod scene_files;
mod series;

use std::path::Path;
use std::time::Instant;

use mpm_scenes::output::read_series;
use mpm_scenes::{Outcome, SimulationError};

pub use case::Case;
pub use configuration::Scenes;
pub use row::Row;

use super::attempt::Status;
use super::definition::{self, Report, Study, Work};
use super::directory::StudyDirectory;
use super::results::single_line;
use crate::CommandError;
use crate::progress::CaseObserver;
use reading::FinishedRun;
use scene_files::{CaseScene, PreparedScene, SceneFiles, refusal_text};

impl Study for Scenes {
    type Case = Case;
    type Row = Row;
    type Shared = ();

    const KIND: &'static str = "scenes";

    fn open(&mut self, configuration: &Path) -> Result<(), CommandError> {
        let directory = configuration.parent().unwrap_or(Path::new(""));
        self.files = SceneFiles::read(&self.resolved()?, directory)?;
        for case in self.all_cases()? {
            self.files.scene(&case)?;
        }
        Ok(())
    }

    fn cases(&self) -> Result<Vec<Case>, CommandError> {
        self.all_cases()
    }

    fn check_earlier(&self, rows: &[Row]) -> Result<(), CommandError> {
        for case in self.all_cases()? {
            let id = definition::Case::id(&case);
            let prepared = self.files.scene(&case)?;
            let against = prepared.against.map_or(String::new(), |other| other.fingerprint);
            let other = |row: &Row| row.scene != prepared.own.fingerprint || row.against != against;
            if rows.iter().any(|row| row.case == id && other(row)) {
                return Err(case.refuse("was run with another scene file; choose another --out"));
            }
        }
        Ok(())
    }

    fn run(&self, case: &Case, work: Work<'_, ()>) -> Result<Row, CommandError> {
        let prepared = self.files.scene(case)?;
        let mut row = unmeasured(case, &prepared);
        let start = Instant::now();
        let run = match finished(case, &prepared.own, work.directory, work.observer)? {
            Ok(run) => run,
            Err(reason) => {
                (row.status, row.reason) = (Status::Diverged, reason);
                return Ok(row);
            }
        };
        let summary = &run.summary;
        row.wall_seconds = (summary.steps_here == summary.steps).then(|| start.elapsed().as_secs_f64());
        (row.steps, row.particles) = (Some(summary.steps), Some(summary.particles));
        let other = match &prepared.against {
            None => None,
            Some(other) => match finished(case, other, work.directory, work.observer)? {
                Ok(run) => Some(run),
                Err(reason) => {
                    (row.status, row.reason) = (Status::Diverged, format!("what it is compared with: {reason}"));
                    return Ok(row);
                }
            },
        };
        let measured = case.family.read.read(&run, other.as_ref())?;
        let measured = measured.map_err(|(field, message)| case.family.refuse(field, message))?;
        (row.reference, row.tolerance) = (measured.reference, measured.tolerance);
        if measured.value.is_finite() {
            row.value = Some(measured.value);
        } else {
            (row.status, row.reason) = (Status::Diverged, format!("the value is {}", measured.value));
        }
        Ok(row)
    }

    fn report(&self, rows: &[Row], directory: &StudyDirectory) -> Result<Report, CommandError> {
        report::report(self, rows, directory)
    }
}

/// Runs a scene, or what is left of its run; why it ended before its time, if it did.
fn finished<'a>(
    case: &Case,
    prepared: &'a PreparedScene,
    directory: &StudyDirectory,
    observer: &mut CaseObserver,
) -> Result<Result<FinishedRun<'a>, String>, CommandError> {
    let path = directory.raw(&prepared.fingerprint);
    let summary = match mpm_scenes::simulate(&prepared.scene, &path, observer) {
        Ok(summary) => summary,
        Err(SimulationError::Scene(error)) => return Err(case.refuse(refusal_text(error))),
        Err(error @ (SimulationError::File { .. } | SimulationError::Checkpoint { .. })) => return Err(error.into()),
        Err(error) => return Ok(Err(single_line(error))),
    };
    if summary.outcome == Outcome::Interrupted {
        return Err(CommandError::Interrupted { hint: String::new() });
    }
    Ok(Ok(FinishedRun {
        series: read_series(&path)?,
        directory: path,
        prepared,
        summary,
    }))
}

/// The row of a case before its run.
fn unmeasured(case: &Case, prepared: &CaseScene) -> Row {
    Row {
        case: definition::Case::id(case),
        family: case.family.name.clone(),
        label: case.combination.label.clone(),
        x: prepared.x,
        quantity: case.family.read.name().to_owned(),
        scene: prepared.own.fingerprint.clone(),
        against: prepared
            .against
            .as_ref()
            .map_or(String::new(), |other| other.fingerprint.clone()),
        ..Row::default()
    }
}
