//! The calibrated sampler: an isothermal gas under the score, on a grid whose origin moves every step.

use mpm_core::{Apic, Flip, Mpm, Particles, Pic, SplineGrid, StepControl, Transfer};
use mpm_kernels::{Cubic, Linear, Quadratic, Spline};
use mpm_materials::IsothermalGas;
use parvi_targets::{Frame, Target};
use rand::RngExt;

use crate::drive::{Plan, PlannedStep, drive};
use crate::framed_score::{FramedScore, ScoreForce};
use crate::kronecker::Kronecker;
use crate::start::{check, positive, steps};
use crate::{BasisChoice, MpmOptions, Observer, Run, SampleError, Samples, TransferChoice, defaults};

impl MpmOptions {
    /// Sample `target` in the coordinates of `frame`.
    ///
    /// # Errors
    /// [`SampleError`]: an option out of range, a score that is not finite, or the observer's stop.
    pub fn sample<const D: usize>(
        &self,
        target: &dyn Target<D>,
        frame: &Frame<D>,
        run: &Run,
        observer: &mut dyn Observer,
    ) -> Result<Samples<D>, SampleError> {
        match self.basis {
            BasisChoice::Linear => self.with_spline::<Linear, 2, D>(target, frame, run, observer),
            BasisChoice::Quadratic => self.with_spline::<Quadratic, 3, D>(target, frame, run, observer),
            BasisChoice::Cubic => self.with_spline::<Cubic, 4, D>(target, frame, run, observer),
        }
    }

    fn with_spline<S: Spline<W>, const W: usize, const D: usize>(
        &self,
        target: &dyn Target<D>,
        frame: &Frame<D>,
        run: &Run,
        observer: &mut dyn Observer,
    ) -> Result<Samples<D>, SampleError> {
        match self.transfer {
            TransferChoice::Pic => self.run::<S, Pic, W, D>(Pic, target, frame, run, observer),
            TransferChoice::Apic => self.run::<S, Apic, W, D>(Apic, target, frame, run, observer),
            TransferChoice::Flip(share) => {
                check("FLIP share", share, (0.0..=1.0).contains(&share), "in [0, 1]")?;
                self.run::<S, Flip, W, D>(Flip { share }, target, frame, run, observer)
            }
        }
    }

    fn run<S: Spline<W>, T: Transfer<D>, const W: usize, const D: usize>(
        &self,
        transfer: T,
        target: &dyn Target<D>,
        frame: &Frame<D>,
        run: &Run,
        observer: &mut dyn Observer,
    ) -> Result<Samples<D>, SampleError> {
        let steps = steps(self.steps, defaults::STEPS)?;
        let spacing = positive(
            "spacing",
            self.spacing,
            defaults::spacing::<D>(self.basis, run.particles),
        )?;
        let time_step = positive("time step", self.time_step, defaults::time_step(spacing))?;
        let friction = self.friction.unwrap_or(defaults::FRICTION);
        check(
            "friction",
            friction,
            friction >= 0.0 && friction.is_finite(),
            "at least 0 and finite",
        )?;
        let displacement = positive("displacement limit", Some(self.displacement_limit), 0.0)?;
        let control = StepControl {
            time_step,
            courant: 1.0,
            displacement,
            friction,
        };

        let particles = Particles::at_rest(run.start_positions()?, 1.0);
        let grid = SplineGrid::<S, W, D>::new([0.0; D], spacing).map_err(|e| SampleError::in_step(0, e))?;
        let gas = IsothermalGas::new(1.0)?;
        let mut generator = run.generator(1);
        let mut shifts = Kronecker::new(std::array::from_fn(|_| generator.random::<f64>()));
        let plan = Plan {
            steps,
            spacing,
            step: |step| PlannedStep {
                origin: if self.shifts {
                    shifts.next_point().map(|u| u * spacing)
                } else {
                    [0.0; D]
                },
                alpha: 1.0,
                control: StepControl {
                    time_step: time_step * defaults::settling(step, steps),
                    ..control
                },
            },
            moment_correction: self.moment_correction,
            trace_every: self.trace_every,
        };
        let force = ScoreForce {
            score: FramedScore::new(target, frame),
            alpha: 1.0,
            location: self.score_location,
            mass_weighted: true,
            mass_floor: 0.0,
        };
        let body = Mpm::new(particles, grid, transfer, gas, force);
        drive(body, frame, plan, observer)
    }
}
