//! The affine map between a target's coordinates and coordinates of unit scale.

use mpm_tensor::{Cholesky, Matrix, power_of_two, vector};

use crate::TargetError;
use crate::error::{finite, positive};

/// By how much the sum of weights may be off one: rounding, also of what was written to a file with few digits.
const LARGEST_ERROR_OF_SUM: f64 = 1e-6;

/// The frame x = μ + L z, with L the lower triangular factor of a covariance C = L Lᵀ.
///
/// `x` are the target's own coordinates, `z` the reference coordinates in which a density with mean μ and
/// covariance C has mean zero and covariance I. A density p on x becomes log q(z) = log p(μ + L z) + log det L, with
/// score ∇_z log q = Lᵀ ∇_x log p.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame<const D: usize> {
    centre: [f64; D],
    factor: Matrix<D>,
}

impl<const D: usize> Frame<D> {
    /// μ = 0, L = I.
    pub fn identity() -> Self {
        Self::diagonal([0.0; D], [1.0; D])
    }

    /// The frame of a mean μ = `centre` and a covariance C: L is the Cholesky factor of C.
    ///
    /// ```
    /// use parvi_targets::{Frame, Matrix};
    ///
    /// let frame = Frame::new([1.0, -2.0], Matrix([[4.0, 1.2], [1.2, 1.0]]))?; // standard deviations 2 and 1, correlation 0.6
    /// assert_eq!(frame.to_target(&[1.0, 0.0]), [3.0, -1.4]);
    /// # Ok::<(), parvi_targets::TargetError>(())
    /// ```
    ///
    /// # Errors
    /// [`TargetError::NotFinite`], [`TargetError::NotSymmetric`] (beyond 1e-9 of the geometric mean of the two
    /// variances) or [`TargetError::NotPositiveDefinite`].
    pub fn new(centre: [f64; D], covariance: Matrix<D>) -> Result<Self, TargetError> {
        check_centre(&centre)?;
        Ok(Self {
            centre,
            factor: cholesky_factor("the covariance", &covariance)?,
        })
    }

    /// The frame of the mean and the covariance of points with weights that sum to one (`None`: equal ones).
    ///
    /// # Errors
    /// As [`new`](Self::new), also where the points lie in a plane; [`TargetError::Length`] unless every point has a weight, [`TargetError::OutOfRange`] for weights whose sum is off one by more than 1e-6.
    pub fn of_points(points: &[[f64; D]], weights: Option<&[f64]>) -> Result<Self, TargetError> {
        if let Some(weights) = weights.filter(|weights| weights.len() != points.len()) {
            return Err(TargetError::Length {
                field: "the weights of the points".to_owned(),
                expected: points.len(),
                found: weights.len(),
            });
        }
        let sum = weights.map_or(1.0, |weights| weights.iter().sum());
        let is_one = (sum - 1.0).abs() <= LARGEST_ERROR_OF_SUM; // not where it is no number
        if !is_one {
            return Err(TargetError::OutOfRange {
                field: "the sum of the weights of the points".to_owned(),
                value: sum,
                allowed: "1",
            });
        }
        let weight = |p: usize| weights.map_or(1.0 / points.len() as f64, |weights| weights[p]);
        // In units of powers of two, which round nothing: squares of large coordinates overflow, those of small ones vanish.
        let unit = |a: usize| power_of_two(points.iter().fold(0.0, |largest, x| x[a].abs().max(largest)));
        let units: [f64; D] = std::array::from_fn(unit);
        let in_units = |x: &[f64; D]| -> [f64; D] { std::array::from_fn(|a| x[a] / units[a]) };
        let mut mean = [0.0; D];
        for (p, x) in points.iter().enumerate() {
            vector::accumulate(&mut mean, weight(p), &in_units(x));
        }
        let covariance = points.iter().enumerate().fold(Matrix::<D>::ZERO, |sum, (p, x)| {
            let x = vector::subtract(&in_units(x), &mean);
            sum + Matrix::outer(&x, &x) * weight(p)
        });
        let scaled = Self::new(mean, covariance.symmetric_part())?;
        Ok(Self {
            centre: std::array::from_fn(|a| units[a] * scaled.centre[a]),
            factor: Matrix::from_fn(|i, j| units[i] * scaled.factor.0[i][j]),
        })
    }

    /// The frame of a diagonal covariance, given by its standard deviations.
    ///
    /// # Errors
    /// [`TargetError::NotFinite`] or, for a scale that is not above zero, [`TargetError::OutOfRange`].
    pub fn from_scales(centre: [f64; D], standard_deviations: [f64; D]) -> Result<Self, TargetError> {
        check_centre(&centre)?;
        for (axis, &scale) in (1..).zip(&standard_deviations) {
            positive(&format!("the standard deviation of x{axis}"), scale)?;
        }
        Ok(Self::diagonal(centre, standard_deviations))
    }

