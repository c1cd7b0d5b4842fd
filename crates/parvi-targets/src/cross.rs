//! Long thin arms along every axis that cross at the origin.

use rand::{Rng, RngExt};

use crate::error::{at_least_two, positive};
use crate::gaussian::{normal_quantiles, standard_normal};
use crate::special::HALF_LOG_TWO_PI;
use crate::target::its_own_source;
use crate::{CatalogueTarget, ExactDraws, Frame, Moments, Target, TargetError, UnitCubeTransport};

/// p = (1/D) Σ_k N(0, C_k), where C_k is diagonal with variance s² on axis k and w² on the others: for s > w a cross with D
/// arms of length s and thickness w. Its mode is the origin, and along every line through it the density only falls.
///
/// With t_k = −½ (x_k²/s² + Σ_{j≠k} x_j²/w²) and responsibilities r_k = e^{t_k} / Σ e^{t_j}:
/// log p = log Σ_k e^{t_k} − log D − log s − (D−1) log w − D/2 · log 2π (normalised),
/// score_j = −x_j (r_j/s² + (1 − r_j)/w²). Mean 0, covariance (s² + (D−1) w²)/D · I: the moments show nothing of the arms.
#[derive(Clone, Debug, PartialEq)]
pub struct Cross<const D: usize> {
    spread: f64,
    width: f64,
}

impl<const D: usize> Cross<D> {
    /// A cross whose arms have standard deviation s = `spread` along their axis and w = `width` across it.
    ///
    /// # Errors
    /// [`TargetError::DimensionNotAllowed`] for D < 2; [`TargetError::NotFinite`] or [`TargetError::OutOfRange`] unless
    /// s > 0 and w > 0; [`TargetError::NotFinite`] where a variance leaves the range of numbers.
    pub fn new(spread: f64, width: f64) -> Result<Self, TargetError> {
        at_least_two("cross", D)?;
        for (field, value) in [("spread", spread), ("width", width)] {
            positive(field, value)?;
            positive(&format!("the square of the {field}"), value * value)?;
        }
        Ok(Self { spread, width })
    }

    /// (s² + (D−1) w²) / D.
    fn variance(&self) -> f64 {
        (self.spread * self.spread + (D as f64 - 1.0) * self.width * self.width) / D as f64
    }

    /// The t_k and the largest of them.
    fn exponents(&self, x: &[f64; D]) -> ([f64; D], f64) {
        let exponents: [f64; D] = std::array::from_fn(|arm| {
            // Summed anew for every arm: as a difference from the whole the far arms would cancel.
            let mut square = 0.0;
            for axis in 0..D {
                let z = x[axis] / if axis == arm { self.spread } else { self.width };
                square += z * z;
            }
            -0.5 * square
        });
        (exponents, exponents.iter().copied().fold(f64::NEG_INFINITY, f64::max))
    }

    /// The normal point z in the arm that `u` selects.
    fn in_arm(&self, u: f64, z: [f64; D]) -> [f64; D] {
        let arm = ((u * D as f64) as usize).min(D - 1);
        std::array::from_fn(|axis| z[axis] * if axis == arm { self.spread } else { self.width })
    }
}

impl<const D: usize> Target<D> for Cross<D> {
    fn log_density(&self, x: &[f64; D]) -> f64 {
        let (exponents, largest) = self.exponents(x);
        let sum: f64 = exponents.iter().map(|t| (t - largest).exp()).sum();
        let scales = (D as f64).ln() + self.spread.ln() + (D as f64 - 1.0) * self.width.ln();
        largest + sum.ln() - scales - D as f64 * HALF_LOG_TWO_PI
    }

    fn score(&self, x: &[f64; D]) -> [f64; D] {
        let (exponents, largest) = self.exponents(x);
        let weights = exponents.map(|t| (t - largest).exp());
        let total: f64 = weights.iter().sum();
        let (along, across) = (self.spread * self.spread, self.width * self.width);
        std::array::from_fn(|axis| {
            let others: f64 = (0..D).filter(|&arm| arm != axis).map(|arm| weights[arm]).sum();
            -x[axis] * ((weights[axis] / total) / along + (others / total) / across)
        })
    }
}

impl<const D: usize> ExactDraws<D> for Cross<D> {
    fn draw(&self, rng: &mut dyn Rng) -> [f64; D] {
        let u = rng.random();
        self.in_arm(u, standard_normal(rng))
    }
}

impl<const D: usize> UnitCubeTransport<D> for Cross<D> {
    /// One coordinate more than D: the first selects the arm.
    fn cube_dimension(&self) -> usize {
        D + 1
    }

    fn transport(&self, u: &[f64]) -> [f64; D] {
        let arm = u.first().copied().unwrap_or(0.5);
        self.in_arm(arm, normal_quantiles(u.get(1..).unwrap_or(&[])))
    }
}

impl<const D: usize> CatalogueTarget<D> for Cross<D> {
    fn name(&self) -> &str {
        "cross"
    }

    /// The frame of mean and covariance, a multiple of the identity.
    fn frame(&self) -> Frame<D> {
        Frame::diagonal([0.0; D], [self.variance().sqrt(); D])
    }

    fn domain(&self) -> [[f64; 2]; D] {
        let half = 4.0 * self.spread.max(self.width);
        [[-half, half]; D]
    }

    its_own_source!(D);

    fn moments(&self) -> Option<Moments<D>> {
        Some(Moments::centred([self.variance(); D]))
    }

    /// The density is normalised.
    fn log_evidence(&self) -> Option<f64> {
        Some(0.0)
    }
}
