//! Algorithms 1 (PIC) and 2 (APIC) of the MPM-ParVI paper: a body of some material under the score.

use mpm_core::{Masses, MpmError, Particles, StepControl};
use mpm_materials::{AnyLaw, Law, Memory, Numbered};
use parvi_body::{Cloud, FramedScore, Moving, NodeScores, Parts, PlannedStep, ScoreForce};
use parvi_targets::{Frame, Target};

use crate::certificate::Certificate;
use crate::checkpoint::Journal;
use crate::drive::{Plan, drive};
use crate::kronecker::Kronecker;
use crate::start::{Stream, check, checked_transfer, not_negative, positive, steps};
use crate::task::Task;
use crate::watching::Watching;
use crate::{
    Coordinates, MomentCorrection, Monitor, Observer, PaperBody, PaperOptions, ReferenceVolumes, Run, SampleError,
    Samples, ScoreLocation, TransferChoice, defaults,
};

/// [`PaperOptions::sample_body`].
pub(crate) fn sample<const D: usize>(
    options: &PaperOptions,
    body: &PaperBody<D>,
    task: Task<'_, D>,
) -> Result<Samples<D>, SampleError> {
    if const { cfg!(not(feature = "paper")) } {
        return Err(SampleError::NotBuilt {
            method: "paper",
            feature: "paper",
        });
    }
    if options.score_location == ScoreLocation::Cached {
        return Err(SampleError::NotTaken {
            method: "paper",
            field: "cached scores: at its nodes every score is evaluated once as it is",
        });
    }
    let follows_log_density = options.watch.is_some_and(|watch| watch.monitor == Monitor::LogDensity);
    if follows_log_density {
        task.needs_log_density("the monitor of log densities")?;
    }
    let (target, frame, run, observer) = task.parts();
    let identity = Frame::identity();
    let limit = options.guards.stretch_limit;
    let expected = "above 1 and finite";
    check(
        "stretch limit",
        limit.unwrap_or(2.0),
        limit.is_none_or(|k| k > 1.0 && k.is_finite()),
        expected,
    )?;
    let mut run_with = |law: &dyn Law<D, State = Memory>| {
        let job = Job {
            options,
            target,
            frame: match options.coordinates {
                Coordinates::Frame => frame,
                Coordinates::Own => &identity,
            },
            run,
            law: AnyLaw {
                law,
                stretch_limit: limit,
            },
        };
        job.run(body.alpha, &mut *observer)
    };
    match (body.law, body.material) {
        (Some(law), _) => run_with(law),
        (None, Some(material)) => run_with(&Numbered(material)),
        (None, None) => options.material.with_law(run_with),
    }
}

/// One run.
struct Job<'a, const D: usize> {
    options: &'a PaperOptions,
    target: &'a dyn Target<D>,
    /// The coordinates of the body.
    frame: &'a Frame<D>,
    run: &'a Run,
    law: AnyLaw<'a, D>,
}

