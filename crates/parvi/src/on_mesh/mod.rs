//! The calibrated sampler on a bounded domain: a gas on the hat functions of a mesh, within its wall.

mod frame;
mod start;

use mpm_core::{Basis, MpmError, Particles, StepControl};
use mpm_materials::IsothermalGas;
use mpm_mesh::{SimplexMesh, read_msh};
use parvi_body::{FramedScore, Meshes, MovingOnMesh, PartsOnMesh, ScoreForce, Stiffness};
use parvi_targets::Target;
use rand::{Rng, RngExt};

use self::frame::{frame_of, in_frame};
use crate::drive::finite;
use crate::start::{Stream, not_negative, positive, steps};
use crate::view::Moment;
use crate::{
    MeshOptions, NonFiniteScores, Observer, OnMesh, Progress, Run, SampleError, Samples, TracePoint, defaults,
};

/// Copies of the mesh with moved vertices; the last one serves the residual alone.
const COPIES: usize = 16;

/// [`OnMesh::sample`].
pub(crate) fn sample_on<const D: usize>(
    on_mesh: &OnMesh,
    target: &dyn Target<D>,
    run: &Run,
    observer: &mut dyn Observer,
) -> Result<Samples<D>, SampleError> {
    let refused = |reason: String| SampleError::MeshFile {
        path: on_mesh.file.clone(),
        reason,
    };
    if const { D == 2 || D == 3 } {
        let bytes = std::fs::read(&on_mesh.file).map_err(|error| refused(format!("cannot be read: {error}")))?;
        let mesh = read_msh::<D>(&bytes).map_err(|error| refused(error.to_string()))?;
        on_mesh.options.sample(target, &mesh, run, observer)
    } else {
        Err(refused(format!("a mesh has 2 or 3 dimensions, the target has {D}")))
    }
}

