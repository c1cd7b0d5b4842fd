use parvi_body::{BasisChoice, NonFiniteScores, ScoreLocation, TransferChoice};

use super::with_defaults::with_defaults;
use super::{Annealing, Settling, SpacingSchedule};
use crate::Checkpoint;

/// What the affine Stein correction puts right at the end of a run (docs/theory.md, Eq. 12).
///
/// After a survey of a target that is nearly normal particles first get the covariance of what was weighed, as far as weights know it, but for [`Off`](Self::Off).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MomentCorrection {
    /// Nothing.
    Off,
    /// The mean: E\[s\] = 0.
    #[default]
    Mean,
    /// Mean and covariance: E\[s\] = 0 and E\[s (x − x̄)ᵀ\] = −I. The best M points for expectations at large are a little
    /// narrower than the target, so this raises the energy distance at small M.
    Affine,
}

with_defaults! {
    /// Options of the calibrated sampler; `None` means: chosen by the rule in [`crate::defaults`].
    #[derive(Clone, Debug, PartialEq)]
    pub struct MpmOptions {
        /// Background basis.
        pub basis: BasisChoice = BasisChoice::default(),
        /// Velocity transfer.
        pub transfer: TransferChoice = TransferChoice::default(),
        /// Spacing h in frame units; > 0.
        pub spacing: Option<f64> = None,
        /// How the spacing varies around h from step to step.
        pub spacing_schedule: SpacingSchedule = SpacingSchedule::default(),
        /// Weigh evaluations of the log density until they represent the target, condense M particles from them, and let the material even these out as
        /// far as that brings them nearer. Without, a body moves in the given frame from the given start, and nothing knows whether it has found everything.
        pub survey: bool = true,
        /// Evaluations of all kinds that the survey is planned with, ≥ 1; [`PoolOptions`](parvi_pool::PoolOptions) says what is evaluated in any case, and has the default for `None`. With cached scores: evaluations from which on
        /// the grid is not refined any more.
        pub evaluations: Option<u64> = None,
        /// How many times as much a survey draws in search of pieces that no proposal has met, as far as the evaluations last; ≥ 1.
        pub search_effort: f64 = 1.0,
        /// Steps of a round, settling included; ≥ 1.
        pub steps: Option<usize> = None,
        /// Rounds, at most. After a survey a round evens out what is condensed, and another one follows while that helps (0: none, and moments as they are; default 4 where there are more than
        /// [`LARGEST_POOL`](crate::defaults::LARGEST_POOL) particles or the pool is noisy, else none). Without one (≥ 1) another one follows while
        /// the particles are still on their way, in a frame of their own if they have outgrown the old one, and at half of the spacing where the target is rough (docs/theory.md, §14); default 3,
        /// but one where `steps` are given.
        pub rounds: Option<usize> = None,
        /// Time step Δt at the central spacing; > 0. It follows the spacing drawn, and is shortened where the target is stiff.
        pub time_step: Option<f64> = None,
        /// Friction γ ≥ 0 (v ← v e^{−γΔt}).
        pub friction: Option<f64> = None,
        /// Let the basis vary from step to step: its origin, its spacing within the range of `spacing_schedule`, and with `rotation`
        /// its orientation. Without, one basis at the central spacing serves the whole run.
        pub shifts: bool = true,
        /// Turn the lattice by another random orthogonal matrix in every step that varies it; splines keep their axes.
        pub rotation: bool = true,
        /// How the run ends.
        pub settling: Settling = Settling::default(),
        /// The last move, made by all particles together.
        pub moment_correction: MomentCorrection = MomentCorrection::default(),
        /// Where the score is evaluated.
        pub score_location: ScoreLocation = ScoreLocation::default(),
        /// What is done about a particle whose score is not finite. With a survey one that cannot be helped costs the polish, not the run, unless it is to be reported.
        pub non_finite_scores: NonFiniteScores = NonFiniteScores::default(),
        /// Largest displacement per step in units of h; > 0.
        pub displacement_limit: f64 = 0.5,
        /// Factor α of the score before settling begins (the paper's annealing); the stationary density is p^α for its last value.
        pub annealing: Annealing = Annealing::Constant { alpha: 1.0 },
        /// Judge the particles at the end ([`Certificate`](crate::Certificate)).
        pub certificate: bool = true,
        /// Where the run leaves its state, and goes on from if it was stopped.
        pub checkpoint: Option<Checkpoint> = None,
        /// Give light parts of the target more particles than their share, with weights, instead of equal weights: they are better resolved then, and the effective
        /// sample size is smaller. Of use after a survey only.
        pub weighted: bool = false,
        /// Measure residual and energy every so many steps (0: only at the end).
        pub trace_every: usize = 0,
    }
}
