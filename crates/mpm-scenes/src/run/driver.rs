//! The loop over steps, and what is written meanwhile.

use std::path::Path;

use super::body::Body;
use super::budget::Budget;
use super::checkpoint::{self, Saved};
use super::probe::Probe;
use super::{Observer, Outcome, Progress, SimulationError, Summary, measure, snapshot};
use crate::output::{SeriesFile, names, remove_file, remove_frames, vtu, write_index, write_validation, write_whole};
use crate::{Scene, reference};

/// A run on its way.
pub(super) struct Driver<'a, const D: usize> {
    scene: &'a Scene,
    out: &'a Path,
    body: Body<'a, D>,
    probes: Vec<Probe<D>>,
    series: SeriesFile,
    /// Steps that an earlier process took.
    earlier: u64,
    resumed_at: Option<f64>,
}

impl<'a, const D: usize> Driver<'a, D> {
    /// A run at its start, or where its checkpoint left it.
    ///
    /// # Errors
    /// What files and checkpoint have to say.
    pub fn begin(scene: &'a Scene, out: &'a Path, body: Body<'a, D>) -> Result<Self, SimulationError> {
        let probes = scene.probes.iter().enumerate();
        let probes = probes.map(|(index, table)| Probe::build(scene, index, table, &body.start));
        let probes: Vec<Probe<D>> = probes.collect::<Result<_, _>>().map_err(|fault| scene.error(fault))?;
        let columns = measure::columns(&*body.motion, &probes, body.budget.as_ref());
        let path = out.join(names::CHECKPOINT);
        let mut saved = checkpoint::read(&path)?;
        if let Some(saved) = &mut saved {
            let end = checkpoint::earlier_end(saved, scene, body.mesh_contents);
            let end = end.map_err(|reason| checkpoint::refused(&path, reason))?;
            if end < scene.time.end {
                remove_file(&out.join(names::VALIDATION))?;
                // The end of the earlier run had a row, which this one has only where it has others.
                let extra = saved.time >= end && body.rows.at(saved.time).is_none();
                saved.rows -= usize::from(extra).min(saved.rows);
            }
        }
        let series = match &saved {
            None => {
                forget_earlier(out)?;
                SeriesFile::create(out, columns)?
            }
            Some(saved) => SeriesFile::resume(out, columns, saved.rows, &|time| body.rows.at(time))?,
        };
        let mut driver = Self {
            scene,
            out,
            body,
            probes,
            series,
            earlier: 0,
            resumed_at: None,
        };
        match saved {
            None => driver.write(0.0)?,
            Some(saved) => driver.restore(saved)?,
        }
        Ok(driver)
    }

    fn restore(&mut self, saved: Saved) -> Result<(), SimulationError> {
        (self.body.step, self.earlier, self.body.free_step) = (saved.step, saved.step, saved.free_step);
        self.resumed_at = Some(saved.time);
        self.body.motion.set_time(saved.time);
        if let Some(budget) = &saved.budget {
            self.body.budget = Some(Budget::restore(budget, &mut *self.body.motion));
        }
        let particles = saved.particles();
        let path = self.out.join(names::CHECKPOINT);
        let particles = particles.map_err(|error| checkpoint::refused(&path, error.to_string()))?;
        self.body.motion.set_particles(particles);
        Ok(())
    }

    /// All steps that are left.
    pub fn run(mut self, observer: &mut dyn Observer) -> Result<Summary, SimulationError> {
        let end = self.scene.time.end;
        let mut outcome = Outcome::Finished;
        while self.body.motion.time() < end {
            self.body.advance()?;
            let time = self.body.motion.time();
            self.write(time)?;
            let flow = observer.after_step(Progress {
                step: self.body.step,
                time,
                end,
            });
            if flow.is_break() && time < end {
                self.write_checkpoint()?;
                outcome = Outcome::Interrupted;
                break;
            }
        }
        let mut validation = Vec::new();
        if let (Outcome::Finished, Some(table)) = (outcome, &self.scene.validation) {
            let last = snapshot::snapshot(&*self.body.motion, &self.body.start);
            let rows = reference::validate(&table.reference, self.scene, self.series.series(), &last);
            validation = rows.map_err(|fault| self.scene.error(fault))?;
            write_validation(self.out, &validation)?;
        }
        Ok(Summary {
            outcome,
            steps: self.body.step,
            steps_here: self.body.step - self.earlier,
            time: self.body.motion.time(),
            particles: self.body.start.positions.len(),
            resumed_at: self.resumed_at,
            validation,
        })
    }

    /// What belongs to this time: a row, a frame, a checkpoint.
    fn write(&mut self, time: f64) -> Result<(), SimulationError> {
        if self.body.rows.at(time).is_some() {
            let row = measure::row(&*self.body.motion, &self.probes, self.body.budget.as_ref());
            self.check_finite(&row)?;
            self.series.push(row)?;
        }
        if let Some(number) = self.body.frames.at(time) {
            let frame = vtu(&snapshot::snapshot(&*self.body.motion, &self.body.start));
            write_whole(&self.out.join(names::frame(number)), &frame)?;
            let times: Vec<f64> = (0..=number).map(|k| self.body.frames.time(k)).collect();
            write_index(self.out, &times)?;
        }
        if time > 0.0 && self.body.checkpoints.at(time).is_some() {
            self.write_checkpoint()?;
        }
        Ok(())
    }

    /// A number that is none says that the motion has none any more, of which the next step knows the particle, or a scene has numbers too large to be added.
    fn check_finite(&mut self, row: &[f64]) -> Result<(), SimulationError> {
        let mut values = self.series.series().columns().iter().zip(row);
        let Some((column, &value)) = values.find(|(_, value)| !value.is_finite()) else {
            return Ok(());
        };
        let diverged = SimulationError::Diverged {
            step: self.body.step,
            time: self.body.motion.time(),
            column: column.clone(),
            value,
        };
        if value.is_nan() {
            self.body.advance()?;
        }
        Err(diverged)
    }

    fn write_checkpoint(&self) -> Result<(), SimulationError> {
        let mut saved = Saved::of(self.body.motion.particles());
        saved.identity = checkpoint::identity(self.scene);
        saved.step = self.body.step;
        saved.time = self.body.motion.time();
        saved.free_step = self.body.free_step;
        saved.rows = self.series.series().rows().len();
        saved.mesh_contents = self.body.mesh_contents;
        saved.budget = self.body.budget.map(|budget| budget.save(&*self.body.motion));
        checkpoint::write(&self.out.join(names::CHECKPOINT), &saved)
    }
}

/// Removes what an earlier run of the directory has left and this one may not replace: frames beyond its last one, and a comparison.
fn forget_earlier(out: &Path) -> Result<(), SimulationError> {
    remove_frames(out)?;
    remove_file(&out.join(names::VALIDATION))
}
