//! What a run gave, in the same form in every dimension.

use parvi::{Certificate, Pool, Samples, TracePoint};

use super::Particles;

/// What a run gave, from the fields of [`Samples`] that are the same in every dimension.
macro_rules! outcome {
    ($($field:ident: $type:ty,)*) => {
        /// What a run gave: the fields of [`Samples`], those that have a dimension as files hold them.
        #[derive(Clone, Debug, Default)]
        pub struct Outcome {
            /// The particles.
            pub particles: Particles,
            /// Everything that was evaluated, weighed, with log p; where the method keeps it.
            pub pool: Option<Particles>,
            /// What a watch saw on the way.
            pub watched: Option<Watched>,
            /// log Z less the target's own, where both are known and whoever ran it has looked.
            pub log_evidence_deviation: Option<f64>,
            /// Time of the sampler alone, in seconds, as whoever ran it has measured it; else 0.
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
