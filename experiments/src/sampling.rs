//! One run of a sampler on a target whose dimension is known at run time.

use std::time::Instant;

use parvi::{Certificate, Method, Observer, Pool, Run, Samples, TracePoint};
use parvi_targets::{CatalogueTarget, Frame};

use crate::CommandError;
use crate::dispatch::on_target;
use crate::options::TargetSpecification;
use crate::output::Particles;

/// What a run gave, from the fields of [`Samples`] that are the same in every dimension.
macro_rules! outcome {
    ($($field:ident: $type:ty,)*) => {
        /// What a run gave: the fields of [`Samples`], those that have a dimension as files hold them.
        #[derive(Clone, Debug, Default)]
        pub struct Outcome {
            /// The particles, all finite.
            pub particles: Particles,
            /// Everything that was evaluated, weighed, with log p; where the method keeps it.
            pub pool: Option<Particles>,
            /// What a watch saw on the way.
            pub watched: Option<Watched>,
            /// log Z less the target's own, where both are known.
            pub log_evidence_deviation: Option<f64>,
            /// Time of the sampler alone, in seconds.
            pub wall_seconds: f64,
            /// The survey after each of its rounds and at its end, where there was one.
            pub survey: Vec<SurveyPoint>,
            $(#[doc = concat!("As `", stringify!($field), "` of [`Samples`].")] pub $field: $type,)*
        }

        impl<const D: usize> From<Samples<D>> for Outcome {
            fn from(samples: Samples<D>) -> Self {
                Self {
                    particles: Particles::from(&samples),
                    survey: samples.pool.as_deref().map_or_else(Vec::new, SurveyPoint::all),
                    pool: samples.pool.map(|pool| {
                        let points = Particles::new(&pool.positions, Some(&pool.weights));
                        points.with_log_densities(pool.log_densities)
                    }),
                    watched: samples.watched.map(Watched::from),
                    $($field: samples.$field,)*
                    ..Self::default()
                }
            }
        }
    };
}

outcome! {
    steps: usize,
    score_evaluations: u64,
    judging_evaluations: u64,
    density_evaluations: u64,
    scores_replaced: u64,
    score_disagreement: Option<f64>,
    residual: Option<f64>,
    spacing: Option<f64>,
    active_nodes: Option<usize>,
    bodies: Option<usize>,
    storage_bytes: Option<usize>,
    divergences: Option<usize>,
    log_evidence: Option<f64>,
    log_evidence_error: Option<f64>,
    pareto_k: Option<f64>,
    unseen: Option<f64>,
    relative_energy_distance: Option<f64>,
    certificate: Option<Certificate>,
    trace: Vec<TracePoint>,
}

/// How far a survey has come.
#[derive(Clone, Copy, Debug)]
pub struct SurveyPoint {
    /// Evaluations of all kinds.
    pub evaluations: u64,
    /// (Σ w)² / Σ w² of what is kept of them.
    pub effective_size: f64,
    /// The same of the last points alone, over their number.
    pub share: f64,
}

impl SurveyPoint {
    /// After each round, and with the fresh points at the end.
    fn all<const D: usize>(pool: &Pool<D>) -> Vec<Self> {
        let rounds = pool.rounds.iter().map(|round| Self {
            evaluations: round.evaluations,
            effective_size: round.effective_size,
            share: round.share,
        });
        let end = Self {
            evaluations: pool.density_evaluations + pool.score_evaluations,
            effective_size: pool.effective_size(),
            share: pool.verdict.effective_share,
        };
        rounds.chain([end]).collect()
    }
}

/// The best configuration of a run, and all looks; as [`parvi::Watched`].
#[derive(Clone, Debug)]
pub struct Watched {
    /// The best configuration.
    pub best: Particles,
    /// Step after which it stood.
    pub best_step: usize,
    /// What the monitor said of it.
    pub best_value: f64,
    /// All looks: the step, and what the monitor said.
    pub history: Vec<(usize, f64)>,
    /// Whether the watch ended the run.
    pub ended: bool,
}

impl Watched {
    /// What the monitor said of the last configuration.
    pub fn last_value(&self) -> f64 {
        self.history.last().map_or(f64::NAN, |look| look.1)
    }
}

impl<const D: usize> From<parvi::Watched<D>> for Watched {
    fn from(seen: parvi::Watched<D>) -> Self {
        Self {
            best: Particles::new(&seen.positions, None),
            best_step: seen.step,
            best_value: seen.value,
            history: seen.history,
            ended: seen.ended,
        }
    }
}

impl Outcome {
    /// Particles that came without steps.
    pub fn of_draws(particles: Particles, wall_seconds: f64) -> Self {
        Self {
            particles,
            wall_seconds,
            ..Self::default()
        }
    }

    /// Evaluations of all kinds that the particles rest on.
    pub fn evaluations(&self) -> u64 {
        self.density_evaluations + self.score_evaluations
    }
}

/// Samples a target of the catalogue.
///
/// # Errors
/// What the target or the sampler refuse; [`CommandError::NotFinite`] if a particle is not finite.
pub fn sample(
    target: &TargetSpecification,
    method: &Method,
    run: &Run,
    observer: &mut dyn Observer,
) -> Result<Outcome, CommandError> {
    on_target!(target, target, D => sample_target::<D>(target.as_ref(), &target.frame(), method, run, observer))
}

/// What work with a target has given, unless the target has failed meanwhile: then everything rests on values that are none.
pub fn unless_failed<T, const D: usize>(
    target: &dyn CatalogueTarget<D>,
    worked: Result<T, CommandError>,
) -> Result<T, CommandError> {
    let failed = |fault| Err(CommandError::Library(Box::new(fault)));
    target.fault().map_or(worked, failed)
}

/// Samples a target that is already built, in a frame.
pub fn sample_target<const D: usize>(
    target: &dyn CatalogueTarget<D>,
    frame: &Frame<D>,
    method: &Method,
    run: &Run,
    observer: &mut dyn Observer,
) -> Result<Outcome, CommandError> {
    let begin = Instant::now();
    let samples = parvi::sample_in::<D>(target, frame, method, run, observer);
    let samples = unless_failed(target, samples.map_err(CommandError::from))?;
    let wall_seconds = begin.elapsed().as_secs_f64();
    let evidence = samples.log_evidence.zip(target.log_evidence());
    let mut outcome = Outcome {
        log_evidence_deviation: evidence.map(|(found, exact)| found - exact),
        wall_seconds,
        ..Outcome::from(samples)
    };
    if let Some(value) = outcome.particles.first_not_finite() {
        return Err(CommandError::NotFinite {
            what: "a particle".to_owned(),
            value,
        });
    }
    for number in [
        &mut outcome.log_evidence,
        &mut outcome.log_evidence_error,
        &mut outcome.log_evidence_deviation,
        &mut outcome.pareto_k,
        &mut outcome.unseen,
        &mut outcome.relative_energy_distance,
        &mut outcome.score_disagreement,
        &mut outcome.residual,
        &mut outcome.spacing,
    ] {
        *number = number.filter(|value| value.is_finite());
    }
    Ok(outcome)
}
