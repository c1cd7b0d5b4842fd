//! Mixtures of isotropic Gaussians.

use mpm_tensor::Matrix;
use rand::{Rng, RngExt};

use crate::error::{at_least_two, finite, positive};
use crate::gaussian::{normal_quantiles, standard_normal};
use crate::special::HALF_LOG_TWO_PI;
use crate::target::its_own_source;
use crate::{CatalogueTarget, ExactDraws, Frame, Mode, Moments, Target, TargetError, UnitCubeTransport};

/// p(x) = Σ_k π_k N(x; c_k, w_k² I), with centres c_k, widths w_k and masses π_k of the [`Mode`]s.
///
/// log p by log-sum-exp (normalised); score = Σ_k r_k (c_k − x) / w_k² with responsibilities r_k = π_k N_k / p.
#[derive(Clone, Debug, PartialEq)]
pub struct GaussianMixture<const D: usize> {
    name: String,
    modes: Vec<Mode<D>>,
    /// log π_k − D log w_k − D/2 · log 2π.
    log_heights: Vec<f64>,
    moments: Moments<D>,
    frame: Frame<D>,
}

impl<const D: usize> GaussianMixture<D> {
    /// A mixture of the given modes; the masses may be any positive weights and are divided by their sum.
    ///
    /// # Errors
    /// [`TargetError::Empty`] without modes; [`TargetError::NotFinite`] or [`TargetError::OutOfRange`] for a centre,
    /// width or mass that is not finite, or a width or mass that is not above zero.
    pub fn new(name: &str, modes: &[Mode<D>]) -> Result<Self, TargetError> {
        if modes.is_empty() {
            return Err(TargetError::Empty {
                field: format!("the list of modes of '{name}'"),
            });
        }
        for (index, mode) in modes.iter().enumerate() {
            for (axis, &value) in (1..).zip(&mode.centre) {
                finite(&format!("x{axis} of the centre of mode {index}"), value)?;
            }
            positive(&format!("the width of mode {index}"), mode.width)?;
            positive(&format!("the mass of mode {index}"), mode.mass)?;
        }
        let total = finite("the sum of the masses", modes.iter().map(|mode| mode.mass).sum())?;
        let modes: Vec<_> = modes
            .iter()
            .map(|mode| Mode {
                mass: mode.mass / total,
                ..*mode
            })
            .collect();
        let log_heights = modes
            .iter()
            .map(|mode| mode.mass.ln() - D as f64 * (mode.width.ln() + HALF_LOG_TWO_PI))
            .collect();
        let moments = moments_of(&modes);
        let frame = Frame::new(moments.mean, moments.covariance)?;
        Ok(Self {
            name: name.to_owned(),
            modes,
            log_heights,
            moments,
            frame,
        })
    }

    /// `mixture-2`: modes at ∓1.5 e₁ of width 0.5 (or `width`), masses 0.3 and 0.7.
    ///
    /// # Errors
    /// As [`new`](Self::new), for the width.
    pub fn two_unequal(width: f64) -> Result<Self, TargetError> {
        let mode = |position, mass| Mode {
            centre: on_axis(0, position),
            width,
            mass,
        };
        Self::new("mixture-2", &[mode(-1.5, 0.3), mode(1.5, 0.7)])
    }

    /// `mixture-3`: modes at −4e₁, 4e₁, 5e₂ of widths 0.6, 0.4, 0.5 and masses 0.2, 0.5, 0.3.
    ///
    /// Far apart: the distances are 11.1, 8.2 and 10.0 times √(w_a² + w_b²), and more than 10 times either width.
    ///
    /// # Errors
    /// [`TargetError::DimensionNotAllowed`] for D < 2.
    pub fn three_far() -> Result<Self, TargetError> {
        at_least_two("mixture-3", D)?;
        let mode = |axis, position, width, mass| Mode {
            centre: on_axis(axis, position),
            width,
            mass,
        };
        Self::new(
            "mixture-3",
            &[mode(0, -4.0, 0.6, 0.2), mode(0, 4.0, 0.4, 0.5), mode(1, 5.0, 0.5, 0.3)],
        )
    }

    /// log(π_k N(x; c_k, w_k² I)) for each mode.
    fn log_terms(&self, x: &[f64; D]) -> impl Iterator<Item = f64> + Clone {
        let x = *x;
        self.modes.iter().zip(&self.log_heights).map(move |(mode, height)| {
            let mut square = 0.0;
            for axis in 0..D {
                let z = (x[axis] - mode.centre[axis]) / mode.width;
                square += z * z;
            }
            height - 0.5 * square
        })
    }

