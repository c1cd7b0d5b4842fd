//! The calibrated sampler: an isothermal gas under the score, on a basis that moves, turns and changes its spacing every step.

use mpm_core::{Apic, Flip, Mpm, MpmError, Particles, Pic, StepControl, Transfer, UniformBasis};
use mpm_materials::IsothermalGas;
use parvi_targets::{Frame, Target};

use crate::basis_choice::OnBasis;
use crate::bodies::{InTurn, apportion, union};
use crate::drive::{Plan, PlannedStep, drive};
use crate::framed_score::{FramedScore, ScoreForce};
use crate::kronecker::Kronecker;
use crate::rotation::random_rotation;
use crate::start::{Stream, check, positive, steps};
use crate::stiffness::Stiffness;
use crate::survey::{Site, Survey};
use crate::{MpmOptions, Observer, Run, SampleError, Samples, TransferChoice, defaults};

/// One body, and what every layer of the dispatch hands on.
struct Job<'a, const D: usize> {
    options: &'a MpmOptions,
    target: &'a dyn Target<D>,
    frame: &'a Frame<D>,
    run: &'a Run,
    /// The body's number, for its own random choices.
    body: usize,
    positions: Vec<[f64; D]>,
    observer: &'a mut dyn Observer,
}

impl MpmOptions {
    /// Sample `target`; `frame` is what is known of its place and scales, and the unit of the run's start law.
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
        run.checked_particles()?;
        self.spacing_schedule.check()?;
        self.settling.check()?;
        let start = run.start_positions()?;
        let survey = if self.survey {
            Survey::new(target, frame, run, &start)?
        } else {
            Survey::skipped(frame)
        };
        let start = survey.keeps_start.then_some(start);
        let (sites, mut parts) = self.bodies(target, &survey.sites, run, start, observer)?;
        let mut wasted = 0;
        let clouds: Vec<&[[f64; D]]> = parts.iter().map(|part| part.positions.as_slice()).collect();
        if sites.len() > 1 && Survey::pieces_are_connected(&sites, &clouds) {
            wasted = parts.iter().map(|part| part.score_evaluations).sum();
            (_, parts) = self.bodies(target, std::slice::from_ref(&survey.whole), run, None, observer)?;
        }
        let mut samples = union(parts);
        samples.score_evaluations += survey.evaluations + wasted;
        Ok(samples)
    }

    /// A body for each site, of as many particles as its mass asks for, from `start` or N(0, I) of its frame.
    fn bodies<const D: usize>(
        &self,
        target: &dyn Target<D>,
        sites: &[Site<D>],
        run: &Run,
        mut start: Option<Vec<[f64; D]>>,
        observer: &mut dyn Observer,
    ) -> Result<(Vec<Site<D>>, Vec<Samples<D>>), SampleError> {
        let bodies = apportion(run.particles, sites);
        let mut parts = Vec::with_capacity(bodies.len());
        for (number, (site, count)) in bodies.iter().enumerate() {
            let positions = match start.take() {
                Some(positions) => positions,
                None => run.standard_positions(*count, number)?,
            };
            let default = defaults::spacing::<D>(self.basis, *count) * defaults::tail_factor(site.tails);
            let spacing = positive("spacing", self.spacing, default)?;
            let mut part = site.within(target, |target, frame| {
                let job = Job {
                    options: self,
                    target,
                    frame,
                    run,
                    body: number,
                    positions,
                    observer: &mut InTurn {
                        number,
                        of: bodies.len(),
                        observer: &mut *observer,
                    },
                };
                self.basis.with(spacing, job)
            });
            if let Some(map) = &site.map {
                part = part
                    .map_err(|error| map.explained(error))
                    .and_then(|part| map.samples(part));
            }
            parts.push(part?);
        }
        Ok((bodies.into_iter().map(|(site, _)| site).collect(), parts))
    }
}

impl<const D: usize> OnBasis<D> for Job<'_, D> {
    type Output = Samples<D>;

    fn on<B: UniformBasis<D>>(self, make: impl Fn() -> Result<B, MpmError>) -> Result<Samples<D>, SampleError> {
        match self.options.transfer {
            TransferChoice::Pic => self.run(Pic, make),
            TransferChoice::Apic => self.run(Apic, make),
            TransferChoice::Flip(share) => {
                check("FLIP share", share, (0.0..=1.0).contains(&share), "in [0, 1]")?;
                self.run(Flip { share }, make)
            }
        }
    }
}

impl<const D: usize> Job<'_, D> {
    fn run<B: UniformBasis<D>, T: Transfer<D>>(
        self,
        transfer: T,
        make: impl Fn() -> Result<B, MpmError>,
    ) -> Result<Samples<D>, SampleError> {
        let (options, run) = (self.options, self.run);
        let failed = |error| SampleError::in_step(0, error);
        let (basis, certificate) = (make().map_err(failed)?, make().map_err(failed)?);
        let spacing = basis.spacing();
        let steps = steps(options.steps, defaults::steps(run.particles))?;
        let friction = options.friction.unwrap_or(defaults::FRICTION);
        check(
            "friction",
            friction,
            friction >= 0.0 && friction.is_finite(),
            "at least 0 and finite",
        )?;
        let time_step = positive("time step", options.time_step, defaults::time_step(spacing))?;
        let control = StepControl {
            time_step,
            courant: 1.0,
            displacement: positive("displacement limit", Some(options.displacement_limit), 0.0)?,
            friction,
        };

        let particles = Particles::at_rest(self.positions, 1.0);
        let gas = IsothermalGas::new(1.0)?;
        let mut generator = run.generator(Stream::Places.of_body(self.body));
        let mut places = Kronecker::<D>::new(&mut generator);
        let mut rotations = run.generator(Stream::Rotations.of_body(self.body));
        let (schedule, settling) = (&options.spacing_schedule, &options.settling);
        let plan = Plan {
            steps,
            certificate,
            step: |step| {
                let varies = options.shifts && settling.varies(step, steps);
                let (origin, draw) = if varies { places.next_point() } else { ([0.0; D], 0.5) };
                let factor = schedule.factor(step, steps, draw);
                PlannedStep {
                    origin,
                    spacing: spacing * factor,
                    rotation: (varies && options.rotation).then(|| random_rotation(&mut rotations)),
                    alpha: 1.0,
                    control: StepControl {
                        time_step: time_step * time_factor(spacing, factor) * settling.factor(step, steps),
                        ..control
                    },
                }
            },
            moment_correction: options.moment_correction,
            trace_every: options.trace_every,
        };
        let force = ScoreForce {
            score: FramedScore::new(self.target, self.frame),
            alpha: 1.0,
            location: options.score_location,
            mass_weighted: true,
            mass_floor: 0.0,
            stiffness: Some(Stiffness::default()),
        };
        let body = Mpm::new(particles, basis, transfer, gas, force);
        drive(body, self.frame, plan, self.observer)
    }
}

/// Factor of Δt where the spacing is `factor` h: Δt follows a smaller spacing all the way, for the sake of the displacement limit, and
/// a larger one by the rule for defaults.
fn time_factor(spacing: f64, factor: f64) -> f64 {
    (defaults::time_step(spacing * factor) / defaults::time_step(spacing)).min(factor)
}