impl MeshOptions {
    /// Sample the density of `target` within `mesh`: p(x) on the mesh, zero outside. The run's start law is not used: particles begin evenly spread over the mesh.
    ///
    /// The residual is that of the hat functions which vanish on the boundary.
    ///
    /// # Errors
    /// [`SampleError`]: a mesh of more than three dimensions, an option out of range, a score that is not finite, or the observer's stop.
    pub fn sample<const D: usize>(
        &self,
        target: &dyn Target<D>,
        mesh: &SimplexMesh<D>,
        run: &Run,
        observer: &mut dyn Observer,
    ) -> Result<Samples<D>, SampleError> {
        self.settling.check()?;
        let count = run.particles_of("mpm on a mesh")?;
        let frame = frame_of(mesh);
        let mesh = in_frame(mesh, &frame)?;
        let mut generator = run.generator(Stream::Places.of_body(0));
        let copies = if self.shifts { COPIES } else { 1 };
        let meshes = Meshes::new(&mesh, copies, &mut generator)?;

        let spacing = meshes.spacing();
        let time_step = positive("time step", self.time_step, defaults::time_step(spacing))?;
        let steps = steps(self.steps, self.default_steps(&mesh, time_step, count))?;
        let friction = not_negative("friction", self.friction.unwrap_or(defaults::FRICTION))?;
        let displacement = positive("displacement limit", Some(self.displacement_limit), 0.0)?;

        let mut score = FramedScore::new(target, &frame);
        score.non_finite = self.non_finite_scores;
        let force = ScoreForce {
            stiffness: Some(Stiffness::default()),
            ..ScoreForce::at_particles(score)
        };
        let start = start::uniform_in(&mesh, count, &mut run.generator(Stream::Start.of_body(0)));
        let parts = PartsOnMesh {
            particles: Particles::at_rest(start, 1.0),
            force,
            meshes,
        };
        let body = parts.of_gas(IsothermalGas::new(1.0)?);
        let mut body = body.ok_or_else(|| SampleError::Unsupported {
            method: "mpm on a mesh",
            target: format!("in {D} dimensions"),
            needs: "a mesh of at most 3 dimensions",
        })?;
        let mut trace = Vec::new();
        let mut time = 0.0;
        let seen_after = |step, time| Moment {
            step,
            steps,
            time,
            ..Moment::default()
        };
        seen_after(0, time).show(body.particles(), &frame, observer)?;
        for step in 1..=steps {
            let failed = |error| SampleError::in_step(step, error);
            let copy = self.choice(step, steps, &mut generator);
            let stiffness = body.force().stiffness.as_ref();
            let control = StepControl {
                time_step: (time_step * self.settling.factor(step, steps))
                    .min(stiffness.map_or(f64::INFINITY, Stiffness::time_limit)),
                courant: 1.0,
                displacement,
                friction,
            };
            let report = body.step(copy, &control).map_err(failed)?;
            time += report.time_step;
            if self.trace_every > 0 && (step % self.trace_every == 0 || step == 1) {
                let positions = body.particles().positions.clone();
                trace.push(TracePoint {
                    step,
                    time,
                    residual: Some(residual(body.as_mut(), &positions).map_err(failed)?),
                    kinetic_energy: body.particles().kinetic_energy(),
                    internal_energy: None,
                    potential_energy: body.force().score.potential_energy(&positions),
                    displacement: report.displacement,
                });
            }
            seen_after(step, time).show(body.particles(), &frame, observer)?;
            if observer.after_step(Progress { step, steps }).is_break() {
                return Err(SampleError::Interrupted { step });
            }
        }
        body.force().score.non_finite = NonFiniteScores::Report;
        let positions = body.particles().positions.clone();
        let residual = residual(body.as_mut(), &positions).map_err(|error| SampleError::in_step(steps, error))?;
        let in_order = body.particles().in_creation_order(&positions);
        let (evaluations, replaced) = (body.force().score.evaluations, body.force().score.replaced);
        Ok(Samples {
            positions: finite(in_order.iter().map(|z| frame.to_target(z)).collect(), steps)?,
            steps,
            score_evaluations: evaluations,
            scores_replaced: replaced,
            residual: Some(residual),
            spacing: Some(spacing),
            active_nodes: Some(body.node_count()),
            bodies: Some(1),
            storage_bytes: Some(body.storage_bytes()),
            trace,
            ..Samples::default()
        })
    }

    /// Which of the meshes a step takes: any of the copies but the last while the basis varies.
    fn choice(&self, step: usize, steps: usize, generator: &mut impl Rng) -> usize {
        if self.shifts && self.settling.varies(step, steps) {
            generator.random_range(0..COPIES)
        } else {
            0
        }
    }
}

impl MeshOptions {
    /// N with Σ Δt = 4 L before settling, L the diagonal of the mesh's bounding box: the sound of the gas has speed one.
    fn default_steps<const D: usize>(&self, mesh: &SimplexMesh<D>, time_step: f64, count: usize) -> usize {
        let axis = |a: usize| {
            let along = || mesh.vertices().iter().map(|x| x[a]);
            along().fold(f64::NEG_INFINITY, f64::max) - along().fold(f64::INFINITY, f64::min)
        };
        let diagonal = (0..D).map(|a| axis(a).powi(2)).sum::<f64>().sqrt();
        let moving = CROSSINGS * diagonal / time_step / (1.0 - self.settling.share);
        (moving.ceil() as usize).max(defaults::steps(count))
    }
}

/// The residual of the particles relative to independent draws.
fn residual<const D: usize>(body: &mut dyn MovingOnMesh<'_, D>, positions: &[[f64; D]]) -> Result<f64, MpmError> {
    let mut scores = vec![[0.0; D]; positions.len()];
    body.force().score.evaluate(positions, &mut scores)?;
    Ok(body.residual(&scores)?.ratio())
}

/// Times that the gas could cross the mesh before settling begins.
const CROSSINGS: f64 = 4.0;
