//! Simple laws of one coordinate.

use std::f64::consts::LN_2;

use crate::error::{finite, positive, within};
use crate::special::{HALF_LOG_TWO_PI, normal_quantile};
use crate::{Target, TargetError, UnitCubeTransport};

/// A law of one coordinate, symmetric about 0 and normalised.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AxisLaw {
    /// N(0, 1).
    Normal,
    /// p = ½ e^(−|x|): a cusp at 0, where the score is set to 0.
    Laplace,
    /// Uniform on [−1, 1] plus ε times a standard logistic variable, so that the edges fall off over the width ε:
    /// p = sinh(1/ε) / 2 (cosh(x/ε) + cosh(1/ε)), score −½ (tanh((x+1)/2ε) + tanh((x−1)/2ε)) / ε, quantile
    /// 2u − 1 + ε [log(1 − e^(−2u/ε)) − log(1 − e^(−2(1−u)/ε))].
    SoftUniform {
        /// ε.
        edge: f64,
    },
}

impl AxisLaw {
    /// The uniform law with edges of width ε = `edge`.
    ///
    /// # Errors
    /// [`TargetError::NotFinite`], or [`TargetError::OutOfRange`] unless 10⁻³ ≤ ε ≤ 1 (wider ones are logistic).
    pub fn soft_uniform(edge: f64) -> Result<Self, TargetError> {
        const FIELD: &str = "the width of the edges";
        finite(FIELD, edge)?;
        within(FIELD, edge, (1e-3..=1.0).contains(&edge), "a number from 0.001 to 1")?;
        Ok(Self::SoftUniform { edge })
    }

    /// log p(x).
    fn log_density_at(self, x: f64) -> f64 {
        match self {
            Self::Normal => -0.5 * x * x - HALF_LOG_TWO_PI,
            Self::Laplace => -x.abs() - LN_2,
            Self::SoftUniform { edge } => {
                let (at, end) = (x.abs() / edge, 1.0 / edge);
                let (large, small) = (at.max(end), at.min(end));
                // log (cosh a + cosh b) and log sinh, with e^max taken out.
                let sum = (-2.0 * large).exp() + (small - large).exp() + (-small - large).exp();
                end + (-(-2.0 * end).exp()).ln_1p() - large - sum.ln_1p() - LN_2
            }
        }
    }

    /// d log p / dx.
    fn slope(self, x: f64) -> f64 {
        match self {
            Self::Normal => -x,
            Self::Laplace if x == 0.0 => 0.0,
            Self::Laplace => -x.signum(),
            Self::SoftUniform { edge } => {
                let side = |end: f64| (0.5 * (x + end) / edge).tanh();
                -0.5 * (side(1.0) + side(-1.0)) / edge
            }
        }
    }

    /// The quantile of u in (0, 1).
    fn quantile(self, u: f64) -> f64 {
        match self {
            Self::Normal => normal_quantile(u),
            Self::Laplace if u < 0.5 => (2.0 * u).ln(),
            Self::Laplace => -(2.0 * (1.0 - u)).ln(),
            Self::SoftUniform { edge } => {
                let tail = |v: f64| (-(-2.0 * v / edge).exp_m1()).ln();
                2.0 * u - 1.0 + edge * (tail(u) - tail(1.0 - u))
            }
        }
    }
}

impl Target<1> for AxisLaw {
    fn log_density(&self, [x]: &[f64; 1]) -> f64 {
        self.log_density_at(*x)
    }

    fn score(&self, [x]: &[f64; 1]) -> [f64; 1] {
        [self.slope(*x)]
    }
}

impl UnitCubeTransport<1> for AxisLaw {
    fn cube_dimension(&self) -> usize {
        1
    }

    fn transport(&self, u: &[f64]) -> [f64; 1] {
        [self.quantile(u.first().copied().unwrap_or(0.5))]
    }
}

/// N(m, w²) on the line, a mode of a grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bump {
    pub centre: f64,
    pub width: f64,
}

impl Bump {
    /// # Errors
    /// [`TargetError::NotFinite`] or [`TargetError::OutOfRange`].
    pub fn new(centre: f64, width: f64) -> Result<Self, TargetError> {
        Ok(Self {
            centre: finite("the centre of a bump", centre)?,
            width: positive("the width of a bump", width)?,
        })
    }
}

impl Target<1> for Bump {
    fn log_density(&self, [x]: &[f64; 1]) -> f64 {
        AxisLaw::Normal.log_density_at((x - self.centre) / self.width) - self.width.ln()
    }

    fn score(&self, [x]: &[f64; 1]) -> [f64; 1] {
        [(self.centre - x) / (self.width * self.width)]
    }
}

impl UnitCubeTransport<1> for Bump {
    fn cube_dimension(&self) -> usize {
        1
    }

    fn transport(&self, u: &[f64]) -> [f64; 1] {
        [self.centre + self.width * normal_quantile(u.first().copied().unwrap_or(0.5))]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The distribution function by Simpson's rule, piecewise between the quantiles, and the slope by differences.
    #[test]
    fn density_quantile_and_slope_agree() {
        for law in [
            AxisLaw::Normal,
            AxisLaw::Laplace,
            AxisLaw::SoftUniform { edge: 0.02 },
            AxisLaw::SoftUniform { edge: 0.7 },
        ] {
            let levels = [1e-9, 0.01, 0.2, 0.5, 0.7, 0.99, 1.0 - 1e-9];
            for pair in levels.windows(2) {
                let [low, high] = [0, 1].map(|end| law.quantile(pair[end]));
                let (count, mut sum) = (20_000, 0.0);
                let step = (high - low) / f64::from(count);
                for k in 0..=count {
                    let weight = match k {
                        k if k == 0 || k == count => 1.0,
                        k if k % 2 == 1 => 4.0,
                        _ => 2.0,
                    };
                    sum += weight * law.log_density_at(low + f64::from(k) * step).exp();
                }
                let mass = sum * step / 3.0;
                assert!((mass - (pair[1] - pair[0])).abs() < 1e-8, "{law:?} {pair:?}: {mass}");
            }
            for x in [-3.0, -1.01, -0.4, 0.2, 0.97, 1.5] {
                let slope = (law.log_density_at(x + 1e-5) - law.log_density_at(x - 1e-5)) / 2e-5;
                assert!((slope - law.slope(x)).abs() < 1e-5 * (1.0 + slope.abs()), "{law:?} {x}");
            }
            assert!(law.log_density_at(1e30) < -1e29 && law.slope(-1e30) > 0.0);
        }
        assert!(AxisLaw::soft_uniform(0.0).is_err() && AxisLaw::soft_uniform(f64::NAN).is_err());
    }
}
