//! Whether numbers of sample points fit the body, which is known long before they are chosen.

use mpm_scenes::{Kinematics, Population};

use super::{Experiment, ExperimentError};
use crate::online::check_count;

impl Experiment {
    /// Refuses numbers of sample points that no reduced run of the scene can have.
    ///
    /// # Errors
    /// [`ExperimentError::Field`] with the first one, and what the scene's own reader says.
    pub(super) fn check_sample_counts<const D: usize>(&self) -> Result<(), ExperimentError> {
        let counts: Vec<usize> = self.run.counts().collect();
        if counts.is_empty() {
            return Ok(());
        }
        let document = self.read_run_scene()?;
        let scene = self.scene_of(&document, &self.cases.test[0])?;
        let population = Population::<D>::fill(&scene).map_err(|fault| scene.error(fault))?;
        let kinematics = Kinematics::of(&scene, &population).map_err(|fault| scene.error(fault))?;
        for (_, training) in self.trainings()? {
            for &count in &counts {
                let fits = check_count(&kinematics, population.positions.len(), training.coordinates, count);
                fits.map_err(|error| self.field("run.samples", error))?;
            }
        }
        Ok(())
    }
}
