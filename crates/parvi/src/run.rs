//! What every sampler takes and returns.

use std::ops::ControlFlow;
use std::path::PathBuf;

use mpm_core::MpmError;
use parvi_pool::{Pool, PoolError};
use serde::{Deserialize, Serialize};

use crate::{Certificate, GivenParticles, ParticleView, PointSetError};

/// Size, seed and start of a run; the same for every method.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// Number of particles M ≥ 2.
    pub particles: usize,
    /// Seed of every random choice of the run.
    pub seed: u64,
    /// Where the particles begin.
    pub start: Start,
    /// What is given of them instead of drawn.
    pub given: GivenParticles,
}

impl Run {
    /// A run from the default start.
    pub fn new(particles: usize, seed: u64) -> Self {
        Self {
            particles,
            seed,
            start: Start::default(),
            given: GivenParticles::default(),
        }
    }
}

/// The particles' initial law, in the coordinates z of the target's frame: z ~ N(mean · 1, sd² I).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// Mean of every coordinate, in target scales.
    pub mean: f64,
    /// Standard deviation of every coordinate, in target scales; > 0.
    pub standard_deviation: f64,
    /// How the law is drawn from.
    pub draws: StartDraws,
}

/// How particles are drawn from their initial law.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StartDraws {
    /// Scrambled Sobol points through the normal quantile: a quiet start. What is uneven at lengths below the spacing the
    /// mechanics hardly sees and would have to smooth over many steps; quasi-random points are even there from the start.
    #[default]
    QuasiRandom,
    /// Independent draws.
    Independent,
}

impl Default for Start {
    fn default() -> Self {
        Self {
            mean: 0.0,
            standard_deviation: 1.0,
            draws: StartDraws::default(),
        }
    }
}

/// What a run returns.
#[derive(Clone, Debug, Default)]
pub struct Samples<const D: usize> {
    /// Particle positions in the target's own coordinates, in the order in which the particles were started.
    ///
    /// Those of a target with [`Constraints`](crate::Constraints) are the unconstrained ones, here and in all that is said below, certificate and pool included. `constraints.constrain_all(&positions)` has
    /// the particles, and `pool.expectation(|y| constraints.constrain(y)[0])` the expectation of a parameter with its error.
    pub positions: Vec<[f64; D]>,
    /// Weights that sum to one; `None` when all are equal.
    pub weights: Option<Vec<f64>>,
    /// Steps taken.
    pub steps: usize,
    /// Evaluations of the score at one point, in total.
    pub score_evaluations: u64,
    /// Evaluations of the score at one point that only judge the particles of the paper's algorithms (trace, residual, certificate) and are not among the others.
    pub judging_evaluations: u64,
    /// Evaluations of the log density at one point, in total; `nuts` has log p with every score, which is counted there.
    pub density_evaluations: u64,
    /// Scores of moving particles that were not finite and have been replaced ([`NonFiniteScores::PullBack`](crate::NonFiniteScores::PullBack)). Those of a survey are among
    /// [`Pool::values_replaced`]; `smc` takes them for zero and counts none. With cached scores: evaluations that gave none.
    pub scores_replaced: u64,
    /// With cached scores: root of the mean square of their difference from fresh ones at the particles, in units of one over the particles' standard deviation; NaN where a fresh one is not finite.
    pub score_disagreement: Option<f64>,
    /// Galerkin–Stein residual relative to its value for i.i.d. draws (1 = as good as i.i.d.; smaller is better).
    pub residual: Option<f64>,
    /// Spacing h in the frame's units: the central one, where it varies.
    pub spacing: Option<f64>,
    /// Nodes with mass in the last step.
    pub active_nodes: Option<usize>,
    /// Bodies that moved.
    pub bodies: Option<usize>,
    /// Bytes held by particles and grid at the end of the run.
    pub storage_bytes: Option<usize>,
    /// Trajectories of a Markov chain that left the level of energy, the warm-up's not counted; where the method has such.
    pub divergences: Option<usize>,
    /// log Z of the target's normalising constant Z, where the method estimates it.
    pub log_evidence: Option<f64>,
    /// Its standard error.
    pub log_evidence_error: Option<f64>,
    /// Shape k̂ of the tail of the importance weights, where there are such and they have one: above 0.7 nothing that rests on them is to be relied on.
    pub pareto_k: Option<f64>,
    /// The share of a wide law from which a piece of the target would have to be seen to be known of with 95 % confidence ([`Pool::unseen`]), where the method searches
    /// for pieces.
    pub unseen: Option<f64>,
    /// The squared energy distance from the target over what M independent draws have in expectation, as far as the pool knows the target, where there is one and masses are equal: that from the pool,
    /// and that of the pool by how far its independent parts are apart ([`EnergyDistance::noise`](parvi_pool::EnergyDistance::noise)).
    pub relative_energy_distance: Option<f64>,
    /// The weighted pool, where the method has one.
    pub pool: Option<Box<Pool<D>>>,
    /// How good the particles are, as far as the method can tell.
    pub certificate: Option<Certificate>,
    /// History, one entry every `trace_every` steps.
    pub trace: Vec<TracePoint>,
    /// What a watch saw on the way, where there was one.
    pub watched: Option<Watched<D>>,
}

