//! The file of an experiment.

use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::files::names;
use super::options::{ChoiceName, MOST_TRIED, ManifoldName};
use super::results::is_column;
use super::variants::Variant;
use super::{ExperimentError, ReducedRuns};
use crate::full_order::FramesBetween;
use crate::online::{Quadrature, Search};
use crate::training::Training;

/// An experiment: a scene, the parameters in which its runs differ, and what is trained and run.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Experiment {
    /// What tables and figures are headed by.
    pub title: String,
    /// The scene's file, seen from the experiment's.
    pub scene: PathBuf,
    /// Points of the scene that training and errors know, at most: so many, evenly drawn. All of them if left out; dynamics always have all.
    #[serde(default)]
    pub recorded_points: Option<usize>,
    /// Frames of the training runs between those of the scene; none if left out.
    #[serde(default)]
    pub frames_between: Option<FramesBetween>,
    /// Networks that are trained for each one that is asked for, with seeds that follow one another; the one whose reduced runs of training cases are best is kept. ≥ 1.
    #[serde(default = "one_start")]
    pub starts: u64,
    /// Names of the parameters.
    pub parameters: Vec<String>,
    /// What the parameters change in the scene.
    pub keys: Vec<Key>,
    /// Their values.
    pub cases: Cases,
    /// How the network is trained.
    #[serde(default)]
    pub training: Training,
    /// Other networks for the same data.
    #[serde(default)]
    pub variants: Vec<Variant>,
    /// The reduced runs.
    #[serde(default)]
    pub run: ReducedRuns,
    /// The experiment's file.
    #[serde(skip)]
    pub(super) file: PathBuf,
    /// The text that the training is described by: that of the file, or of the one that it names with `trained_as`.
    #[serde(skip)]
    pub(super) text: String,
}

/// A number of the scene: offset + factor Π `product`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Key {
    /// Dotted key in the scene's document: `gravity.1`.
    pub key: String,
    /// What is added.
    #[serde(default)]
    pub offset: f64,
    /// What the product is multiplied by.
    #[serde(default = "one")]
    pub factor: f64,
    /// Each a parameter's name, or its cosine or sine in radians: `"speed"`, `"cos angle"`, `"sin angle"`.
    pub product: Vec<String>,
}

fn one() -> f64 {
    1.0
}

fn one_start() -> u64 {
    1
}

/// Values of the parameters, one list per run.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cases {
    /// Of the runs that the network learns from.
    pub train: Vec<Vec<f64>>,
    /// Of the runs that it has not seen.
    pub test: Vec<Vec<f64>>,
}

/// The first place whose entry stands in the list before.
pub(super) fn repeated<T: PartialEq>(list: &[T]) -> Option<usize> {
    (0..list.len()).find(|&place| list[..place].contains(&list[place]))
}

impl Experiment {
    /// The file of the scene that is trained on.
    pub fn scene_file(&self) -> PathBuf {
        self.beside(&self.scene)
    }

    /// The file of the scene that reduced runs are runs of.
    pub fn run_scene_file(&self) -> PathBuf {
        self.beside(self.run.scene.as_ref().unwrap_or(&self.scene))
    }

    /// The file of the scene with more points.
    pub fn super_resolution_file(&self) -> Option<PathBuf> {
        self.run.super_resolution.as_ref().map(|file| self.beside(file))
    }

    fn beside(&self, file: &Path) -> PathBuf {
        self.file.parent().unwrap_or(Path::new("")).join(file)
    }

    /// Refuses what does not fit together.
    pub(super) fn check(&self) -> Result<(), ExperimentError> {
        for (name, cases) in [("cases.train", &self.cases.train), ("cases.test", &self.cases.test)] {
            self.require(!cases.is_empty(), name, "at least one case is needed")?;
            for (number, values) in cases.iter().enumerate() {
                let (field, found, expected) = (format!("{name}.{number}"), values.len(), self.parameters.len());
                let message = format!("the number of values is {found}, that of parameters {expected}");
                self.require(found == expected, &field, &message)?;
                for value in values {
                    self.require(value.is_finite(), &field, &format!("{value} is not finite"))?;
                }
            }
        }
        let run = &self.run;
        let lists = [
            ("run.manifold", run.manifold.len(), repeated(&run.manifold)),
            ("run.samples", run.samples.len(), repeated(&run.samples)),
            ("run.choice", run.choice.len(), repeated(&run.choice)),
            ("run.quadrature", run.quadrature.len(), repeated(&run.quadrature)),
            ("run.update", run.update.len(), repeated(&run.update)),
            ("run.step_factor", run.step_factor.len(), repeated(&run.step_factor)),
            ("cases.test", self.cases.test.len(), repeated(&self.cases.test)),
        ];
        for (field, length, repeated) in lists {
            self.require(length > 0, field, "at least one is needed")?;
            if let Some(place) = repeated {
                let message = "stands in the list before: its runs would count twice";
                return Err(self.field(&format!("{field}.{place}"), message));
            }
        }
        self.require(self.recorded_points != Some(0), "recorded_points", "0: at least 1")?;
        self.require(self.starts > 0, "starts", "0: at least 1")?;
        let exchanged = run.choice.contains(&ChoiceName::Greedy) && run.counts().any(|count| count <= MOST_TRIED);
        let message = format!("only greedily chosen sample points are exchanged, {MOST_TRIED} at most: none here");
        self.require(run.exchanges == 0 || exchanged, "run.exchanges", &message)?;
        if let Some((key, message)) = self.frames_between.and_then(|between| between.fault()) {
            return Err(self.field(&format!("frames_between.{key}"), message));
        }
        let linear = run.manifold.contains(&ManifoldName::Linear);
        for (key, given) in [
            ("run.scene", run.scene.is_some()),
            ("recorded_points", self.recorded_points.is_some()),
        ] {
            let message = format!("\"linear\" needs all points of the training: leave out {key}");
            self.require(!(given && linear), "run.manifold", &message)?;
        }
        let lists = Quadrature::Lagrangian {
            search: Search::Lists { skin: run.skin },
        };
        let in_space = Quadrature::Eulerian {
            per_axis: run.points_per_axis,
        };
        for (key, quadrature) in [("run.skin", lists), ("run.points_per_axis", in_space)] {
            let fits = quadrature.check();
            fits.map_err(|error| self.field(key, error))?;
        }
        for (number, name) in self.parameters.iter().enumerate() {
            let field = format!("parameters.{number}");
            let is_cell = !name.is_empty() && !name.contains(|c: char| c == ',' || c == '"' || c.is_control());
            let message = format!("{name:?}: a name without commas, quotes and line ends is needed");
            self.require(is_cell, &field, &message)?;
            let is_new = !self.parameters[..number].contains(name) && !is_column(name);
            let message = format!(
                "{name:?}: is the name of another parameter or of a column of {}",
                names::RESULTS
            );
            self.require(is_new, &field, &message)?;
        }
        self.trainings()?;
        // The values themselves show whether all keys make sense.
        self.case(&self.cases.train[0])?;
        self.check_keys()
    }

    pub(super) fn require(&self, valid: bool, field: &str, message: &str) -> Result<(), ExperimentError> {
        valid.then_some(()).ok_or_else(|| self.field(field, message))
    }

    pub(super) fn field(&self, field: &str, message: impl ToString) -> ExperimentError {
        ExperimentError::field(&self.file, field, message)
    }
}
