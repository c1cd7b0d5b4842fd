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
    mut plan: Plan<P, D>,
    journal: &mut Journal,
    observer: &mut dyn Observer,
) -> Result<Driven<D>, SampleError>
where
    P: FnMut(usize) -> PlannedStep<D>,
{
    let (mut steps, spacing) = (plan.steps, plan.spacing);
    let late = steps - steps.div_ceil(10);
    let mut scores = vec![[0.0; D]; body.particles().len()];
    let mut trace: Vec<TracePoint> = Vec::new();
    let mut guard = Guard::new(plan.retries);
    let mut earlier = Extent::of(&body.particles().positions);
    let (mut step, mut time, mut active_nodes, mut origin) = (1, 0.0, 0, [0.0; D]);
    let mut ended = false;
    if let Some(state) = journal.moving()? {
        for skipped in 1..state.step {
            body.turn(&(plan.step)(skipped));
        }
        guard.resume(&state);
        state.restore(body);
        let Progressed {
            evaluations, replaced, ..
        } = state.so_far;
        let score = &mut body.force().score;
        (score.evaluations, score.replaced) = (evaluations, replaced);
        (step, time, earlier) = (state.step, state.so_far.time, state.so_far.earlier);
    }
    let moment = Moment {
        body: plan.body,
        steps,
        earlier_steps: plan.earlier_steps,
        ..Moment::default()
    };
    let seen_after = |step, time| Moment { step, time, ..moment };
    seen_after(step - 1, time).show(body.particles(), frame, observer)?;
    if let Some(watching) = &mut plan.watching {
        let failed = |error| SampleError::in_step(step - 1, error);
        watching.look(step - 1, body, frame, spacing).map_err(failed)?;
    }
    while step <= steps {
        let failed = |error| SampleError::in_step(step, error);
        let so_far = Progressed {
            time,
            evaluations: body.force().score.evaluations,
            replaced: body.force().score.replaced,
            earlier,
        };
        let state = guard.state(body, step, so_far);
        let mut planned = guard.plan(step, &mut plan.step);
        planned.control.time_step *= guard.caution();
        let report = match advance(body, &planned, plan.retries > 0) {
            Ok(report) => report,
            Err(failure) => {
                let Some(state) = guard.back().filter(|_| !failure.is_final(&body.force().score)) else {
                    return Err(failure.into_error(step));
                };
                state.restore(body);
                (step, time) = (state.step, state.so_far.time);
                trace.retain(|point| point.step < step);
                seen_after(step - 1, time).show(body.particles(), frame, observer)?;
                continue;
            }
        };
        if let Some(state) = guard.proved(state) {
            journal.keep(state)?;
        }
        origin = planned.origin;
        time += report.time_step;
        active_nodes = report.active_nodes;
        if plan.trace_every > 0 && (step % plan.trace_every == 0 || step == 1) {
            let positions = body.particles().positions.clone();
            let score = &mut body.force().score;
            score.evaluate(&positions, &mut scores).map_err(failed)?;
            let potential_energy = score.potential_energy(&positions);
            let residual = body.residual(&origin, spacing, &scores).map_err(failed)?;
            trace.push(TracePoint {
                step,
                time,
                residual: Some(residual.ratio()),
                kinetic_energy: body.particles().kinetic_energy(),
                potential_energy,
                internal_energy: plan.internal_energy.map(|of| of(body.particles())),
                displacement: report.displacement,
            });
        }
        if step == late {
            earlier = Extent::of(&body.particles().positions);
        }
        seen_after(step, time).show(body.particles(), frame, observer)?;
        if observer.after_step(Progress { step, steps }).is_break() {
            return Err(SampleError::Interrupted { step });
        }
        if let Some(watching) = plan.watching.as_mut().filter(|watching| watching.is_due(step, steps)) {
            let ends = watching.look(step, body, frame, spacing).map_err(failed)?;
            if ends && step < steps {
                (steps, ended) = (step, true);
            } else if step < late {
                // Should the next look end the run.
                earlier = Extent::of(&body.particles().positions);
            }
        }
        step += 1;
    }

    let failed = |error| SampleError::in_step(steps, error);
    let drift = earlier.drift_to(&Extent::of(&body.particles().positions));
    let kinetic_energy = body.particles().kinetic_energy();
    let storage_bytes = body.storage_bytes();
    let mut positions = std::mem::take(&mut body.particles().positions);
    let score = &mut body.force().score;
    score.non_finite = NonFiniteScores::Report;
    correct_moments(
        plan.moment_correction,
        f64::INFINITY,
        &mut positions,
        score,
        &mut scores,
    )
    .map_err(failed)?;
    let (evaluations, replaced) = (score.evaluations, score.replaced);
    body.particles().positions = positions;
    let residual = body.residual(&origin, spacing, &scores).map_err(failed)?;
    let particles = body.particles();
    let in_order = particles.in_creation_order(&particles.positions);
    let samples = Samples {
        positions: finite(in_order.iter().map(|z| frame.to_target(z)).collect(), steps)?,
        steps,
        score_evaluations: evaluations,
        scores_replaced: replaced,
        residual: Some(residual.ratio()),
        spacing: Some(spacing),
        active_nodes: Some(active_nodes),
        bodies: Some(1),
        storage_bytes: Some(storage_bytes),
        trace,
        density_evaluations: plan
            .watching
            .as_ref()
            .map_or(0, |watching| watching.density_evaluations),
        watched: plan.watching.map(|watching| Watched {
            ended,
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