impl<const D: usize> Job<'_, D> {
    fn run(
        &self,
        alpha: Option<&dyn Fn(usize, usize) -> f64>,
        observer: &mut dyn Observer,
    ) -> Result<Samples<D>, SampleError> {
        let options = self.options;
        self.run.checked_particles()?;
        let default = defaults::spacing::<D>(options.basis, self.run.particles);
        let spacing = positive("spacing", options.spacing, default)?;
        let steps = steps(options.steps, defaults::PAPER_STEPS)?;
        let control = self.control(spacing)?;
        let alphas = self.alphas(alpha, steps)?;
        let last_alpha = alphas[steps - 1];
        let mut origins = self.origins()?;

        let mut body = self.body(spacing)?;
        let stored = |particles: &Cloud<D>| -> f64 {
            let of = |p: usize| {
                let density = self
                    .law
                    .energy_density(&particles.deformation_gradients[p], &particles.states[p]);
                particles.reference_volumes[p] * density
            };
            (0..particles.len()).map(of).sum()
        };
        let plan = Plan {
            body: 0,
            earlier_steps: 0,
            steps,
            spacing,
            step: |step| PlannedStep {
                origin: origins(step),
                spacing,
                rotation: None,
                alpha: alphas[step - 1],
                control,
            },
            retries: 0,
            moment_correction: MomentCorrection::Off,
            trace_every: options.trace_every,
            watching: options.watch.map(Watching::new).transpose()?,
            internal_energy: Some(&stored),
        };
        let driven = drive(body.as_mut(), self.frame, plan, &mut Journal::default(), observer)?;
        let certificate = options.certificate.then(|| Certificate::of_scores(&driven, last_alpha));
        let moving = body.force().moving_evaluations;
        Ok(Samples {
            certificate,
            score_evaluations: moving,
            judging_evaluations: driven.samples.score_evaluations - moving,
            ..driven.samples
        })
    }

    fn control(&self, spacing: f64) -> Result<StepControl, SampleError> {
        let (options, guards) = (self.options, &self.options.guards);
        let optional = |field, value: Option<f64>| value.map_or(Ok(f64::INFINITY), |_| positive(field, value, 0.0));
        Ok(StepControl {
            time_step: positive("time step", options.time_step, defaults::time_step(spacing))?,
            courant: optional("Courant number", guards.courant)?,
            displacement: optional("displacement limit", guards.displacement_limit)?,
            friction: not_negative("friction", options.friction)?,
        })
    }

    /// α of every step.
    fn alphas(&self, own: Option<&dyn Fn(usize, usize) -> f64>, steps: usize) -> Result<Vec<f64>, SampleError> {
        let schedule = self.options.annealing.of_either_sign()?;
        let alpha = |step| match own {
            Some(own) => own(step, steps),
            None => schedule.at(step, steps),
        };
        let alphas: Vec<f64> = (1..=steps).map(alpha).collect();
        for &alpha in &alphas {
            check("alpha", alpha, alpha.is_finite(), "finite")?;
        }
        Ok(alphas)
    }

    /// Where the grid of a step has its origin, in coordinates of its unit cell; asked for in order.
    fn origins(&self) -> Result<impl FnMut(usize) -> [f64; D], SampleError> {
        let renewal = self.options.grid_renewal;
        let every = renewal.unwrap_or(usize::MAX);
        check("steps of a grid", every as f64, every >= 1, "at least 1")?;
        let mut places = Kronecker::<D>::new(&mut self.run.generator(Stream::Places.of_body(0)));
        let mut origin = [0.0; D];
        Ok(move |step: usize| {
            if step > 1 && (step - 1).is_multiple_of(every) {
                origin = places.next_point().0;
            }
            origin
        })
    }

    /// The body at its start.
    fn body(&self, spacing: f64) -> Result<Box<dyn Moving<'_, D> + '_>, SampleError> {
        let (options, run) = (self.options, self.run);
        let positions = run.begin(self.frame)?;
        let count = positions.len();
        let mut particles = Particles::at_rest(positions, 1.0);
        if let Some(velocities) = run.given.velocities_in(self.frame) {
            particles.velocities = velocities;
        }
        if let Some(masses) = &run.given.masses {
            particles.masses = Masses::Each(masses.clone());
        }
        let masses = particles.masses.clone();
        let mean_mass = (0..count).map(|p| masses.get(p)).sum::<f64>() / count as f64;
        let volumes = match run.given.reference_volumes_in(self.frame) {
            Some(volumes) => volumes,
            None => self.reference_volumes(&particles)?,
        };
        let virgin = |mass: f64, volume: f64| self.law.virgin(mass / volume);
        let states = volumes
            .iter()
            .enumerate()
            .map(|(p, &volume)| virgin(masses.get(p), volume))
            .collect();
        let floor = not_negative("mass floor", options.guards.mass_floor)?;
        let nodal = options.score_location == ScoreLocation::Nodes;
        let force = ScoreForce {
            location: options.score_location,
            mass_weighted: options.guards.mass_weighted_force,
            masses,
            mass_floor: floor * mean_mass,
            node_scores: (nodal && options.cached_scores).then(NodeScores::default),
            ..ScoreForce::at_particles(FramedScore::new(self.target, self.frame))
        };
        let parts = Parts {
            particles: particles.with_states(volumes, states),
            force,
            transfer: checked_transfer(match (options.affine, options.flip_share) {
                (true, share) => TransferChoice::AffineFlip(share),
                (false, share) => TransferChoice::Flip(share),
            })?,
            basis: options.basis,
            spacing,
        };
        let mut body = parts.of_law(self.law).map_err(|error| SampleError::in_step(0, error))?;
        if options.reference_volumes == ReferenceVolumes::OfGrid && run.given.reference_volumes.is_none() {
            let densities = body.grid_densities(spacing);
            let densities = densities.map_err(|error: MpmError| SampleError::in_step(0, error))?;
            let particles = body.particles();
            for (p, (volume, density)) in particles.reference_volumes.iter_mut().zip(densities).enumerate() {
                let mass = particles.masses.get(p);
                *volume = mass / density;
                particles.states[p] = virgin(mass, *volume);
            }
        }
        Ok(body)
    }

    /// V⁰_p of the options; those of the grid are filled in once there is one.
    fn reference_volumes(&self, particles: &Particles<D>) -> Result<Vec<f64>, SampleError> {
        let count = particles.len();
        if self.options.reference_volumes != ReferenceVolumes::OfStartDensity {
            return Ok(vec![1.0 / count as f64; count]);
        }
        if self.run.given.positions.is_some() {
            return Err(SampleError::NotTaken {
                method: "paper",
                field: "reference volumes of the start's density, which given positions do not have",
            });
        }
        let start = self.run.checked_start()?;
        let variance = start.standard_deviation * start.standard_deviation;
        let norm = (2.0 * std::f64::consts::PI * variance).powf(0.5 * D as f64);
        let volume = |(p, z): (usize, &[f64; D])| {
            let square: f64 = z.iter().map(|c| (c - start.mean) * (c - start.mean)).sum();
            particles.masses.get(p) * norm * (0.5 * square / variance).exp()
        };
        Ok(particles.positions.iter().enumerate().map(volume).collect())
    }
}
