//! One body of the calibrated sampler: an isothermal gas under the score, on a basis that moves, turns and changes its spacing every step.

use mpm_core::{Particles, StepControl};
use mpm_materials::IsothermalGas;
use parvi_body::{FramedScore, Parts, PlannedStep, ScoreForce, Stiffness};
use parvi_targets::{Frame, Target};

use crate::checkpoint::Journal;
use crate::drive::{Plan, drive};
use crate::driven::Driven;
use crate::guard::RETRIES;
use crate::kronecker::Kronecker;
use crate::rotation::random_rotation;
use crate::start::{Stream, checked_transfer, not_negative, positive, steps};
use crate::{Annealing, MpmOptions, Observer, Run, SampleError, defaults};

/// One body, and what every layer of the dispatch hands on.
pub(crate) struct Body<'a, const D: usize> {
    pub options: &'a MpmOptions,
    pub target: &'a dyn Target<D>,
    pub frame: &'a Frame<D>,
    pub run: &'a Run,
    /// The body's number, for its own random choices.
    pub number: usize,
    /// Steps of the bodies before it.
    pub earlier_steps: usize,
    pub positions: Vec<[f64; D]>,
    pub journal: &'a mut Journal,
    pub observer: &'a mut dyn Observer,
}

/// Why a body did not come to its end.
pub(crate) struct Unfinished {
    pub error: SampleError,
    /// Evaluations of the score until then.
    pub evaluations: u64,
}

impl From<SampleError> for Unfinished {
    fn from(error: SampleError) -> Self {
        Self { error, evaluations: 0 }
    }
}

impl From<Unfinished> for SampleError {
    fn from(unfinished: Unfinished) -> Self {
        unfinished.error
    }
}

impl<const D: usize> Body<'_, D> {
    /// Move it, at spacing h; or take it from the journal, if it came to its end before.
    pub fn run(self, spacing: f64) -> Result<Driven<D>, Unfinished> {
        if let Some(body) = self.journal.finished() {
            return Ok(body);
        }
        let (options, run) = (self.options, self.run);
        let Motion { steps, control, alpha } = Motion::of(options, run.particles, spacing)?;
        let time_step = control.time_step;
        let moving = options.settling.last_full_step(steps);

        let particles = Particles::at_rest(self.positions, 1.0);
        let gas = IsothermalGas::new(1.0).map_err(SampleError::from)?;
        let mut generator = run.generator(Stream::Places.of_body(self.number));
        let mut places = Kronecker::<D>::new(&mut generator);
        let mut rotations = run.generator(Stream::Rotations.of_body(self.number));
        let (schedule, settling) = (&options.spacing_schedule, &options.settling);
        let plan = Plan {
            body: self.number,
            earlier_steps: self.earlier_steps,
            steps,
            spacing,
            step: |step| {
                let varies = options.shifts && settling.varies(step, steps);
                let (origin, draw) = if varies { places.next_point() } else { ([0.0; D], 0.5) };
                let factor = schedule.factor(step, steps, draw);
                PlannedStep {
                    origin,
                    spacing: spacing * factor,
                    rotation: (varies && options.rotation).then(|| random_rotation(&mut rotations)),
                    alpha: alpha.at(step.min(moving), moving),
                    control: StepControl {
                        time_step: time_step * time_factor(spacing, factor) * settling.factor(step, steps),
                        ..control
                    },
                }
            },
            retries: RETRIES,
            moment_correction: options.moment_correction,
            trace_every: options.trace_every,
            watching: None,
            internal_energy: None,
        };
        let mut score = FramedScore::new(self.target, self.frame);
        score.non_finite = options.non_finite_scores;
        let force = ScoreForce {
            location: options.score_location,
            stiffness: Some(Stiffness::default()),
            ..ScoreForce::at_particles(score)
        };
        let parts = Parts {
            particles,
            force,
            transfer: options.transfer,
            basis: options.basis,
            spacing,
        };
        let mut body = parts.of_gas(gas).map_err(|error| SampleError::in_step(0, error))?;
        match drive(body.as_mut(), self.frame, plan, self.journal, self.observer) {
            Ok(driven) => {
                self.journal.finish(&driven)?;
                Ok(driven)
            }
            Err(error) => Err(Unfinished {
                error,
                evaluations: body.force().score.evaluations,
            }),
        }
    }
}

/// What the options say about the motion of a body, with defaults filled in.
pub(crate) struct Motion {
    pub steps: usize,
    control: StepControl,
    alpha: Annealing,
}

impl Motion {
    /// At spacing h; an option out of range is an error that names it.
    pub fn of(options: &MpmOptions, particles: usize, spacing: f64) -> Result<Self, SampleError> {
        checked_transfer(options.transfer)?;
        options.spacing_schedule.check()?;
        options.settling.check()?;
        let friction = not_negative("friction", options.friction.unwrap_or(defaults::FRICTION))?;
        Ok(Self {
            steps: steps(options.steps, defaults::steps(particles))?,
            control: StepControl {
                time_step: positive("time step", options.time_step, defaults::time_step(spacing))?,
                courant: 1.0,
                displacement: positive("displacement limit", Some(options.displacement_limit), 0.0)?,
                friction,
            },
            alpha: options.annealing.checked()?,
        })
    }
}

/// Factor of Δt where the spacing is `factor` h: Δt follows a smaller spacing all the way, for the sake of the displacement limit, and
/// a larger one by the rule for defaults.
fn time_factor(spacing: f64, factor: f64) -> f64 {
    (defaults::time_step(spacing * factor) / defaults::time_step(spacing)).min(factor)
}