/// What a [`Watch`](crate::Watch) saw of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Watched<const D: usize> {
    /// Step after which the configuration was the best; 0: that of the start.
    pub step: usize,
    /// What the monitor said of it.
    pub value: f64,
    /// Its positions, as [`Samples::positions`].
    pub positions: Vec<[f64; D]>,
    /// All looks: the step, and what the monitor said.
    pub history: Vec<(usize, f64)>,
    /// Whether the watch ended the run: the monitor had stopped getting better.
    pub ended: bool,
}

impl<const D: usize> Default for Watched<D> {
    fn default() -> Self {
        Self {
            step: 0,
            value: f64::INFINITY,
            positions: Vec::new(),
            history: Vec::new(),
            ended: false,
        }
    }
}

/// State of a run at one step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TracePoint {
    /// Step number, from 1.
    pub step: usize,
    /// Pseudo-time Σ Δt.
    pub time: f64,
    /// Residual relative to i.i.d. draws, where it was measured in this step.
    pub residual: Option<f64>,
    /// ½ Σ m |v|² (total mass 1), in frame coordinates.
    pub kinetic_energy: f64,
    /// −E\[log p\] over the particles, in frame coordinates, up to a constant of the target; where it was measured.
    pub potential_energy: Option<f64>,
    /// Σ V⁰ Ψ(F), the energy stored in the body (total mass 1), where its material stores one.
    pub internal_energy: Option<f64>,
    /// Largest displacement of a node in this step, in units of h.
    pub displacement: f64,
}

/// Progress of a part of a run, handed to the observer after every step of it: a round of a survey, a step of a body, a temperature of `smc`, a draw of `nuts`, a choice of `stein-thinning`. A run of
/// `mpm` has a survey and, where the pool needs evening out, bodies after it, and each of these counts from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Steps of this part that are done.
    pub step: usize,
    /// Steps of this part in all, at most: of a survey as many rounds as its evaluations would do for, which changes from one to the next; of `smc`, which does not know, one more as long as it goes on.
    pub steps: usize,
}

