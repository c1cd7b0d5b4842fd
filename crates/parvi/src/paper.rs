//! Algorithms 1 (PIC) and 2 (APIC) of the MPM-ParVI paper: an elastic body under the score.

use mpm_core::{Apic, Elastic, Mpm, Particles, Pic, SplineGrid, StepControl, Transfer};
use mpm_kernels::{Cubic, Linear, Quadratic, Spline};
use mpm_materials::{ElasticModuli, LinearElastic, Material, NeoHookean};
use parvi_targets::{Frame, Target};

use crate::drive::{Plan, PlannedStep, drive};
use crate::framed_score::{FramedScore, ScoreForce};
use crate::start::{check, positive, steps};
use crate::{Annealing, BasisChoice, Elasticity, Observer, PaperOptions, Run, SampleError, Samples, defaults};

/// What every layer of the dispatch hands on.
struct Job<'a, const D: usize> {
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
        let moduli = ElasticModuli::new(self.youngs_modulus, self.poissons_ratio)?;
        let (neo_hookean, linear) = (NeoHookean::new(moduli), LinearElastic::new(moduli));
        let job = Job {
            target,
            frame,
            run,
            material: match self.elasticity {
                Elasticity::NeoHookean => &neo_hookean,
                Elasticity::Linear => &linear,
            },
            observer,
        };
        match self.basis {
            BasisChoice::Linear => self.with_spline::<Linear, 2, D>(job),
            BasisChoice::Quadratic => self.with_spline::<Quadratic, 3, D>(job),
            BasisChoice::Cubic => self.with_spline::<Cubic, 4, D>(job),
        }
    }

    fn with_spline<S: Spline<W>, const W: usize, const D: usize>(
        &self,
        job: Job<D>,
    ) -> Result<Samples<D>, SampleError> {
        if self.affine {
            self.run::<S, Apic, W, D>(Apic, job)
        } else {
            self.run::<S, Pic, W, D>(Pic, job)
        }
    }

    fn run<S: Spline<W>, T: Transfer<D>, const W: usize, const D: usize>(
        &self,
        transfer: T,
        job: Job<D>,
    ) -> Result<Samples<D>, SampleError> {
        let steps = steps(self.steps, defaults::PAPER_STEPS)?;
        let spacing = positive(
            "spacing",
            self.spacing,
            defaults::spacing::<D>(self.basis, job.run.particles),
        )?;
        let optional = |field, value: Option<f64>| value.map_or(Ok(f64::INFINITY), |_| positive(field, value, 0.0));
        let control = StepControl {
            time_step: positive("time step", self.time_step, defaults::time_step(spacing))?,
            courant: optional("Courant number", self.guards.courant)?,
            displacement: optional("displacement limit", self.guards.displacement_limit)?,
            friction: 0.0,
        };
        let alpha = self.annealing.checked()?;

        let positions = job.run.start_positions()?;
        let volumes = vec![1.0 / positions.len() as f64; positions.len()];
        let particles = Particles::at_rest(positions, 1.0).with_elastic_state(volumes);
        let grid = SplineGrid::<S, W, D>::new([0.0; D], spacing).map_err(|e| SampleError::in_step(0, e))?;
        let plan = Plan {
            steps,
            spacing,
            step: |step| PlannedStep {
                origin: [0.0; D],
                alpha: alpha.at(step, steps),
                control,
            },
            moment_correction: false,
            trace_every: self.trace_every,
        };
        let floor = self.guards.mass_floor;
        check(
            "mass floor",
            floor,
            floor >= 0.0 && floor.is_finite(),
            "at least 0 and finite",
        )?;
        let force = ScoreForce {
            score: FramedScore::new(job.target, job.frame),
            alpha: 1.0,
            location: self.score_location,
            mass_weighted: self.guards.mass_weighted_force,
            mass_floor: floor / job.run.particles as f64,
        };
        let medium = Elastic { material: job.material };
        drive(
            Mpm::new(particles, grid, transfer, medium, force),
            job.frame,
            plan,
            job.observer,
        )
    }
}

impl Annealing {
    /// The same schedule, if every α is positive and finite.
    fn checked(self) -> Result<Self, SampleError> {
        let (from, to) = match self {
            Self::Constant(alpha) => (alpha, alpha),
            Self::Geometric { from, to } => (from, to),
        };
        positive("alpha", Some(from), 0.0)?;
        positive("alpha", Some(to), 0.0)?;
        Ok(self)
    }

    /// α in step `step` of `steps`, counted from 1.
    fn at(self, step: usize, steps: usize) -> f64 {
        match self {
            Self::Constant(alpha) => alpha,
            Self::Geometric { from, to } => {
                let progress = (step - 1) as f64 / (steps - 1).max(1) as f64;
                from.powf(1.0 - progress) * to.powf(progress)
            }
        }
    }
}
