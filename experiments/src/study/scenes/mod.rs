//! Study `scenes`: families of runs of scenes (meshes, kernels, transfers, shapes), of each of which one number is read and judged, alone or beside another run.
//!
//! A case is a scene with changes of some of its keys. Its run is in `raw/` under the fingerprint of the changed scene, so that families which
//! read different numbers of the same runs share them, and a run that was cut off goes on from its checkpoint.

mod configuration;
mod family;
mod history;
mod report;
mod scene_files;

use std::path::Path;

use mpm_scenes::SimulationError;
use mpm_scenes::reading::FinishedRun;
use mpm_scenes::variation::{Combination, PreparedScene, combinations};

pub use configuration::Scenes;
use family::Family;
use scene_files::SceneFiles;

use super::prelude::*;

/// A combination of the choices of a family.
#[derive(Clone, Debug)]
pub struct Variant {
    /// The family, with what that takes over from others.
    family: Family,
    /// What it changes beside the family's own changes.
    combination: Combination,
}

impl Variant {
    /// The error for a case that cannot be run.
    fn refuse(&self, message: impl Into<String>) -> CommandError {
        let (family, name) = (&self.family.name, &self.combination.name);
        refusal(&format!("families.{family}, case `{name}`"), message)
    }
}

impl Study for Scenes {
    type Work = Variant;

    const KIND: &'static str = "scenes";
    const COLUMNS: &'static str = "case status reason family label x quantity value reference tolerance steps particles scene against wall_seconds";
    const REPORT: Report<Self> = report::report;

    fn open(&mut self, configuration: &Path) -> Result<(), CommandError> {
        let directory = configuration.parent().unwrap_or(Path::new(""));
        self.files = SceneFiles::read(&self.resolved()?, directory)?;
        let cases = self.cases()?;
        let x = |case: &Case<Variant>| Ok(self.files.scene(&case.work)?.x);
        let x: Vec<f64> = cases.iter().map(x).collect::<Result<_, CommandError>>()?;
        for family in self.resolved()? {
            let runs = cases
                .iter()
                .zip(&x)
                .filter(|(case, _)| case.row.is("family", family.name.as_str()));
            let runs: Vec<(&str, f64)> = runs.map(|(case, x)| (case.row.text("label"), *x)).collect();
            family.check_choices(&runs)?;
        }
        Ok(())
    }

    /// The cases, family by family.
    fn cases(&self) -> Result<Vec<Case<Variant>>, CommandError> {
        let mut cases = Vec::new();
        for family in self.resolved()? {
            let combinations = combinations(&family.axes, &family.x);
            for combination in combinations.map_err(|message| family.refuse("axes", message))? {
                let name = format!("{}: {}", family.name, combination.name);
                let label = combination.label.clone();
                let work = Variant {
                    family: family.clone(),
                    combination,
                };
                let case = Case::new(name, work).with("family", family.name.as_str());
                cases.push(case.with("label", label).with("quantity", family.read.name()));
            }
        }
        distinct("families.axes", cases)
    }

    fn check_earlier(&self, rows: &[Row]) -> Result<(), CommandError> {
        for Case { row, work, .. } in self.cases()? {
            let prepared = self.files.scene(&work)?;
            let scenes = [prepared.own.fingerprint.as_str(), prepared.against()];
            let mut earlier = rows.iter().filter(|earlier| earlier.case() == row.case());
            if earlier.any(|row| ["scene", "against"].map(|column| row.text(column)) != scenes) {
                return Err(work.refuse("was run with another scene file; choose another --out"));
            }
        }
        Ok(())
    }

    fn run(&self, case: &Case<Variant>, row: &mut Row, tools: Tools<'_>) -> Result<(), CommandError> {
        let variant = &case.work;
        let prepared = self.files.scene(variant)?;
        row.set("x", prepared.x);
        row.set("scene", prepared.own.fingerprint.as_str());
        row.set("against", prepared.against());
        let (directory, observer) = (tools.directory, tools.observer);
        let (seconds, run) = timed(|| finished(variant, (&prepared.own, ""), directory, observer));
        let run = run?;
        let summary = &run.summary;
        row.set("wall_seconds", (summary.steps_here == summary.steps).then_some(seconds));
        row.set("steps", summary.steps);
        row.set("particles", summary.particles);
        let other = prepared.against.as_ref();
        let other = other.map(|other| finished(variant, (other, "what it is compared with: "), directory, observer));
        let other = other.transpose()?;
        history::check(&variant.family, &run.series)?;
        let measured = variant.family.read.read(&run, other.as_ref());
        let measured = measured.map_err(|error| variant.family.misread(error))?;
        row.set("reference", measured.reference);
        row.set("tolerance", measured.tolerance);
        if !measured.value.is_finite() {
            let reason = format!("the value is {}", measured.value);
            return Err(Failure::new(Status::Diverged, reason).into());
        }
        row.set("value", measured.value);
        Ok(())
    }
}

/// Runs a scene, or what is left of its run. One that ends before its time is a failure, which begins with what the scene is.
fn finished<'a>(
    variant: &Variant,
    (scene, what): (&'a PreparedScene, &str),
    directory: &StudyDirectory,
    observer: &mut Bar,
) -> Result<FinishedRun<'a>, CommandError> {
    match FinishedRun::of(scene, directory.raw(&scene.fingerprint), observer) {
        Ok(run) => run.ok_or(CommandError::Interrupted(String::new())),
        Err(SimulationError::Scene(error)) => Err(variant.refuse(error.without_line())),
        Err(error) if error.is_of_run() => Err(Failure::new(Status::Diverged, format!("{what}{error}")).into()),
        Err(error) => Err(error.into()),
    }
}
