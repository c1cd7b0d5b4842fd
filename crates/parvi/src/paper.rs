//! Algorithms 1 (PIC) and 2 (APIC) of the MPM-ParVI paper: an elastic body under the score.

use mpm_core::{Particles, StepControl};
use mpm_materials::{ElasticModuli, LinearElastic, Material, NeoHookean};
use parvi_targets::{Frame, Target};

use crate::basis_choice::Parts;

use crate::certificate::Certificate;
use crate::checkpoint::Journal;
use crate::compiled::Compiled;
use crate::drive::{Plan, PlannedStep, drive};
use crate::framed_score::{FramedScore, ScoreForce};
use crate::start::{check, positive, steps};
use crate::{
    Elasticity, MomentCorrection, Observer, PaperOptions, Run, SampleError, Samples, TransferChoice, defaults,
};

/// What every layer of the dispatch hands on.
pub(crate) struct Job<'a, const D: usize> {
    pub options: &'a PaperOptions,
    target: &'a dyn Target<D>,
    frame: &'a Frame<D>,
    run: &'a Run,
    material: &'a dyn Material<D>,
    observer: &'a mut dyn Observer,
}

impl PaperOptions {
    /// Run the paper's algorithm on `target` in the coordinates of `frame`.
    ///
    /// Every particle has mass 1/M and reference volume 1/M, so the body's reference density is one.
    ///
    /// # Errors
    /// [`SampleError`]: an option out of range, a score or a deformation that is not finite, or the observer's stop.
    pub fn sample<const D: usize>(
        &self,
        target: &dyn Target<D>,
        frame: &Frame<D>,
        run: &Run,
        observer: &mut dyn Observer,
    ) -> Result<Samples<D>, SampleError> {
        (Compiled::of().paper)(self, target, frame, run, observer)
    }
}

/// [`PaperOptions::sample`].
pub(crate) fn sample<const D: usize>(
    options: &PaperOptions,
    target: &dyn Target<D>,
    frame: &Frame<D>,
    run: &Run,
    observer: &mut dyn Observer,
) -> Result<Samples<D>, SampleError> {
    let moduli = ElasticModuli::new(options.youngs_modulus, options.poissons_ratio)?;
    let (neo_hookean, linear) = (NeoHookean::new(moduli), LinearElastic::new(moduli));
    run.checked_particles()?;
    let default = defaults::spacing::<D>(options.basis, run.particles);
    let spacing = positive("spacing", options.spacing, default)?;
    let job = Job {
        options,
        target,
        frame,
        run,
        material: match options.elasticity {
            Elasticity::NeoHookean => &neo_hookean,
            Elasticity::Linear => &linear,
        },
        observer,
    };
    job.run(spacing)
}

impl<const D: usize> Job<'_, D> {
    fn run(self, spacing: f64) -> Result<Samples<D>, SampleError> {
        let (job, options) = (&self, self.options);
        let steps = steps(options.steps, defaults::PAPER_STEPS)?;
        let optional = |field, value: Option<f64>| value.map_or(Ok(f64::INFINITY), |_| positive(field, value, 0.0));
        let control = StepControl {
            time_step: positive("time step", options.time_step, defaults::time_step(spacing))?,
            courant: optional("Courant number", options.guards.courant)?,
            displacement: optional("displacement limit", options.guards.displacement_limit)?,
            friction: 0.0,
        };
        let alpha = options.annealing.checked()?;

        let positions = job.run.start_positions()?;
        let volumes = vec![1.0 / positions.len() as f64; positions.len()];
        let particles = Particles::at_rest(positions, 1.0).with_elastic_state(volumes);
        let plan = Plan {
            body: 0,
            earlier_steps: 0,
            steps,
            spacing,
            step: |step| PlannedStep {
                origin: [0.0; D],
                spacing,
                rotation: None,
                alpha: alpha.at(step, steps),
                control,
            },
            retries: 0,
            moment_correction: MomentCorrection::Off,
            trace_every: options.trace_every,
        };
        let floor = options.guards.mass_floor;
        check(
            "mass floor",
            floor,
            floor >= 0.0 && floor.is_finite(),
            "at least 0 and finite",
        )?;
        let force = ScoreForce {
            score: FramedScore::new(job.target, job.frame),
            alpha: 1.0,
            location: options.score_location,
            mass_weighted: options.guards.mass_weighted_force,
            mass_floor: floor / job.run.particles as f64,
            stiffness: None,
        };
        let parts = Parts {
            particles,
            force,
            transfer: if options.affine {
                TransferChoice::Apic
            } else {
                TransferChoice::Pic
            },
            basis: options.basis,
            spacing,
        };
        let mut body = (Compiled::of().elastic)(parts, job.material)?;
        let driven = drive(body.as_mut(), job.frame, plan, &mut Journal::none(), self.observer)?;
        let certificate = Some(Certificate::of_scores(&driven, alpha.last()));
        Ok(Samples {
            certificate,
            ..driven.samples
        })
    }
}