    /// The mode whose interval of the cumulated masses holds `u`.
    fn mode_at(&self, mut u: f64) -> &Mode<D> {
        for mode in &self.modes[..self.modes.len() - 1] {
            if u < mode.mass {
                return mode;
            }
            u -= mode.mass;
        }
        &self.modes[self.modes.len() - 1]
    }
}

impl GaussianMixture<2> {
    /// `mixture-4`: four equal modes at (±2, ±2) of width 0.5 (or `width`).
    ///
    /// # Errors
    /// As [`new`](GaussianMixture::new), for the width.
    pub fn four_equal(width: f64) -> Result<Self, TargetError> {
        let corners = [[-2.0, -2.0], [-2.0, 2.0], [2.0, -2.0], [2.0, 2.0]];
        Self::new(
            "mixture-4",
            &corners.map(|centre| Mode {
                centre,
                width,
                mass: 0.25,
            }),
        )
    }
}

impl<const D: usize> Target<D> for GaussianMixture<D> {
    fn log_density(&self, x: &[f64; D]) -> f64 {
        let terms = self.log_terms(x);
        let largest = terms.clone().fold(f64::NEG_INFINITY, f64::max);
        if largest == f64::NEG_INFINITY {
            return largest;
        }
        largest + terms.map(|term| (term - largest).exp()).sum::<f64>().ln()
    }

    fn score(&self, x: &[f64; D]) -> [f64; D] {
        let terms = self.log_terms(x);
        let largest = terms.clone().fold(f64::NEG_INFINITY, f64::max);
        let mut score = [0.0; D];
        let mut total = 0.0;
        for (term, mode) in terms.zip(&self.modes) {
            let responsibility = (term - largest).exp();
            total += responsibility;
            let pull = responsibility / (mode.width * mode.width);
            for axis in 0..D {
                score[axis] += pull * (mode.centre[axis] - x[axis]);
            }
        }
        score.map(|component| component / total)
    }
}

impl<const D: usize> ExactDraws<D> for GaussianMixture<D> {
    fn draw(&self, rng: &mut dyn Rng) -> [f64; D] {
        let mode = self.mode_at(rng.random());
        let z: [f64; D] = standard_normal(rng);
        std::array::from_fn(|axis| mode.centre[axis] + mode.width * z[axis])
    }
}

impl<const D: usize> UnitCubeTransport<D> for GaussianMixture<D> {
    /// One coordinate more than D: the first selects the mode.
    fn cube_dimension(&self) -> usize {
        D + 1
    }

    fn transport(&self, u: &[f64]) -> [f64; D] {
        let mode = self.mode_at(u.first().copied().unwrap_or(0.5));
        let z: [f64; D] = normal_quantiles(u.get(1..).unwrap_or(&[]));
        std::array::from_fn(|axis| mode.centre[axis] + mode.width * z[axis])
    }
}

impl<const D: usize> CatalogueTarget<D> for GaussianMixture<D> {
    fn name(&self) -> &str {
        &self.name
    }

    /// The frame of the mixture's mean and covariance.
    fn frame(&self) -> Frame<D> {
        self.frame
    }

    fn domain(&self) -> [[f64; 2]; D] {
        std::array::from_fn(|axis| {
            self.modes
                .iter()
                .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], mode| {
                    let (centre, half) = (mode.centre[axis], 4.0 * mode.width);
                    [low.min(centre - half), high.max(centre + half)]
                })
        })
    }

    its_own_source!(D);

    fn moments(&self) -> Option<Moments<D>> {
        Some(self.moments)
    }

    fn modes(&self) -> &[Mode<D>] {
        &self.modes
    }

    /// The density is normalised.
    fn log_evidence(&self) -> Option<f64> {
        Some(0.0)
    }
}

fn on_axis<const D: usize>(axis: usize, position: f64) -> [f64; D] {
    std::array::from_fn(|i| if i == axis { position } else { 0.0 })
}

/// mean m = Σ π_k c_k, covariance Σ π_k (w_k² I + (c_k − m)(c_k − m)ᵀ).
fn moments_of<const D: usize>(modes: &[Mode<D>]) -> Moments<D> {
    let mut mean = [0.0; D];
    for mode in modes {
        for axis in 0..D {
            mean[axis] += mode.mass * mode.centre[axis];
        }
    }
    let mut covariance = [[0.0; D]; D];
    for mode in modes {
        for i in 0..D {
            covariance[i][i] += mode.mass * mode.width * mode.width;
            for j in 0..D {
                covariance[i][j] += mode.mass * (mode.centre[i] - mean[i]) * (mode.centre[j] - mean[j]);
            }
        }
    }
    Moments {
        mean,
        covariance: Matrix(covariance),
    }
}
