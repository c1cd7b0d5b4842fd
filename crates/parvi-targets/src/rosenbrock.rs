//! The hybrid Rosenbrock density: parabolas of parabolas, in any dimension and with a known constant.

use mpm_tensor::Matrix;
use rand::Rng;

use crate::error::{at_least_two, positive, within};
use crate::gaussian::{normal_quantiles, standard_normal};
use crate::special::HALF_LOG_TWO_PI;
use crate::target::its_own_source;
use crate::{CatalogueTarget, ExactDraws, Frame, Moments, Target, TargetError, UnitCubeTransport};

/// The mean of x₁.
const CENTRE: f64 = 1.0;

/// x₁ ~ N(1, s²), and each further coordinate follows the square of another: x_k ~ N(x_{π(k)}², σ²), where π(k) = 1 for
/// even k and π(k) = k − 1 for odd k (counted from 1). So x₂, x₄, … are parabolas over x₁, and x₃, x₅, … parabolas over them.
///
/// log p = −½ (x₁ − 1)²/s² − ½ Σ_k e_k²/σ² − log s − (D−1) log σ − D/2 · log 2π (normalised), e_k = x_k − x_{π(k)}²;
/// score_k = −e_k/σ² + 2 x_k Σ_{π(j) = k} e_j/σ², with e_1/s² in place of e_1/σ².
///
/// With m_k = E(x₁ᵏ) mean and covariance are closed: E(x_k) = m₂ on the first level and m₄ + σ² on the second.
///
/// Source: F. Pagani, M. Wiegand, S. Nadarajah, An n-dimensional Rosenbrock distribution for Markov chain Monte Carlo
/// testing, *Scandinavian Journal of Statistics* 49 (2022) 657–680: the hybrid density with μ = 1, n₁ = 3, a = 1/2s²,
/// b = 1/2σ² (its last block one short where D is even). Their a = 1/20, b = 5 are s = √10, σ = 1/√10.
#[derive(Clone, Debug, PartialEq)]
pub struct Rosenbrock<const D: usize> {
    spread: f64,
    width: f64,
    moments: Moments<D>,
    frame: Frame<D>,
}

impl<const D: usize> Rosenbrock<D> {
    /// The density with s = `spread` and σ = `width`.
    ///
    /// # Errors
    /// [`TargetError::DimensionNotAllowed`] for D < 2; [`TargetError::NotFinite`] or [`TargetError::OutOfRange`] unless
    /// s > 0, σ > 0 and both are at most 10⁶; [`TargetError::NotPositiveDefinite`] where σ is so much smaller than s that
    /// the coordinates are linearly dependent to rounding.
    pub fn new(spread: f64, width: f64) -> Result<Self, TargetError> {
        at_least_two("rosenbrock", D)?;
        for (field, value) in [("spread", spread), ("width", width)] {
            positive(field, value)?;
            within(field, value, value <= 1e6, "a number above 0 and up to 1000000")?;
        }
        let moments = moments_of(spread, width);
        let frame = Frame::new(moments.mean, moments.covariance)?;
        Ok(Self {
            spread,
            width,
            moments,
            frame,
        })
    }

    /// Standard normal z ↦ (1 + s z₁, x_{π(k)}² + σ z_k).
    fn bend(&self, z: [f64; D]) -> [f64; D] {
        let mut x = z;
        x[0] = CENTRE + self.spread * z[0];
        for axis in 1..D {
            let base = x[parent(axis)];
            x[axis] = base * base + self.width * z[axis];
        }
        x
    }

    /// z = (e₁/s, e₂/σ, …), the inverse of [`bend`](Self::bend).
    fn standardised(&self, x: &[f64; D]) -> [f64; D] {
        std::array::from_fn(|axis| {
            if axis == 0 {
                (x[0] - CENTRE) / self.spread
            } else {
                let base = x[parent(axis)];
                (x[axis] - base * base) / self.width
            }
        })
    }
}

/// π(k), counted from 0.
fn parent(axis: usize) -> usize {
    if axis % 2 == 1 { 0 } else { axis - 1 }
}

