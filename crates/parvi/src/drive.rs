//! The loop around the step, shared by the calibrated sampler and the paper's algorithms.

use mpm_core::{MpmError, StepReport};
use parvi_body::{Cloud, FramedScore, Moving, PlannedStep};
use parvi_targets::Frame;

use crate::checkpoint::Journal;
use crate::driven::Driven;
use crate::extent::Extent;
use crate::guard::{Guard, Progressed, check_energy};
use crate::moment_correction::correct_moments;
use crate::view::Moment;
use crate::watching::Watching;
use crate::{MomentCorrection, NonFiniteScores, Observer, Progress, SampleError, Samples, TracePoint, Watched};

/// What the loop is to do.
pub(crate) struct Plan<'a, P, const D: usize> {
    /// The body's number in the run, from 0.
    pub body: usize,
    /// Steps of the bodies before it.
    pub earlier_steps: usize,
    /// Steps.
    pub steps: usize,
    /// The central spacing h, which residuals are measured at.
    pub spacing: f64,
    /// The step with a number, from 1; asked for in order.
    pub step: P,
    /// Times that steps which went wrong may be taken back.
    pub retries: usize,
    /// The last move.
    pub moment_correction: MomentCorrection,
    /// Record the state every so many steps (0: never).
    pub trace_every: usize,
    /// Find the best configuration on the way.
    pub watching: Option<Watching<D>>,
    /// The energy that the body stores.
    pub internal_energy: Option<&'a dyn Fn(&Cloud<D>) -> f64>,
}

/// Run `body` as planned; its particles are in frame coordinates, the result in the target's.
pub(crate) fn drive<P, const D: usize>(
    body: &mut dyn Moving<'_, D>,
    frame: &Frame<D>,
    plan: Plan<P, D>,
    journal: &mut Journal,
    observer: &mut dyn Observer,
) -> Result<Driven<D>, SampleError>
where
    P: FnMut(usize) -> PlannedStep<D>,
{
    let mut way = Way::begin(body, frame, plan, journal, observer)?;
    while way.step <= way.steps {
        way.go_on(journal)?;
    }
    way.end()
}

/// A body on its way.
struct Way<'a, 'b, P, const D: usize> {
    body: &'a mut dyn Moving<'b, D>,
    frame: &'a Frame<D>,
    plan: Plan<'a, P, D>,
    observer: &'a mut dyn Observer,
    guard: Guard<D>,
    /// The step to come, from 1, and the last one.
    step: usize,
    steps: usize,
    /// The step whose end is the beginning of the last tenth.
    late: usize,
    time: f64,
    earlier: Extent<D>,
    /// Of the last step.
    origin: [f64; D],
    active_nodes: usize,
    trace: Vec<TracePoint>,
    /// Whether a watch has ended it.
    ended: bool,
    scores: Vec<[f64; D]>,
}

impl<'a, 'b, P: FnMut(usize) -> PlannedStep<D>, const D: usize> Way<'a, 'b, P, D> {
    /// At the start, or where an earlier process left it.
    fn begin(
        body: &'a mut dyn Moving<'b, D>,
        frame: &'a Frame<D>,
        plan: Plan<'a, P, D>,
        journal: &mut Journal,
        observer: &'a mut dyn Observer,
    ) -> Result<Self, SampleError> {
        let steps = plan.steps;
        let mut way = Self {
            guard: Guard::new(plan.retries),
            step: 1,
            steps,
            late: steps - steps.div_ceil(10),
            time: 0.0,
            earlier: Extent::of(&body.particles().positions),
            origin: [0.0; D],
            active_nodes: 0,
            trace: Vec::new(),
            ended: false,
            scores: vec![[0.0; D]; body.particles().len()],
            body,
            frame,
            plan,
            observer,
        };
        if let Some(state) = journal.moving()? {
            for skipped in 1..state.step {
                way.body.turn(&(way.plan.step)(skipped));
            }
            way.guard.resume(&state);
            state.restore(way.body);
            let score = &mut way.body.force().score;
            (score.evaluations, score.replaced) = (state.so_far.evaluations, state.so_far.replaced);
            (way.step, way.time, way.earlier) = (state.step, state.so_far.time, state.so_far.earlier);
        }
        way.show(way.step - 1)?;
        if let Some(watching) = &mut way.plan.watching {
            let failed = |error| SampleError::in_step(way.step - 1, error);
            watching
                .look(way.step - 1, way.body, frame, way.plan.spacing)
                .map_err(failed)?;
        }
        Ok(way)
    }

