//! The loop around the step, shared by the calibrated sampler and the paper's algorithms.

use mpm_core::{Medium, Mpm, StepControl, Transfer, UniformBasis};
use mpm_tensor::Matrix;
use parvi_targets::Frame;

use crate::framed_score::ScoreForce;
use crate::moment_correction::correct_moments;
use crate::residual::galerkin_stein_residual;
use crate::{MomentCorrection, Observer, Progress, SampleError, Samples, TracePoint};

/// One step of a plan.
pub(crate) struct PlannedStep<const D: usize> {
    /// Where the basis has its origin, in coordinates of its unit cell.
    pub origin: [f64; D],
    /// Spacing h.
    pub spacing: f64,
    /// Turn of the basis.
    pub rotation: Option<Matrix<D>>,
    /// Factor α of the score.
    pub alpha: f64,
    /// Limits of the step.
    pub control: StepControl,
}

/// What the loop is to do.
pub(crate) struct Plan<B, P> {
    /// Steps.
    pub steps: usize,
    /// What residuals are measured on: a basis like the body's, of the plan's central spacing.
    pub certificate: B,
    /// The step with a number, from 1; asked for in order.
    pub step: P,
    /// The last move.
    pub moment_correction: MomentCorrection,
    /// Record the state every so many steps (0: never).
    pub trace_every: usize,
}

/// Run `body` as planned; its particles are in frame coordinates, the result in the target's.
pub(crate) fn drive<B, T, M, P, const D: usize>(
    mut body: Mpm<D, B, T, M, ScoreForce<'_, D>>,
    frame: &Frame<D>,
    mut plan: Plan<B, P>,
    observer: &mut dyn Observer,
) -> Result<Samples<D>, SampleError>
where
    B: UniformBasis<D>,
    T: Transfer<D>,
    M: Medium<D>,
    P: FnMut(usize) -> PlannedStep<D>,
{
    let (steps, mut certificate) = (plan.steps, plan.certificate);
    let spacing = certificate.spacing();
    let mut scores = vec![[0.0; D]; body.particles.len()];
    let mut trace = Vec::new();
    let (mut time, mut active_nodes, mut origin) = (0.0, 0, [0.0; D]);
    for step in 1..=steps {
        let failed = |error| SampleError::in_step(step, error);
        let mut planned = (plan.step)(step);
        if let Some(rotation) = &planned.rotation {
            body.basis.turn(rotation);
        }
        origin = planned.origin;
        let point = body.basis.cell_point(&origin, planned.spacing);
        body.basis.place(point, planned.spacing).map_err(failed)?;
        body.body_force.alpha = planned.alpha;
        if let Some(stiffness) = &body.body_force.stiffness {
            planned.control.time_step = planned.control.time_step.min(stiffness.time_limit());
        }
        let report = body.step(&planned.control).map_err(failed)?;
        if let Some(stiffness) = &mut body.body_force.stiffness {
            stiffness.update(body.basis.schedule().order());
        }
        time += report.time_step;
        active_nodes = report.active_nodes;
        if plan.trace_every > 0 && (step % plan.trace_every == 0 || step == 1) {
            let positions = &body.particles.positions;
            let score = &mut body.body_force.score;
            score.evaluate(positions, &mut scores).map_err(failed)?;
            away_from(&mut certificate, &origin, spacing).map_err(failed)?;
            let residual = galerkin_stein_residual(&mut certificate, positions, &scores).map_err(failed)?;
            trace.push(TracePoint {
                step,
                time,
                residual: Some(residual.ratio()),
                kinetic_energy: body.particles.kinetic_energy(),
                potential_energy: Some(score.potential_energy(positions)),
                displacement: report.displacement,
            });
        }
        if observer.after_step(Progress { step, steps }).is_break() {
            return Err(SampleError::Interrupted { step });
        }
    }

    let failed = |error| SampleError::in_step(steps, error);
    let storage_bytes = body.storage_bytes();
    let score = &mut body.body_force.score;
    let positions = &mut body.particles.positions;
    correct_moments(plan.moment_correction, positions, score, &mut scores).map_err(failed)?;
    away_from(&mut certificate, &origin, spacing).map_err(failed)?;
    let residual = galerkin_stein_residual(&mut certificate, positions, &scores).map_err(failed)?;
    let score_evaluations = score.evaluations;
    let in_order = body.particles.in_creation_order(&body.particles.positions);
    Ok(Samples {
        positions: finite(in_order.iter().map(|z| frame.to_target(z)).collect(), steps)?,
        weights: None,
        steps,
        score_evaluations,
        residual: Some(residual.ratio()),
        spacing: Some(spacing),
        active_nodes: Some(active_nodes),
        bodies: Some(1),
        storage_bytes: Some(storage_bytes),
        divergences: None,
        trace,
    })
}

/// Put the certificate's basis where the particles were not moved: half a cell off the step's origin.
fn away_from<const D: usize>(
    certificate: &mut impl UniformBasis<D>,
    origin: &[f64; D],
    spacing: f64,
) -> Result<(), mpm_core::MpmError> {
    let point = certificate.cell_point(&origin.map(|c| (c + 0.5).fract()), spacing);
    certificate.place(point, spacing)
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