/// Given x₁, the mean of the coordinate is x₁ to this power, plus a constant.
fn power(axis: usize) -> usize {
    match axis {
        0 => 1,
        odd if odd % 2 == 1 => 2,
        _ => 4,
    }
}

/// Given x₁ the first level is N(x₁², σ²) and blocks (x₂, x₃), (x₄, x₅), … are independent, with
/// Cov(x₂, x₃ | x₁) = 2 x₁² σ² and Var(x₃ | x₁) = 4 x₁⁴ σ² + 2σ⁴ + σ²; the covariances of the conditional means add
/// m_{i+j} − m_i m_j.
fn moments_of<const D: usize>(spread: f64, width: f64) -> Moments<D> {
    let square = width * width;
    let mut raw = [1.0, CENTRE, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    for k in 2..raw.len() {
        raw[k] = CENTRE * raw[k - 1] + (k - 1) as f64 * spread * spread * raw[k - 2];
    }
    let mean = std::array::from_fn(|axis| raw[power(axis)] + if power(axis) == 4 { square } else { 0.0 });
    let covariance = Matrix::from_fn(|i, j| {
        let (low, high) = (i.min(j), i.max(j));
        let given_first = match (power(low), power(high)) {
            (1, _) => 0.0,
            (2, 2) if low == high => square,
            (2, 4) if parent(high) == low => 2.0 * raw[2] * square,
            (4, 4) if low == high => 4.0 * raw[4] * square + 2.0 * square * square + square,
            _ => 0.0,
        };
        let of_means = if high == 0 {
            spread * spread
        } else {
            raw[power(i) + power(j)] - raw[power(i)] * raw[power(j)]
        };
        of_means + given_first
    });
    Moments { mean, covariance }
}

impl<const D: usize> Target<D> for Rosenbrock<D> {
    fn log_density(&self, x: &[f64; D]) -> f64 {
        let square: f64 = self.standardised(x).iter().map(|z| z * z).sum();
        let scales = self.spread.ln() + (D as f64 - 1.0) * self.width.ln();
        -0.5 * square - scales - D as f64 * HALF_LOG_TWO_PI
    }

    fn score(&self, x: &[f64; D]) -> [f64; D] {
        let z = self.standardised(x);
        let mut score = [0.0; D];
        score[0] = -z[0] / self.spread;
        for axis in 1..D {
            let pull = z[axis] / self.width;
            score[axis] -= pull;
            score[parent(axis)] += 2.0 * x[parent(axis)] * pull;
        }
        score
    }
}

impl<const D: usize> ExactDraws<D> for Rosenbrock<D> {
    fn draw(&self, rng: &mut dyn Rng) -> [f64; D] {
        self.bend(standard_normal(rng))
    }
}

impl<const D: usize> UnitCubeTransport<D> for Rosenbrock<D> {
    fn transport(&self, u: &[f64]) -> [f64; D] {
        self.bend(normal_quantiles(u))
    }
}

impl<const D: usize> CatalogueTarget<D> for Rosenbrock<D> {
    fn name(&self) -> &str {
        "rosenbrock"
    }

    /// The frame of mean and covariance.
    fn frame(&self) -> Frame<D> {
        self.frame
    }

    /// |x₁ − 1| ≤ 3.5 s, and level by level the parabolas over the interval below, widened by 4σ.
    fn domain(&self) -> [[f64; 2]; D] {
        let mut domain = [[CENTRE - 3.5 * self.spread, CENTRE + 3.5 * self.spread]; D];
        for axis in 1..D {
            let [low, high] = domain[parent(axis)];
            let top = (low * low).max(high * high);
            let bottom = if low < 0.0 && high > 0.0 {
                0.0
            } else {
                (low * low).min(high * high)
            };
            domain[axis] = [bottom - 4.0 * self.width, top + 4.0 * self.width];
        }
        domain
    }

    its_own_source!(D);

    fn moments(&self) -> Option<Moments<D>> {
        Some(self.moments)
    }

    /// The density is normalised.
    fn log_evidence(&self) -> Option<f64> {
        Some(0.0)
    }
}