    /// Make the next step, or go back where it went wrong.
    fn go_on(&mut self, journal: &mut Journal) -> Result<(), SampleError> {
        let step = self.step;
        let score = &self.body.force().score;
        let so_far = Progressed {
            time: self.time,
            evaluations: score.evaluations,
            replaced: score.replaced,
            earlier: self.earlier,
        };
        let state = self.guard.state(self.body, step, so_far);
        let mut planned = self.guard.plan(step, &mut self.plan.step);
        planned.control.time_step *= self.guard.caution();
        let report = match advance(self.body, &planned, self.plan.retries > 0) {
            Ok(report) => report,
            Err(failure) => return self.go_back(failure),
        };
        if let Some(state) = self.guard.proved(state) {
            journal.keep(state)?;
        }
        (self.origin, self.active_nodes) = (planned.origin, report.active_nodes);
        self.time += report.time_step;
        let every = self.plan.trace_every;
        if every > 0 && (step.is_multiple_of(every) || step == 1) {
            self.record(report.displacement)?;
        }
        if step == self.late {
            self.earlier = Extent::of(&self.body.particles().positions);
        }
        self.show(step)?;
        let steps = self.steps;
        if self.observer.after_step(Progress { step, steps }).is_break() {
            return Err(SampleError::Interrupted { step });
        }
        self.watch()?;
        self.step += 1;
        Ok(())
    }

    /// To the last state that proved good.
    fn go_back(&mut self, failure: Failure) -> Result<(), SampleError> {
        let Some(state) = self
            .guard
            .back()
            .filter(|_| !failure.is_final(&self.body.force().score))
        else {
            return Err(failure.into_error(self.step));
        };
        state.restore(self.body);
        let step = state.step;
        (self.step, self.time) = (step, state.so_far.time);
        self.trace.retain(|point| point.step < step);
        self.show(step - 1)
    }

    /// A point of the trace.
    fn record(&mut self, displacement: f64) -> Result<(), SampleError> {
        let failed = |error| SampleError::in_step(self.step, error);
        let positions = self.body.particles().positions.clone();
        let score = &mut self.body.force().score;
        score.evaluate(&positions, &mut self.scores).map_err(failed)?;
        let potential_energy = score.potential_energy(&positions);
        let residual = self.body.residual(&self.origin, self.plan.spacing, &self.scores);
        self.trace.push(TracePoint {
            step: self.step,
            time: self.time,
            residual: Some(residual.map_err(failed)?.ratio()),
            kinetic_energy: self.body.particles().kinetic_energy(),
            potential_energy,
            internal_energy: self.plan.internal_energy.map(|of| of(self.body.particles())),
            displacement,
        });
        Ok(())
    }

    /// What the observer sees after a step.
    fn show(&mut self, step: usize) -> Result<(), SampleError> {
        let moment = Moment {
            body: self.plan.body,
            steps: self.plan.steps,
            earlier_steps: self.plan.earlier_steps,
            step,
            time: self.time,
        };
        moment.show(self.body.particles(), self.frame, self.observer)
    }

    /// A look at the body, where one is due; it may end the run.
    fn watch(&mut self) -> Result<(), SampleError> {
        let (step, steps) = (self.step, self.steps);
        let watching = self.plan.watching.as_mut();
        if let Some(watching) = watching.filter(|watching| watching.is_due(step, steps)) {
            let ends = watching.look(step, self.body, self.frame, self.plan.spacing);
            let ends = ends.map_err(|error| SampleError::in_step(step, error))?;
            if ends && step < steps {
                (self.steps, self.ended) = (step, true);
            } else if step < self.late {
                // Should the next look end the run.
                self.earlier = Extent::of(&self.body.particles().positions);
            }
        }
        Ok(())
    }

