//! The loop over steps.

use std::path::Path;

use mpm_core::{MpmError, StepControl};

use super::boundary::MovingObstacles;
use super::checkpoint::{self, Place, Saved};
use super::motion::Motion;
use super::probe::Probe;
use super::schedule::{SAME, Schedule};
use super::{Observer, Outcome, Progress, SimulationError, Summary, measure, snapshot};
use crate::output::{SeriesFile, names, vtu, write_index, write_validation, write_whole};
use crate::population::Population;
use crate::{Scene, SceneFault, reference};

/// A run on its way.
pub(super) struct Driver<'a, const D: usize> {
    scene: &'a Scene,
    out: &'a Path,
    start: Population<D>,
    motion: Box<dyn Motion<D>>,
    moving: MovingObstacles<D>,
    probes: Vec<Probe<D>>,
    series: SeriesFile,
    frames: Schedule,
    rows: Schedule,
    checkpoints: Schedule,
    step: u64,
    /// Steps that an earlier process took.
    earlier: u64,
    /// The last Δt that no event had cut short.
    free_step: f64,
    resumed_at: Option<f64>,
}

impl<'a, const D: usize> Driver<'a, D> {
    /// A run at its start, or where its checkpoint left it.
    ///
    /// # Errors
    /// [`SceneFault::TimeStep`] for a step above the Courant condition, and what files and checkpoint have to say.
    pub fn begin(
        scene: &'a Scene,
        out: &'a Path,
        start: Population<D>,
        motion: Box<dyn Motion<D>>,
        moving: MovingObstacles<D>,
    ) -> Result<Self, SimulationError> {
        let probes = scene.probes.iter().enumerate();
        let probes = probes.map(|(index, table)| Probe::build(scene, index, table, &start));
        let probes: Vec<Probe<D>> = probes.collect::<Result<_, _>>().map_err(|fault| scene.error(fault))?;
        let (end, output) = (scene.time.end, &scene.output);
        let columns = measure::columns(&*motion, &probes);
        check_step(scene, &*motion)?;
        let path = out.join(names::CHECKPOINT);
        let saved = checkpoint::read(&path)?;
        if saved.as_ref().is_some_and(|saved| saved.identity != identity(scene)) {
            let reason = "it belongs to another scene; remove it or name another directory";
            return Err(checkpoint::refused(&path, reason.to_owned()));
        }
        let series = match &saved {
            None => {
                forget_validation(out)?;
                SeriesFile::create(out, columns)?
            }
            Some(saved) => SeriesFile::resume(out, columns, saved.rows)?,
        };
        let mut driver = Self {
            scene,
            out,
            start,
            motion,
            moving,
            probes,
            series,
            frames: Schedule::new(output.interval, end),
            rows: Schedule::new(output.series_interval.unwrap_or(output.interval), end),
            checkpoints: Schedule::new(output.checkpoint_interval.unwrap_or(output.interval), end),
            step: 0,
            earlier: 0,
            free_step: f64::INFINITY,
            resumed_at: None,
        };
        match saved {
            None => driver.write(0.0)?,
            Some(saved) => driver.restore(saved)?,
        }
        Ok(driver)
    }

    fn restore(&mut self, saved: Saved) -> Result<(), SimulationError> {
        (self.step, self.earlier, self.free_step) = (saved.step, saved.step, saved.free_step);
        self.resumed_at = Some(saved.time);
        self.motion.set_time(saved.time);
        let particles = saved.particles(self.motion.laws());
        let path = self.out.join(names::CHECKPOINT);
        let particles = particles.map_err(|error| checkpoint::refused(&path, error.to_string()))?;
        self.motion.set_particles(particles);
        Ok(())
    }

