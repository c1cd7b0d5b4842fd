//! The Laplace approximation: a density's mode and the inverse of its curvature there.

use mpm_tensor::{Matrix, vector};

use crate::frame::cholesky_factor;
use crate::{Frame, Target, TargetError};

/// Newton steps after which the search gives up.
const MAXIMUM_STEPS: usize = 200;

/// The search ends with the full step that follows a step shorter than this, in standard deviations.
const TOLERANCE: f64 = 1e-7;

/// A target that knows its second derivatives.
pub trait Curvature<const D: usize>: Target<D> {
    /// The negative Hessian −∇∇ log p(x), symmetric; positive definite near a proper mode.
    fn negative_hessian(&self, x: &[f64; D]) -> Matrix<D>;
}

/// The Gaussian N(m, H⁻¹) at the mode m of a density, H = −∇∇ log p(m).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Laplace<const D: usize> {
    frame: Frame<D>,
}

impl<const D: usize> Laplace<D> {
    /// Finds the mode by Newton's method from `start`, halving a step until the density has risen enough (Armijo, 10⁻⁴).
    ///
    /// For a log-concave density the search converges from anywhere. `name` stands for the target in errors.
    ///
    /// # Errors
    /// [`TargetError::NotPositiveDefinite`] where the Hessian is singular or indefinite, [`TargetError::NotFinite`] where
    /// it is not finite, [`TargetError::ModeNotFound`] after 200 steps or when no step raises the density.
    pub fn find(name: &str, target: &impl Curvature<D>, start: [f64; D]) -> Result<Self, TargetError> {
        let mut mode = start;
        let mut density = target.log_density(&mode);
        let mut length = f64::INFINITY;
        for steps in 1..=MAXIMUM_STEPS {
            let score = target.score(&mode);
            let factor = Curved::new(name, &target.negative_hessian(&mode))?;
            let step = factor.solve(&score);
            let square = vector::dot(&score, &step);
            length = square.sqrt();
            if length < TOLERANCE {
                // Newton's method squares the error, so this last step leaves rounding only.
                mode = vector::add(&mode, &step);
                let covariance = Curved::new(name, &target.negative_hessian(&mode))?.inverse();
                let frame = Frame::new(mode, covariance)?;
                return Ok(Self { frame });
            }
            let rounding = 1e-13 * density.abs();
            let accepted = (0..60).map(|halvings| 0.5_f64.powi(halvings)).find_map(|fraction| {
                let trial = vector::add_scaled(&mode, fraction, &step);
                let value = target.log_density(&trial);
                (value >= density + 1e-4 * fraction * square - rounding).then_some((trial, value))
            });
            match accepted {
                Some((trial, value)) => (mode, density) = (trial, value),
                None => {
                    return Err(TargetError::ModeNotFound {
                        target: name.to_owned(),
                        iterations: steps,
                        step: length,
                    });
                }
            }
        }
        Err(TargetError::ModeNotFound {
            target: name.to_owned(),
            iterations: MAXIMUM_STEPS,
            step: length,
        })
    }

    /// The mode m.
    pub fn mode(&self) -> &[f64; D] {
        self.frame.centre()
    }

    /// H⁻¹.
    pub fn covariance(&self) -> Matrix<D> {
        self.frame.covariance()
    }

    /// The frame x = m + L z with L Lᵀ = H⁻¹.
    pub fn frame(&self) -> &Frame<D> {
        &self.frame
    }
}

/// A negative Hessian with its Cholesky factor, as a frame whose "covariance" is the Hessian.
pub(crate) struct Curved<const D: usize>(Frame<D>);

impl<const D: usize> Curved<D> {
    /// Factorises; the error names the target.
    pub(crate) fn new(name: &str, hessian: &Matrix<D>) -> Result<Self, TargetError> {
        let field = format!("the negative Hessian of '{name}'");
        // Checks first: the error is to name the Hessian, not a covariance.
        cholesky_factor(&field, hessian)?;
        Ok(Self(Frame::new([0.0; D], *hessian)?))
    }

    /// H⁻¹ s.
    pub(crate) fn solve(&self, s: &[f64; D]) -> [f64; D] {
        self.0.push_forward_score(&self.0.to_reference(s))
    }

    /// H⁻¹.
    pub(crate) fn inverse(&self) -> Matrix<D> {
        let columns: [[f64; D]; D] =
            std::array::from_fn(|j| self.solve(&std::array::from_fn(|i| if i == j { 1.0 } else { 0.0 })));
        Matrix(columns).symmetric_part()
    }
}