    /// The last move, and what is left.
    fn end(self) -> Result<Driven<D>, SampleError> {
        let Self {
            body,
            frame,
            plan,
            mut scores,
            steps,
            ..
        } = self;
        let failed = |error| SampleError::in_step(steps, error);
        let drift = self.earlier.drift_to(&Extent::of(&body.particles().positions));
        let kinetic_energy = body.particles().kinetic_energy();
        let storage_bytes = body.storage_bytes();
        let mut positions = std::mem::take(&mut body.particles().positions);
        let score = &mut body.force().score;
        score.non_finite = NonFiniteScores::Report;
        let corrected = correct_moments(
            plan.moment_correction,
            f64::INFINITY,
            &mut positions,
            score,
            &mut scores,
        );
        corrected.map_err(failed)?;
        let (evaluations, replaced) = (score.evaluations, score.replaced);
        body.particles().positions = positions;
        let residual = body.residual(&self.origin, plan.spacing, &scores).map_err(failed)?;
        let particles = body.particles();
        let in_order = particles.in_creation_order(&particles.positions);
        let watched = plan.watching;
        let samples = Samples {
            positions: finite(in_order.iter().map(|z| frame.to_target(z)).collect(), steps)?,
            steps,
            score_evaluations: evaluations,
            scores_replaced: replaced,
            residual: Some(residual.ratio()),
            spacing: Some(plan.spacing),
            active_nodes: Some(self.active_nodes),
            bodies: Some(1),
            storage_bytes: Some(storage_bytes),
            trace: self.trace,
            density_evaluations: watched.as_ref().map_or(0, |watching| watching.density_evaluations),
            watched: watched.map(|watching| Watched {
                ended: self.ended,
                ..watching.into_seen()
            }),
            ..Samples::default()
        };
        Ok(Driven {
            samples,
            scores: particles.in_creation_order(&scores),
            positions: in_order,
            drift,
            kinetic_energy,
        })
    }
}

/// Why a step is taken back.
enum Failure {
    /// The mechanics refused it.
    Refused(MpmError),
    /// Its energy exploded.
    Exploded(String),
}

impl Failure {
    /// Whether the policy has it reported at once.
    fn is_final<const D: usize>(&self, score: &FramedScore<'_, D>) -> bool {
        let of_score = matches!(self, Self::Refused(MpmError::BodyForceNotFinite { .. }));
        of_score && score.non_finite == NonFiniteScores::Report
    }

    fn into_error(self, step: usize) -> SampleError {
        match self {
            Self::Refused(error) => SampleError::in_step(step, error),
            Self::Exploded(reason) => SampleError::Diverged { step, reason },
        }
    }
}

/// Turn and place the basis, and make the step.
fn advance<const D: usize>(
    body: &mut dyn Moving<'_, D>,
    planned: &PlannedStep<D>,
    guarded: bool,
) -> Result<StepReport, Failure> {
    let mut limited = *planned;
    let force = body.force();
    force.alpha = planned.alpha;
    if let Some(stiffness) = &force.stiffness {
        limited.control.time_step = limited.control.time_step.min(stiffness.time_limit());
    }
    body.turn(planned);
    let report = body.step(&limited).map_err(Failure::Refused)?;
    if guarded {
        check_energy(body.particles(), planned, &report).map_err(Failure::Exploded)?;
    }
    if let Some(mut stiffness) = body.force().stiffness.take() {
        stiffness.update(body.order());
        body.force().stiffness = Some(stiffness);
    }
    Ok(report)
}

/// The positions, if all are finite.
pub(crate) fn finite<const D: usize>(positions: Vec<[f64; D]>, step: usize) -> Result<Vec<[f64; D]>, SampleError> {
    match positions.iter().position(|x| !x.iter().all(|c| c.is_finite())) {
        None => Ok(positions),
        Some(particle) => Err(SampleError::Diverged {
            step,
            reason: format!("particle {particle} is at {:?}", positions[particle]),
        }),
    }
}
