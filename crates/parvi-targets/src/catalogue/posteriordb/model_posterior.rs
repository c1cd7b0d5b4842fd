//! The posterior of a model with constrained parameters, in unconstrained coordinates.

use mpm_tensor::{Matrix, vector};

use super::prior::Prior;
use crate::gaussian::box_of_standard_deviations;
use crate::{
    CatalogueTarget, ConstrainedTarget, Constraints, Curvature, Frame, ImportanceSample, Laplace, ReferenceOptions,
    Target, TargetError,
};

/// How far from 0 a coordinate without a constraint is followed.
pub(super) const FREE: f64 = 1e30;

/// How far from 0 the logarithm of a parameter is followed.
pub(super) const LOGARITHM: f64 = 50.0;

/// How far from 0 the log odds of a parameter are followed: 1 − x has three digits there.
pub(super) const LOG_ODDS: f64 = 30.0;

/// Points of the importance sample that the frame comes from.
const FRAME_POINTS: usize = 1 << 11;

/// A likelihood of N constrained parameters x, times independent priors: log p(x) = log L(x) + Σ log π_k(x_k).
#[derive(Clone, Debug)]
struct WithPriors<T, const N: usize> {
    likelihood: T,
    priors: [Prior; N],
}

impl<T: Target<N>, const N: usize> Target<N> for WithPriors<T, N> {
    fn log_density(&self, x: &[f64; N]) -> f64 {
        let priors = self.priors.iter().zip(x).map(|(prior, &x)| prior.log_density(x));
        self.likelihood.log_density(x) + priors.sum::<f64>()
    }

    fn score(&self, x: &[f64; N]) -> [f64; N] {
        let priors = std::array::from_fn(|k| self.priors[k].score(x[k]));
        vector::add(&self.likelihood.score(x), &priors)
    }
}

/// The posterior of a model of N constrained parameters, of which D are independent, as a target of the D unconstrained
/// coordinates y that [`constraints`](Self::constraints) maps to them:
/// log q(y) = log L(x) + Σ log π_k(x_k) + log |det ∂x/∂y|, up to a constant.
///
/// Beyond a reach R_k per coordinate, where numbers would overflow and the posterior has no mass to speak of, the density falls
/// as e^(R_k − |y_k|) and keeps its dependence on the other coordinates. For a parameter with a positive density at its bound
/// that is what its logarithm does by itself.
#[derive(Clone, Debug)]
pub struct ModelPosterior<T, const N: usize, const D: usize> {
    name: &'static str,
    target: ConstrainedTarget<WithPriors<T, N>, N, D>,
    reach: [f64; D],
    frame: Frame<D>,
}

/// What a model says of its parameters.
pub(super) struct Description<const N: usize, const D: usize> {
    pub name: &'static str,
    pub priors: [Prior; N],
    pub constraints: Constraints<N, D>,
    /// R.
    pub reach: [f64; D],
    /// A point of the bulk, from which the mode is found.
    pub start: [f64; N],
}

impl<T: Target<N>, const N: usize, const D: usize> ModelPosterior<T, N, D> {
    /// The posterior of a likelihood, with the frame of its mean and covariance: those of an importance sample about the Laplace
    /// approximation, which takes 2 × 2,048 log densities.
    ///
    /// # Errors
    /// A start outside of the support; those of [`Laplace::find`] and [`ImportanceSample::new`].
    pub(super) fn new(likelihood: T, description: Description<N, D>) -> Result<Self, TargetError> {
        let start = description.constraints.unconstrain(&description.start)?;
        let priors = description.priors;
        let mut posterior = Self {
            name: description.name,
            target: description.constraints.target(WithPriors { likelihood, priors }),
            reach: description.reach,
            frame: Frame::identity(),
        };
        posterior.frame = *Laplace::find(description.name, &posterior, start)?.frame();
        let options = ReferenceOptions {
            points: FRAME_POINTS,
            ..ReferenceOptions::default()
        };
        let moments = ImportanceSample::new(&posterior, &options)?.draws().moments();
        posterior.frame = Frame::new(moments.mean, moments.covariance)?;
        Ok(posterior)
    }

    /// The map from the coordinates y to the model's parameters x, in the order of posteriordb.
    pub fn constraints(&self) -> &Constraints<N, D> {
        self.target.constraints()
    }

    /// The nearest point within reach.
    fn within_reach(&self, y: &[f64; D]) -> [f64; D] {
        std::array::from_fn(|k| y[k].clamp(-self.reach[k], self.reach[k]))
    }
}

impl<T: Target<N>, const N: usize, const D: usize> Target<D> for ModelPosterior<T, N, D> {
    fn log_density(&self, y: &[f64; D]) -> f64 {
        let near = self.within_reach(y);
        let beyond: f64 = y.iter().zip(&near).map(|(y, near)| (y - near).abs()).sum();
        self.target.log_density(&near) - beyond
    }

    fn score(&self, y: &[f64; D]) -> [f64; D] {
        let near = self.within_reach(y);
        let mut score = self.target.score(&near);
        for k in 0..D {
            if y[k] != near[k] {
                score[k] = -y[k].signum();
            }
        }
        score
    }

    fn scores(&self, ys: &[[f64; D]], out: &mut [[f64; D]]) {
        mpm_parallel::write(ys, out, &|y| self.score(y));
    }

    fn log_densities(&self, ys: &[[f64; D]], out: &mut [f64]) {
        mpm_parallel::write(ys, out, &|y| self.log_density(y));
    }
}

/// Central differences of the score, with a step of 10⁻⁴ (1 + |y_k|): the error is of the order of 10⁻⁸.
impl<T: Target<N>, const N: usize, const D: usize> Curvature<D> for ModelPosterior<T, N, D> {
    fn negative_hessian(&self, y: &[f64; D]) -> Matrix<D> {
        let rows = std::array::from_fn(|k| {
            let step = 1e-4 * (1.0 + y[k].abs());
            let [above, below] = [step, -step].map(|step| {
                let mut moved = *y;
                moved[k] += step;
                self.score(&moved)
            });
            vector::subtract(&below, &above).map(|difference| difference / (2.0 * step))
        });
        Matrix(rows).symmetric_part()
    }
}

impl<T: Target<N>, const N: usize, const D: usize> CatalogueTarget<D> for ModelPosterior<T, N, D> {
    fn name(&self) -> &str {
        self.name
    }

    /// The frame of mean and covariance, to some percent.
    fn frame(&self) -> Frame<D> {
        self.frame
    }

    /// The mean ± six standard deviations: what has a logarithm may have an exponential tail.
    fn domain(&self) -> [[f64; 2]; D] {
        box_of_standard_deviations(self.frame.centre(), &self.frame.covariance(), 6.0)
    }
}
