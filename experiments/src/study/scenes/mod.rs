//! Study `scenes`: families of runs of scenes (meshes, kernels, transfers, shapes), of each of which one number is read and judged.
//!
//! A case is a scene with changes of some of its keys. Its run is in `raw/` under the fingerprint of the changed scene, so that families which
//! read different numbers of the same runs share them, and a run that was cut off goes on from its checkpoint.

mod axis;
mod case;
mod configuration;
mod figure;
mod judgement;
mod overrides;
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
use super::definition::{self, Report, Study};
use super::directory::StudyDirectory;
use super::results::single_line;
use crate::CommandError;
use crate::progress::CaseObserver;
use scene_files::{CaseScene, SceneFiles, refusal_text};

impl Study for Scenes {
    type Case = Case;
    type Row = Row;
    type Shared = ();

    const KIND: &'static str = "scenes";

    fn seeds(&self) -> Vec<u64> {
        Vec::new()
    }

    fn threads(&self) -> Option<usize> {
        self.threads.map(crate::options::Bounded::get)
    }

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
            let now = self.files.scene(&case)?.fingerprint;
            if rows.iter().any(|row| row.case == id && row.scene != now) {
                return Err(case.refuse("was run with another scene file; choose another --out"));
            }
        }
        Ok(())
    }

    fn run(
        &self,
        case: &Case,
        (): &mut (),
        directory: &StudyDirectory,
        observer: &mut CaseObserver,
    ) -> Result<Row, CommandError> {
        let prepared = self.files.scene(case)?;
        let path = directory.raw(&prepared.fingerprint);
        let mut row = unmeasured(case, &prepared);
        let start = Instant::now();
        let summary = match mpm_scenes::simulate(&prepared.scene, &path, observer) {
            Ok(summary) => summary,
            Err(SimulationError::Scene(error)) => return Err(case.refuse(refusal_text(error))),
            Err(error @ (SimulationError::File { .. } | SimulationError::Checkpoint { .. })) => {
                return Err(error.into());
            }
            Err(error) => {
                (row.status, row.reason) = (Status::Diverged, single_line(error));
                return Ok(row);
            }
        };
        if summary.outcome == Outcome::Interrupted {
            return Err(CommandError::Interrupted { hint: String::new() });
        }
        row.wall_seconds = (summary.steps_here == summary.steps).then(|| start.elapsed().as_secs_f64());
        (row.steps, row.particles) = (Some(summary.steps), Some(summary.particles));
        let series = read_series(&path)?;
        let measured = case.family.read.read(&prepared.table, &summary.validation, &series);
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

/// The row of a case before its run.
fn unmeasured(case: &Case, prepared: &CaseScene) -> Row {
    Row {
        case: definition::Case::id(case),
        status: Status::Finished,
        reason: String::new(),
        family: case.family.name.clone(),
        label: case.combination.label.clone(),
        x: prepared.x,
        quantity: case.family.read.name().to_owned(),
        value: None,
        reference: None,
        tolerance: None,
        steps: None,
        particles: None,
        scene: prepared.fingerprint.clone(),
        wall_seconds: None,
    }
}