    /// All steps that are left.
    pub fn run(mut self, observer: &mut dyn Observer) -> Result<Summary, SimulationError> {
        let end = self.scene.time.end;
        let mut outcome = Outcome::Finished;
        while self.motion.time() < end {
            self.advance()?;
            let time = self.motion.time();
            self.write(time)?;
            let flow = observer.after_step(Progress {
                step: self.step,
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
            let last = snapshot::snapshot(&*self.motion, &self.start);
            let rows = reference::validate(&table.reference, self.scene, self.series.series(), &last);
            validation = rows.map_err(|fault| self.scene.error(fault))?;
            write_validation(self.out, &validation)?;
        }
        Ok(Summary {
            outcome,
            steps: self.step,
            steps_here: self.step - self.earlier,
            time: self.motion.time(),
            particles: self.start.positions.len(),
            resumed_at: self.resumed_at,
            validation,
        })
    }

    /// One step, which ends at the next event if that is near.
    fn advance(&mut self) -> Result<(), SimulationError> {
        let time = self.motion.time();
        let step = self.step + 1;
        let longest = self.motion.loads().longest_step(self.motion.particles());
        let longest = longest.map_err(|penetration| SimulationError::Penetration {
            step,
            time,
            particle: self.motion.particles().identity(penetration.index),
            distance: penetration.distance,
        })?;
        let events = [self.frames, self.rows, self.checkpoints].map(|schedule| schedule.time(schedule.next(time)));
        let event = events.into_iter().fold(self.scene.time.end, f64::min);
        let rest = event - time;
        let viscous = self.motion.laws().viscous_step(D, self.motion.spacing());
        let free = longest.min(self.scene.time.courant * viscous);
        let free = free.min(self.scene.time.step.unwrap_or(f64::INFINITY));
        // Two equal steps to the event, not a long one and a tiny one.
        let cut = if rest > self.free_step && rest < 2.0 * self.free_step {
            0.5 * rest
        } else {
            rest
        };
        let control = StepControl {
            time_step: free.min(cut),
            courant: self.scene.time.courant,
            displacement: f64::INFINITY,
            friction: self.scene.time.damping,
        };
        self.moving.place(self.motion.boundaries_mut(), time);
        let report = self.motion.step(&control);
        let taken = report
            .map_err(|source| SimulationError::step(step, time, source))?
            .time_step;
        if taken < cut {
            self.free_step = taken;
        }
        if event - self.motion.time() <= SAME * rest {
            self.motion.set_time(event);
        }
        self.step = step;
        Ok(())
    }

    /// What belongs to this time: a row, a frame, a checkpoint.
    fn write(&mut self, time: f64) -> Result<(), SimulationError> {
        if self.rows.at(time).is_some() {
            self.series.push(measure::row(&*self.motion, &self.probes))?;
        }
        if let Some(number) = self.frames.at(time) {
            let frame = vtu(&snapshot::snapshot(&*self.motion, &self.start));
            write_whole(&self.out.join(names::frame(number)), &frame)?;
            let times: Vec<f64> = (0..=number).map(|k| self.frames.time(k)).collect();
            write_index(self.out, &times)?;
        }
        if time > 0.0 && self.checkpoints.at(time).is_some() {
            self.write_checkpoint()?;
        }
        Ok(())
    }

    fn write_checkpoint(&self) -> Result<(), SimulationError> {
        let place = Place {
            identity: identity(self.scene),
            step: self.step,
            time: self.motion.time(),
            free_step: self.free_step,
            rows: self.series.series().rows().len(),
        };
        let saved = Saved::new(place, self.motion.particles());
        checkpoint::write(&self.out.join(names::CHECKPOINT), &saved)
    }
}

/// Removes the comparison of an earlier run of the directory, which is not this one's.
fn forget_validation(out: &Path) -> Result<(), SimulationError> {
    let path = out.join(names::VALIDATION);
    match std::fs::remove_file(&path) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => Err(SimulationError::file(&path, error)),
        _ => Ok(()),
    }
}

/// What the run depends on.
fn identity(scene: &Scene) -> String {
    format!("mpm-scenes {}\n{}", env!("CARGO_PKG_VERSION"), scene.text)
}

/// Whether the time step that a scene asks for is one that the Courant condition allows at the start.
fn check_step<const D: usize>(scene: &Scene, motion: &dyn Motion<D>) -> Result<(), SimulationError> {
    let courant = scene.time.courant;
    let failed = |source: MpmError| SimulationError::step(1, 0.0, source);
    let wave_speed = motion.wave_speed().map_err(failed)?;
    let speed = motion.particles().largest_speed();
    let limit = courant * motion.spacing() / (wave_speed + speed);
    match scene.time.step {
        Some(step) if step > limit => {
            let fault = SceneFault::TimeStep { step, limit, courant };
            Err(scene.error(fault).into())
        }
        _ => Ok(()),
    }
}
