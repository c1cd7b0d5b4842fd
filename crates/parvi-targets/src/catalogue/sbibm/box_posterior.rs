//! The posterior under a uniform prior on a box, in unconstrained coordinates.

use rand::rngs::ChaCha8Rng;
use rand::{Rng, SeedableRng};

use super::simulator::{Simulator, equal_modes};
use crate::gaussian::box_of_standard_deviations;
use crate::weighted_draws::moments_of;
use crate::{CatalogueTarget, ConstrainedTarget, Constraints, ExactDraws, Frame, Mode, Target, TargetError};

/// How far from 0 log odds of a draw are: where θ rounds to ±b.
const LARGEST_LOG_ODDS: f64 = 36.0;

/// Draws that the frame comes from.
const FRAME_DRAWS: usize = 1 << 10;

/// Likelihood p(x | θ) of a [`Simulator`] under the uniform prior on (−b, b)ᴰ, in the coordinates y = log (b + θ)/(b − θ), where the
/// support has no ends: log p(y) = log p(x | θ) + Σ log σ(y_k) σ(−y_k), σ the logistic function. ∫ p is the evidence.
#[derive(Clone, Debug)]
pub struct BoxPosterior<S, const D: usize> {
    target: ConstrainedTarget<S, D, D>,
    /// log (2b)ᴰ.
    log_volume: f64,
    frame: Frame<D>,
    modes: Vec<Mode<D>>,
}

impl<S: Simulator<D>, const D: usize> BoxPosterior<S, D> {
    /// The posterior of a simulator's observation, with the frame of mean and covariance of 1,024 of its draws.
    ///
    /// # Errors
    /// Those of the constraints: a half-width that is not finite, or not above 0.
    pub fn new(simulator: S) -> Result<Self, TargetError> {
        let b = S::HALF_WIDTH;
        let constraints = Constraints::builder().bounded(D, -b, b).build()?;
        let centres: Result<Vec<_>, _> = simulator
            .centres()
            .iter()
            .map(|centre| constraints.unconstrain(centre))
            .collect();
        let mut posterior = Self {
            modes: equal_modes(&centres?),
            log_volume: D as f64 * (2.0 * b).ln(),
            target: constraints.target(simulator),
            frame: Frame::identity(),
        };
        let mut rng = ChaCha8Rng::seed_from_u64(0);
        let draws: Vec<_> = (0..FRAME_DRAWS).map(|_| posterior.draw(&mut rng)).collect();
        let moments = moments_of(&draws, &[1.0; FRAME_DRAWS]);
        posterior.frame = Frame::new(moments.mean, moments.covariance)?;
        Ok(posterior)
    }

    /// The simulator.
    pub fn simulator(&self) -> &S {
        self.target.density()
    }

    /// θ in the box of a point y.
    pub fn in_box(&self, y: &[f64; D]) -> [f64; D] {
        self.target.constraints().constrain(y)
    }
}

impl<S: Simulator<D>, const D: usize> Target<D> for BoxPosterior<S, D> {
    fn log_density(&self, y: &[f64; D]) -> f64 {
        self.target.log_density(y) - self.log_volume
    }

    fn score(&self, y: &[f64; D]) -> [f64; D] {
        self.target.score(y)
    }
}

impl<S: Simulator<D>, const D: usize> ExactDraws<D> for BoxPosterior<S, D> {
    fn draw(&self, rng: &mut dyn Rng) -> [f64; D] {
        let log_odds = |theta: f64| ((S::HALF_WIDTH + theta) / (S::HALF_WIDTH - theta)).ln();
        let draw = self.simulator().posterior_draw(rng);
        draw.map(|theta| log_odds(theta).clamp(-LARGEST_LOG_ODDS, LARGEST_LOG_ODDS))
    }
}

impl<S: Simulator<D>, const D: usize> CatalogueTarget<D> for BoxPosterior<S, D> {
    fn name(&self) -> &str {
        self.simulator().name()
    }

    /// The frame of mean and covariance, to some percent.
    fn frame(&self) -> Frame<D> {
        self.frame
    }

    /// The mean ± six standard deviations: at an edge of the box tails are exponential.
    fn domain(&self) -> [[f64; 2]; D] {
        box_of_standard_deviations(self.frame.centre(), &self.frame.covariance(), 6.0)
    }

    fn exact_draws(&self) -> Option<&dyn ExactDraws<D>> {
        Some(self)
    }

    fn modes(&self) -> &[Mode<D>] {
        &self.modes
    }

    fn log_evidence(&self) -> Option<f64> {
        Some(self.simulator().log_evidence())
    }
}