/// Watches a run; a return of `Break` stops it with [`SampleError::Interrupted`].
pub trait Observer {
    /// Called after every step, and after every round of a survey. The default goes on.
    fn after_step(&mut self, _progress: Progress) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    /// Called now and then while a survey evaluates a density that takes long: so many evaluations of all kinds so far, of so many at most as far as is known by then. A run that
    /// is stopped here has kept them all in its checkpoint, if it has one. The default goes on.
    fn evaluated(&mut self, _evaluations: u64, _limit: u64) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    /// Called with the particles where a body begins and after every step that moved them, before [`after_step`](Self::after_step).
    ///
    /// `mpm` shows the bodies that move from the start, or even out what was condensed from a pool; `mpm` on a mesh, the paper's methods, `svgd` and `support-points`
    /// show their particles. Methods that do not move particles (`iid`, `sobol`, `nuts`, `stein-thinning`, `ais`, and `mpm` where the pool needs no evening out) show none:
    /// their only picture is [`Samples::positions`].
    ///
    /// Who does not look pays nothing: the view computes what it is asked for. The default looks at nothing.
    fn see(&mut self, _particles: &ParticleView<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

/// Watches nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Silent;

impl Observer for Silent {}

impl SampleError {
    /// The same failure, said of a step of a run.
    pub(crate) fn in_step(step: usize, error: MpmError) -> Self {
        match error {
            MpmError::BodyForceNotFinite { position, value, .. } => Self::ScoreNotFinite {
                step,
                position,
                score: value,
            },
            source => Self::Mechanics { step, source },
        }
    }
}

/// Why a run could not give particles.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SampleError {
    /// An option is outside its range.
    #[error("{field} = {value}: must be {expected}")]
    InvalidOption {
        /// The option's name.
        field: &'static str,
        /// The value given.
        value: f64,
        /// What is allowed.
        expected: &'static str,
    },
    /// A list of given particles does not fit their number.
    #[error("{field}: the length is {length}, where the number of particles is {particles} and each needs {columns}")]
    GivenLength {
        /// What is given.
        field: &'static str,
        /// Numbers given.
        length: usize,
        /// M.
        particles: usize,
        /// Numbers per particle.
        columns: usize,
    },
    /// A given number is outside its range.
    #[error("{field}: particle {particle} has {value}, must be {expected}")]
    GivenValue {
        /// What is given.
        field: &'static str,
        /// Number of the particle, from 0.
        particle: usize,
        /// The value given.
        value: f64,
        /// What is allowed.
        expected: &'static str,
    },
    /// A method does not take what is given of the particles.
    #[error("method `{method}` does not take {field}")]
    NotTaken {
        /// Method.
        method: &'static str,
        /// What is given.
        field: &'static str,
    },
    /// Start positions that lie in a plane, from which a survey has no first proposal.
    #[error(
        "start positions have no spread along some direction: a survey begins with the normal law of their mean and covariance"
    )]
    StartWithoutSpread,
    /// The target gave a score that is not finite.
    #[error("step {step}: the score of the target at x = {position:?} is {score:?}, which is not finite")]
    ScoreNotFinite {
        /// Step in which it happened.
        step: usize,
        /// Where the score was evaluated.
        position: Vec<f64>,
        /// What the target returned.
        score: Vec<f64>,
    },
    /// The positions stopped being finite.
    #[error("the particles are no longer finite after step {step}: {reason}")]
    Diverged {
        /// Step in which it happened.
        step: usize,
        /// What went out of bounds.
        reason: String,
    },
    /// The method needs what the target does not have.
    #[error("method `{method}` needs {needs}, which target `{target}` does not have")]
    Unsupported {
        /// Method.
        method: &'static str,
        /// Target.
        target: String,
        /// The missing capability.
        needs: &'static str,
    },
    /// The method needs log p, and only the score is known.
    #[error("{method} needs log p, and of this target only the score is known")]
    ScoreOnly {
        /// What needs it.
        method: &'static str,
    },
    /// The mechanics refused the state.
    #[error("step {step}: {source}")]
    Mechanics {
        /// Step in which it happened.
        step: usize,
        /// What it said.
        source: MpmError,
    },
    /// The elastic law refused its parameters.
    #[error(transparent)]
    Material(#[from] mpm_materials::ParameterError),
    /// The log density is not finite where a Markov chain begins.
    #[error("the log density of the target at the start x = {position:?} is {value}, which is not finite")]
    StartNotFinite {
        /// Where the chain was to begin.
        position: Vec<f64>,
        /// What the target returned.
        value: f64,
    },
    /// A Markov chain could not begin or go on.
    #[error("chain {chain}: {reason}")]
    Chain {
        /// Number of the chain, from 0.
        chain: usize,
        /// What the sampler said.
        reason: String,
    },
    /// The mesh to sample on cannot be used.
    #[cfg(feature = "mesh")]
    #[error("mesh: {0}")]
    Mesh(#[from] mpm_mesh::MeshError),
    /// The file of a mesh cannot be read.
    #[error("mesh {}: {reason}", path.display())]
    MeshFile {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// A sample could not be condensed into fewer points.
    #[error(transparent)]
    PointSet(#[from] PointSetError),
    /// A checkpoint cannot be written, read or gone on from.
    #[error("checkpoint {}: {reason}", path.display())]
    Checkpoint {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// Nothing could be weighed.
    #[error(transparent)]
    Pool(#[from] PoolError),
    /// Temperatures of tempered populations did not end: the target is improper, or too far away.
    #[error(
        "{temperatures} temperatures have not led from the start to the target: its integral is not finite, or it is too far from where the frame and the start say"
    )]
    TooFar {
        /// How many were tried.
        temperatures: usize,
    },
    /// The method is not part of this build.
    #[error("method `{method}`: built without {feature}: rebuild with --features {feature}")]
    NotBuilt {
        /// Method.
        method: &'static str,
        /// The cargo feature that it needs.
        feature: &'static str,
    },
    /// The observer stopped the run.
    #[error("interrupted after step {step}")]
    Interrupted {
        /// Steps done, as [`Progress::step`] counts them.
        step: usize,
    },
}

impl SampleError {
    /// The step in which a run ended, where it ended in one.
    pub fn step(&self) -> Option<usize> {
        match self {
            Self::ScoreNotFinite { step, .. }
            | Self::Diverged { step, .. }
            | Self::Mechanics { step, .. }
            | Self::Interrupted { step } => Some(*step),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_of_a_step_says_which() {
        let reason = String::new();
        assert_eq!(SampleError::Diverged { step: 3, reason }.step(), Some(3));
        assert_eq!(SampleError::StartWithoutSpread.step(), None);
    }
}
