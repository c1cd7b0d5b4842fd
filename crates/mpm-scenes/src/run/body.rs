//! A body on its way through a scene: its steps, and the times that they hit.

use mpm_core::{MpmError, StepControl};
use mpm_materials::Law;
use mpm_tensor::vector;

use super::SimulationError;
use super::boundary::{self, Movers};
use super::budget::Budget;
use super::dispatch;
use super::motion::Motion;
use super::nonlocal::Nonlocal;
use super::probe::Probe;
use super::schedule::{SAME, Schedule};
use crate::background::Background;
use crate::placement;
use crate::population::Population;
use crate::scene::{BodyTable, MOST_STEPS};
use crate::{Kinematics, Scene, SceneFault, StepLimit};

/// The bodies of a scene and the clock of their run.
pub(super) struct Body<'a, const D: usize> {
    scene: &'a Scene,
    pub start: Population<D>,
    pub motion: Box<dyn Motion<D>>,
    movers: Movers<D>,
    kinematics: Kinematics<D>,
    nonlocal: Nonlocal,
    /// Fingerprint of the mesh's file, where there is one.
    pub mesh_contents: Option<u64>,
    /// Where the energy has gone, if the scene asks.
    pub budget: Option<Budget>,
    pub frames: Schedule,
    pub rows: Schedule,
    pub checkpoints: Schedule,
    /// Steps taken.
    pub step: u64,
    /// The last Δt that no event had cut short.
    pub free_step: f64,
}

impl<'a, const D: usize> Body<'a, D> {
    /// At t = 0.
    ///
    /// # Errors
    /// What [`Population::fill`] says, [`SceneFault::InsideRigid`], [`SceneFault::OutsideMesh`], [`SceneFault::Value`] for what acts on nothing, [`SceneFault::HeldTwice`], [`SceneFault::TimeStep`] for a step above the Courant condition, and [`SceneFault::TooManySteps`].
    pub fn begin(scene: &'a Scene) -> Result<Self, SimulationError> {
        let refused = |fault| scene.error(fault);
        let background = Background::build(scene).map_err(refused)?;
        let start = Population::<D>::fill_on(scene, &background).map_err(refused)?;
        placement::check(scene, &background, &start).map_err(refused)?;
        Probe::check_points(scene, background.room(), &start).map_err(refused)?;
        let (boundaries, movers) = boundary::build(scene, &background, &start).map_err(refused)?;
        let kinematics = Kinematics::of(scene, &start).map_err(refused)?;
        let mesh_contents = background.file_contents();
        let mut motion = dispatch::build(scene, &start, background, boundaries).map_err(refused)?;
        check_step(scene, &*motion, &start, &movers)?;
        let (end, output) = (scene.time.end, &scene.output);
        let budget = output.energy_budget.then(|| Budget::begin(&mut *motion));
        Ok(Self {
            scene,
            start,
            motion,
            movers,
            kinematics,
            nonlocal: Nonlocal::of(scene),
            mesh_contents,
            budget,
            frames: Schedule::new(output.interval, end),
            rows: Schedule::new(output.series_interval.unwrap_or(output.interval), end),
            checkpoints: Schedule::new(output.checkpoint_interval.unwrap_or(output.interval), end),
            step: 0,
            free_step: f64::INFINITY,
        })
    }

