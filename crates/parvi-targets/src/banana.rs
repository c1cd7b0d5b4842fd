//! The banana: a Gaussian bent along a parabola.

use rand::Rng;

use crate::error::{finite, positive};
use crate::gaussian::{normal_quantiles, standard_normal};
use crate::special::HALF_LOG_TWO_PI;
use crate::target::its_own_source;
use crate::{CatalogueTarget, ExactDraws, Frame, Moments, Target, TargetError, UnitCubeTransport};

/// x₁ ~ N(0, 1), x₂ ~ N(b (x₁² − 1), σ²), with curvature b and width σ.
///
/// log p = −½ x₁² − e² / 2σ² − log σ − log 2π (normalised), e = x₂ − b (x₁² − 1);
/// score = (−x₁ + 2 b x₁ e / σ², −e / σ²). Mean 0, covariance diag(1, 2b² + σ²).
#[derive(Clone, Debug, PartialEq)]
pub struct Banana {
    curvature: f64,
    width: f64,
}

impl Banana {
    /// A banana of the given curvature b and width σ.
    ///
    /// # Errors
    /// [`TargetError::NotFinite`], or [`TargetError::OutOfRange`] unless σ > 0.
    pub fn new(curvature: f64, width: f64) -> Result<Self, TargetError> {
        Ok(Self {
            curvature: finite("curvature", curvature)?,
            width: positive("width", width)?,
        })
    }

    /// (z₁, z₂) standard normal ↦ (z₁, b (z₁² − 1) + σ z₂).
    fn bend(&self, [z1, z2]: [f64; 2]) -> [f64; 2] {
        [z1, self.curvature * (z1 * z1 - 1.0) + self.width * z2]
    }

    /// e / σ, the second standard normal variable.
    fn standardised_offset(&self, [x1, x2]: &[f64; 2]) -> f64 {
        (x2 - self.curvature * (x1 * x1 - 1.0)) / self.width
    }

    fn variance_of_second(&self) -> f64 {
        2.0 * self.curvature * self.curvature + self.width * self.width
    }
}

impl Default for Banana {
    /// b = 1, σ = 0.5.
    fn default() -> Self {
        Self {
            curvature: 1.0,
            width: 0.5,
        }
    }
}

impl Target<2> for Banana {
    fn log_density(&self, x: &[f64; 2]) -> f64 {
        let e = self.standardised_offset(x);
        -0.5 * (x[0] * x[0] + e * e) - self.width.ln() - 2.0 * HALF_LOG_TWO_PI
    }

    fn score(&self, x: &[f64; 2]) -> [f64; 2] {
        let pull = self.standardised_offset(x) / self.width;
        [-x[0] + 2.0 * self.curvature * x[0] * pull, -pull]
    }
}

impl ExactDraws<2> for Banana {
    fn draw(&self, rng: &mut dyn Rng) -> [f64; 2] {
        self.bend(standard_normal(rng))
    }
}

impl UnitCubeTransport<2> for Banana {
    fn transport(&self, u: &[f64]) -> [f64; 2] {
        self.bend(normal_quantiles(u))
    }
}

impl CatalogueTarget<2> for Banana {
    fn name(&self) -> &str {
        "banana"
    }

    fn frame(&self) -> Frame<2> {
        Frame::diagonal([0.0; 2], [1.0, self.variance_of_second().sqrt()])
    }

    /// |x₁| ≤ 4 and the parabola over |x₁| ≤ 3.5 widened by 4σ.
    fn domain(&self) -> [[f64; 2]; 2] {
        let (end, middle) = (self.curvature * (3.5 * 3.5 - 1.0), -self.curvature);
        let margin = 4.0 * self.width;
        [[-4.0, 4.0], [end.min(middle) - margin, end.max(middle) + margin]]
    }

    its_own_source!(2);

    fn moments(&self) -> Option<Moments<2>> {
        Some(Moments::centred([1.0, self.variance_of_second()]))
    }

    /// The density is normalised.
    fn log_evidence(&self) -> Option<f64> {
        Some(0.0)
    }
}
