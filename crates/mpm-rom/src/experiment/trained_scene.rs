//! The scene that a directory's data are runs of, whose file may change afterwards.

use std::path::Path;

use super::files::names;
use super::reduced::check_step_factor;
use super::{Experiment, ExperimentError};
use crate::online::check_supported;

impl Experiment {
    /// Refuses what no reduced run can have, before anything is trained for it: in the scene that is run, and, where runs of it choose sample points or networks, in that of the training, and instants between its frames.
    pub(super) fn check_reducible<const D: usize>(&self) -> Result<(), ExperimentError> {
        // Runs by which the training chooses have the time steps of its scene.
        let mut scenes = vec![(self.read_run_scene()?, &self.cases.test, &self.run.step_factor[..])];
        if self.starts > 1 || self.run.chooses_on_training() {
            scenes.push((self.read_scene()?, &self.cases.train, &[]));
        }
        for (document, cases, factors) in scenes {
            for values in cases {
                let steps = check_supported::<D>(&self.scene_of(&document, values)?)?;
                for &factor in factors {
                    check_step_factor(self, factor, steps)?;
                }
            }
        }
        if let Some(between) = &self.frames_between {
            let document = self.read_scene()?;
            for values in &self.cases.train {
                let divided = between.of(&self.scene_of(&document, values)?);
                divided.map_err(|error| self.field("frames_between.per_frame", error))?;
            }
        }
        Ok(())
    }

    /// Refuses a scene with other values than those that were written down; comments may differ. Directories of earlier versions have nothing written down, and pass.
    pub(super) fn check_scene_of(&self, directory: &Path) -> Result<(), ExperimentError> {
        let copy = directory.join(names::SCENE);
        if !copy.exists() {
            return Ok(());
        }
        let before = std::fs::read_to_string(&copy).map_err(|source| ExperimentError::file("read", &copy, source))?;
        let before: toml::Table = mpm_document::parse(&before, &copy)?;
        let now: toml::Table = mpm_document::parse(self.read_scene()?.text(), &self.scene_file())?;
        if before == now {
            return Ok(());
        }
        Err(ExperimentError::ChangedScene {
            scene: self.scene_file().display().to_string(),
            copy: copy.display().to_string(),
        })
    }
}