    /// One step, which ends at the next event if that is near.
    pub fn advance(&mut self) -> Result<(), SimulationError> {
        let time = self.motion.time();
        let step = self.step + 1;
        let longest = self.motion.loads().longest_step(self.motion.particles());
        let longest = longest.map_err(|penetration| {
            let particle = self.motion.particles().identity(penetration.index);
            SimulationError::Penetration {
                step,
                time,
                particle,
                body: self.start.body(self.scene, particle),
                distance: penetration.distance,
            }
        })?;
        let events = [self.frames, self.rows, self.checkpoints].map(|schedule| schedule.time(schedule.next(time)));
        let event = events.into_iter().fold(self.scene.time.end, f64::min);
        let rest = event - time;
        let viscous = viscous_step(&*self.motion);
        // What moves by itself is no farther on its way than particles are.
        let passing = self.motion.spacing() / self.movers.largest_speed(time);
        let free = longest.min(self.scene.time.courant * viscous.min(passing));
        let free = free.min(self.scene.time.step.unwrap_or(f64::INFINITY));
        // Two equal steps to the event, not a long one and a tiny one; what is tiny by rounding is none.
        let cut = if rest > (1.0 + SAME) * self.free_step && rest < 2.0 * self.free_step {
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
        if self.step == 0 {
            self.prescribe();
        }
        self.movers.place(self.motion.boundaries_mut(), time);
        self.nonlocal.begin(&*self.motion);
        let mut taken = 0.0;
        let mut one = |motion: &mut dyn Motion<D>| {
            taken = motion.step(&control)?.time_step;
            Ok(())
        };
        let done = match &mut self.budget {
            Some(budget) => budget.over_step(&mut *self.motion, one),
            None => one(&mut *self.motion),
        };
        done.map_err(|source| {
            SimulationError::step(step, time, source, |particle| self.start.body(self.scene, particle))
        })?;
        self.nonlocal.end(&mut *self.motion, &self.start);
        if taken < cut {
            self.free_step = taken;
        }
        if event - self.motion.time() <= SAME * rest {
            self.motion.set_time(event);
        }
        self.prescribe();
        self.step = step;
        Ok(())
    }

    /// Gives kinematic particles the position and velocity that they have at this time.
    fn prescribe(&mut self) {
        let (motion, positions) = (&mut *self.motion, &self.start.positions);
        match &mut self.budget {
            Some(budget) => budget.over_prescription(motion, &self.kinematics, positions),
            None => motion.prescribe(&self.kinematics, positions),
        }
    }
}

/// The longest step for the viscous stresses of the particles as they are.
fn viscous_step<const D: usize>(motion: &dyn Motion<D>) -> f64 {
    let particles = motion.particles();
    let (deformations, states) = (&particles.deformation_gradients, &particles.states);
    motion.laws().viscous_step(motion.spacing(), deformations, states)
}

/// Whether the time step that a scene asks for is one that the Courant condition allows at the start, and the end one that allowed steps reach.
fn check_step<const D: usize>(
    scene: &Scene,
    motion: &dyn Motion<D>,
    start: &Population<D>,
    movers: &Movers<D>,
) -> Result<(), SimulationError> {
    let courant = scene.time.courant;
    let failed = |source: MpmError| SimulationError::step(1, 0.0, source, |particle| start.body(scene, particle));
    let wave_speed = motion.wave_speed().map_err(failed)?;
    let speed = motion.particles().largest_speed();
    let limit = courant * motion.spacing() / (wave_speed + speed);
    let end = scene.time.end;
    let free = limit.min(courant * viscous_step(motion));
    let reached = MOST_STEPS * courant * motion.spacing() / movers.largest_speed(0.0);
    match scene.time.step {
        Some(step) if step > limit => {
            let fault = SceneFault::TimeStep { step, limit, courant };
            Err(scene.error(fault).into())
        }
        _ if end > reached => {
            let expected = format!(
                "at most {reached:e}, which 1e9 steps reach that are as short as the fastest obstacle or held region asks for"
            );
            Err(scene.error(SceneFault::value("time.end", end, expected)).into())
        }
        _ if end > MOST_STEPS * free => {
            let (cause, body) = step_limit(scene, motion, start, free < limit);
            let fault = SceneFault::TooManySteps {
                body: body.unwrap_or_default(),
                cause,
                step: free,
                end,
            };
            Err(scene.error(fault).into())
        }
        _ => Ok(()),
    }
}

/// What makes the time step at the start short, and the body of which it does.
#[expect(non_snake_case, reason = "F is what the field writes")]
fn step_limit<const D: usize>(
    scene: &Scene,
    motion: &dyn Motion<D>,
    start: &Population<D>,
    viscous: bool,
) -> (StepLimit, Option<String>) {
    if viscous {
        let viscous_step = |body: &&BodyTable| {
            let law = scene
                .materials
                .get(&body.material)
                .and_then(|table| table.law::<D>().ok());
            law.map_or(f64::INFINITY, |law| law.longest_viscous_step(1.0))
        };
        let bodies = scene.bodies.iter();
        let body = bodies.min_by(|a, b| viscous_step(a).total_cmp(&viscous_step(b)));
        return (StepLimit::Viscosity, body.map(|body| body.name.clone()));
    }
    let (particles, laws) = (motion.particles(), motion.laws());
    let densities = start
        .masses
        .iter()
        .zip(&start.volumes)
        .map(|(mass, volume)| mass / volume);
    let densities: Vec<f64> = densities.collect();
    let wave_speed = |index: usize| {
        let (F, state) = (&particles.deformation_gradients[index], &particles.states[index]);
        laws.wave_speed(F, state, densities[particles.identity(index)])
    };
    let speed = |index: usize| vector::norm(&particles.velocities[index]);
    let largest = |of: &dyn Fn(usize) -> f64| {
        let all = (0..particles.len()).map(|index| (of(index), index));
        let largest = all.max_by(|a, b| a.0.total_cmp(&b.0));
        largest.map_or((0.0, 0), |(value, index)| (value, particles.identity(index)))
    };
    let (by_speed, by_waves) = (largest(&speed), largest(&wave_speed));
    let (cause, particle) = match by_speed.0 > by_waves.0 {
        true => (StepLimit::Speed(by_speed.0), by_speed.1),
        false => (StepLimit::WaveSpeed(by_waves.0), by_waves.1),
    };
    (cause, start.body(scene, particle))
}