    /// As [`from_scales`](Self::from_scales), for scales known to be positive.
    pub(crate) fn diagonal(centre: [f64; D], scales: [f64; D]) -> Self {
        let mut factor = [[0.0; D]; D];
        for i in 0..D {
            factor[i][i] = scales[i];
        }
        Self {
            centre,
            factor: Matrix(factor),
        }
    }

    /// μ.
    pub fn centre(&self) -> &[f64; D] {
        &self.centre
    }

    /// L, lower triangular with a positive diagonal.
    pub fn factor(&self) -> &Matrix<D> {
        &self.factor
    }

    /// C = L Lᵀ.
    pub fn covariance(&self) -> Matrix<D> {
        let l = &self.factor.0;
        let mut covariance = [[0.0; D]; D];
        for i in 0..D {
            for j in 0..D {
                for k in 0..=i.min(j) {
                    covariance[i][j] += l[i][k] * l[j][k];
                }
            }
        }
        Matrix(covariance)
    }

    /// x = μ + L z.
    pub fn to_target(&self, z: &[f64; D]) -> [f64; D] {
        let l = &self.factor.0;
        let mut x = self.centre;
        for i in 0..D {
            for j in 0..=i {
                x[i] += l[i][j] * z[j];
            }
        }
        x
    }

    /// z = L⁻¹ (x − μ), by forward substitution.
    pub fn to_reference(&self, x: &[f64; D]) -> [f64; D] {
        let l = &self.factor.0;
        let mut z = [0.0; D];
        for i in 0..D {
            let mut rest = x[i] - self.centre[i];
            for j in 0..i {
                rest -= l[i][j] * z[j];
            }
            z[i] = rest / l[i][i];
        }
        z
    }

    /// The score in reference coordinates, ∇_z log q = Lᵀ ∇_x log p.
    pub fn pull_back_score(&self, score: &[f64; D]) -> [f64; D] {
        let l = &self.factor.0;
        let mut pulled = [0.0; D];
        for i in 0..D {
            for j in 0..=i {
                pulled[j] += l[i][j] * score[i];
            }
        }
        pulled
    }

    /// L⁻ᵀ s, the inverse of [`pull_back_score`](Self::pull_back_score), by back substitution.
    pub fn push_forward_score(&self, score: &[f64; D]) -> [f64; D] {
        let l = &self.factor.0;
        let mut pushed = [0.0; D];
        for i in (0..D).rev() {
            let mut rest = score[i];
            for j in i + 1..D {
                rest -= l[j][i] * pushed[j];
            }
            pushed[i] = rest / l[i][i];
        }
        pushed
    }

    /// log det L = Σ log L_ii: volumes grow by its exponential from z to x.
    pub fn log_determinant(&self) -> f64 {
        (0..D).map(|i| self.factor.0[i][i].ln()).sum()
    }
}

fn check_centre<const D: usize>(centre: &[f64; D]) -> Result<(), TargetError> {
    for (axis, &value) in (1..).zip(centre) {
        finite(&format!("x{axis} of the centre"), value)?;
    }
    Ok(())
}

/// The Cholesky factor of a symmetric positive definite matrix, with errors that name `field`.
///
/// The matrix is scaled to unit diagonal first, so the test for definiteness does not depend on the units of the axes.
pub(crate) fn cholesky_factor<const D: usize>(field: &str, matrix: &Matrix<D>) -> Result<Matrix<D>, TargetError> {
    let a = &matrix.0;
    let mut scale = [0.0; D];
    for i in 0..D {
        for j in 0..D {
            finite(&format!("entry ({i}, {j}) of {field}"), a[i][j])?;
        }
        if a[i][i] <= 0.0 {
            return Err(TargetError::NotPositiveDefinite {
                field: field.to_owned(),
                axis: i,
                value: a[i][i],
            });
        }
        scale[i] = a[i][i].sqrt();
    }
    let mut scaled = [[0.0; D]; D];
    for i in 0..D {
        for j in 0..=i {
            let unit = scale[i] * scale[j];
            let difference = a[i][j] - a[j][i];
            if difference.abs() > 1e-9 * unit {
                return Err(TargetError::NotSymmetric {
                    field: field.to_owned(),
                    row: i,
                    column: j,
                    difference,
                });
            }
            scaled[i][j] = a[i][j] / unit;
        }
    }
    let not_definite = |axis, value| TargetError::NotPositiveDefinite {
        field: field.to_owned(),
        axis,
        value,
    };
    let mut lower = match Cholesky::new(&Matrix(scaled)) {
        Ok(factor) => *factor.lower(),
        Err(error) => return Err(not_definite(error.index, error.pivot)),
    };
    for i in 0..D {
        // A pivot at the level of rounding is zero.
        let pivot = lower.0[i][i] * lower.0[i][i];
        if pivot <= 8.0 * f64::EPSILON {
            return Err(not_definite(i, pivot));
        }
        for j in 0..=i {
            lower.0[i][j] *= scale[i];
        }
    }
    Ok(lower)
}
