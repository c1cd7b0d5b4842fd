//! Step control that takes back what went wrong: a step that fails or whose energy explodes is made again from an earlier state, with a
//! shorter Δt.

use std::collections::VecDeque;

use mpm_core::StepReport;

use crate::extent::Extent;
use parvi_body::{Cloud, Moving, PlannedStep, Stiffness};

/// Steps between two states that are kept.
pub(crate) const INTERVAL: usize = 8;

/// Times that a run of the calibrated sampler may go back.
pub(crate) const RETRIES: usize = 12;

/// What the kinetic energy may reach, in units of that of particles which all move at the displacement limit.
const EXPLOSION: f64 = 25.0;

/// A body before a step.
#[derive(Clone, Debug)]
pub(crate) struct State<const D: usize> {
    /// The step to come, from 1.
    pub step: usize,
    pub particles: Cloud<D>,
    pub stiffness: Option<Stiffness<D>>,
    pub so_far: Progressed<D>,
    /// Factor of Δt.
    pub caution: f64,
    /// Times that the run may still go back.
    pub retries: usize,
}

/// What a run has spent and seen before a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Progressed<const D: usize> {
    /// Pseudo-time.
    pub time: f64,
    /// Evaluations of the score.
    pub evaluations: u64,
    /// Scores replaced.
    pub replaced: u64,
    /// Where the particles were when the last tenth of the steps began, or at the start.
    pub earlier: Extent<D>,
}

impl<const D: usize> State<D> {
    pub fn restore(&self, body: &mut dyn Moving<'_, D>) {
        body.particles().clone_from(&self.particles);
        body.force().stiffness.clone_from(&self.stiffness);
    }
}

/// Keeps the state of every eighth step until a later one has proved good, and the steps planned since.
pub(crate) struct Guard<const D: usize> {
    guards: bool,
    retries: usize,
    /// Factor of Δt: halved with every retry, and 10 % larger with every step that went well, up to 1.
    caution: f64,
    /// Whose own step has been made.
    proved: Option<State<D>>,
    /// The step that the planned ones begin with.
    first: usize,
    planned: VecDeque<PlannedStep<D>>,
}

impl<const D: usize> Guard<D> {
    /// A guard that goes back at most so many times (0: never, and keeps nothing).
    pub fn new(retries: usize) -> Self {
        Self {
            guards: retries > 0,
            retries,
            caution: 1.0,
            proved: None,
            first: 1,
            planned: VecDeque::new(),
        }
    }

    /// Factor of Δt.
    pub fn caution(&self) -> f64 {
        self.caution
    }

    /// The state before this step, if it is one to be kept.
    pub fn state(&self, body: &mut dyn Moving<'_, D>, step: usize, so_far: Progressed<D>) -> Option<State<D>> {
        let keeps = self.guards && (step - 1).is_multiple_of(INTERVAL);
        keeps.then(|| State {
            step,
            particles: body.particles().clone(),
            stiffness: body.force().stiffness.clone(),
            so_far,
            caution: self.caution,
            retries: self.retries,
        })
    }

    /// Go on from a state that an earlier process left, whose own step was made there.
    pub fn resume(&mut self, state: &State<D>) {
        self.caution = state.caution;
        self.retries = state.retries;
        self.first = state.step;
        self.proved = Some(state.clone());
    }

    /// The plan of a step, remembered as long as it may have to be made again.
    pub fn plan(&mut self, step: usize, plan: &mut impl FnMut(usize) -> PlannedStep<D>) -> PlannedStep<D> {
        if !self.guards {
            return plan(step);
        }
        while self.first + self.planned.len() <= step {
            self.planned.push_back(plan(self.first + self.planned.len()));
        }
        self.planned[step - self.first]
    }

    /// A step went well that began from `state`, if that was kept; it is handed back.
    pub fn proved(&mut self, state: Option<State<D>>) -> Option<&State<D>> {
        self.caution = (1.1 * self.caution).min(1.0);
        let state = state?;
        self.planned.drain(..state.step - self.first);
        self.first = state.step;
        Some(self.proved.insert(state))
    }

    /// The state to go back to; none if there is no good one or all retries are used up.
    pub fn back(&mut self) -> Option<&State<D>> {
        if self.proved.is_some() {
            self.retries = self.retries.checked_sub(1)?;
            self.caution *= 0.5;
        }
        self.proved.as_ref()
    }
}

/// Whether a step's kinetic energy is beyond what the displacement limit lets nodes carry.
pub(crate) fn check_energy<const D: usize>(
    particles: &Cloud<D>,
    planned: &PlannedStep<D>,
    report: &StepReport,
) -> Result<(), String> {
    let speed = planned.control.displacement * planned.spacing / report.time_step;
    let (energy, limit) = (particles.kinetic_energy(), EXPLOSION * 0.5 * speed * speed);
    if energy <= limit || limit.is_infinite() {
        Ok(())
    } else {
        Err(format!(
            "the kinetic energy is {energy:.3e}, and {limit:.3e} is the most that the displacement limit allows"
        ))
    }
}
