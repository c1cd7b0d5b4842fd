//! Squared energy distance of a cloud from a Gaussian, without reference draws.

use mpm_tensor::{Matrix, SymmetricEigen};

use crate::error::{entries, finite};
use crate::norm_expectation::NormExpectation;
use crate::summation::chunked_sum;
use crate::{Cloud, MetricError, mean_pair_distance};

const NAME: &str = "the energy distance from a Gaussian";

/// The Gaussian N(m, C) as a reference whose energy distance is exact:
///
/// ED²(cloud, N) = 2 Σ_i w_i E‖x_i − Y‖ − Σ_ij w_i w_j ‖x_i − x_j‖ − E‖Y − Y'‖, Y, Y' ~ N(m, C) independent.
///
/// Both expectations are norms of Gaussians, E‖Z‖ = 1/(2√π) ∫₀^∞ (1 − E e^{−t‖Z‖²}) t^{−3/2} dt, integrated to 1e-14 of
/// their value by the trapezoidal rule in log t. M independent particles have the expectation E‖Y − Y'‖ / M. The unit is
/// that of the points.
///
/// Source: Székely & Rizzo 2013 (as for [`energy_distance_squared`](crate::energy_distance_squared)); the integral is
/// Γ(−½) = −2√π written out.
#[derive(Clone, Debug)]
pub struct GaussianEnergy<const D: usize> {
    mean: [f64; D],
    eigen: SymmetricEigen<D>,
    mean_distance: f64,
}

/// What is compiled for a dimension.
struct Compiled<const D: usize> {
    /// [`GaussianEnergy::new`].
    gaussian: fn([f64; D], &Matrix<D>) -> Result<GaussianEnergy<D>, MetricError>,
    /// [`GaussianEnergy::squared`].
    squared: fn(&GaussianEnergy<D>, &Cloud<'_, D>) -> Result<f64, MetricError>,
}

impl<const D: usize> Compiled<D> {
    const HERE: Self = Self { gaussian, squared };
}

mpm_parallel::compiled_ahead!(Compiled);

impl<const D: usize> GaussianEnergy<D> {
    /// The reference N(`mean`, `covariance`).
    ///
    /// # Errors
    /// [`MetricError::InvalidEntry`] for a mean that is not finite, [`MetricError::InvalidCovariance`] for a covariance
    /// that is not symmetric (to 1e-12 of its largest entry) and positive definite.
    pub fn new(mean: [f64; D], covariance: &Matrix<D>) -> Result<Self, MetricError> {
        (Compiled::of().gaussian)(mean, covariance)
    }

    /// The standard Gaussian N(0, I), whose E‖Y − Y'‖ is 2 Γ((d+1)/2) / Γ(d/2).
    ///
    /// # Errors
    /// None in practice; those of [`GaussianEnergy::new`] by type.
    pub fn standard() -> Result<Self, MetricError> {
        Self::new([0.0; D], &Matrix::diagonal(&[1.0; D]))
    }

    /// E‖Y − Y'‖; divided by M it is the expected ED² of M independent draws.
    pub fn mean_distance(&self) -> f64 {
        self.mean_distance
    }

    /// The table that serves every point of the cloud, with the points' squared components in the eigenbasis.
    fn table(&self, cloud: &Cloud<'_, D>) -> Result<(NormExpectation<D>, Vec<[f64; D]>), MetricError> {
        let squares: Vec<[f64; D]> = cloud
            .points()
            .iter()
            .map(|point| {
                let offset = std::array::from_fn(|axis| point[axis] - self.mean[axis]);
                self.eigen
                    .vectors
                    .apply_transposed(&offset)
                    .map(|component| component * component)
            })
            .collect();
        let largest = squares
            .iter()
            .fold(0.0, |largest: f64, square| largest.max(square.iter().sum()));
        let table = NormExpectation::new(self.eigen.values, largest);
        Ok((
            table.ok_or(MetricError::Overflow {
                metric: NAME,
                value: largest,
            })?,
            squares,
        ))
    }

    /// E‖x_i − Y‖ for every point of the cloud.
    ///
    /// # Errors
    /// [`MetricError::Overflow`] if a squared distance exceeds the range of `f64`.
    pub fn expected_distances(&self, cloud: &Cloud<'_, D>) -> Result<Vec<f64>, MetricError> {
        let (table, squares) = self.table(cloud)?;
        squares
            .iter()
            .map(|square| finite(NAME, table.evaluate(square)))
            .collect()
    }

    /// The squared energy distance of a cloud from the Gaussian, in O(M²) (O(M log M) in one dimension), in parallel
    /// and independent of the number of threads.
    ///
    /// # Errors
    /// [`MetricError::Overflow`] if a squared distance exceeds the range of `f64`.
    pub fn squared(&self, cloud: &Cloud<'_, D>) -> Result<f64, MetricError> {
        (Compiled::of().squared)(self, cloud)
    }
}

/// [`GaussianEnergy::new`].
fn gaussian<const D: usize>(mean: [f64; D], covariance: &Matrix<D>) -> Result<GaussianEnergy<D>, MetricError> {
    let eigen = checked_eigen(&mean, covariance)?;
    let twice = eigen.values.map(|value| 2.0 * value);
    let mean_distance = NormExpectation::new(twice, 0.0).map_or(f64::INFINITY, |table| table.evaluate(&[0.0; D]));
    Ok(GaussianEnergy {
        mean,
        eigen,
        mean_distance: finite(NAME, mean_distance)?,
    })
}

/// [`GaussianEnergy::squared`].
fn squared<const D: usize>(energy: &GaussianEnergy<D>, cloud: &Cloud<'_, D>) -> Result<f64, MetricError> {
    let (table, squares) = energy.table(cloud)?;
    let cross = chunked_sum(cloud.len(), |index| {
        cloud.weight(index) * table.evaluate(&squares[index])
    });
    finite(NAME, 2.0 * cross - mean_pair_distance(cloud)? - energy.mean_distance)
}

/// The eigenvalues and axes of a checked covariance.
pub(crate) fn checked_eigen<const D: usize>(
    mean: &[f64; D],
    covariance: &Matrix<D>,
) -> Result<SymmetricEigen<D>, MetricError> {
    let invalid = |reason: &'static str, value: f64| MetricError::InvalidCovariance { reason, value };
    entries("mean", mean, f64::is_finite, "finite")?;
    if let Some(&value) = covariance.0.as_flattened().iter().find(|value| !value.is_finite()) {
        return Err(invalid("it has the entry", value));
    }
    let asymmetry = (*covariance - covariance.transpose()).maximum_norm();
    if asymmetry > 1e-12 * covariance.maximum_norm() {
        return Err(invalid("C and its transpose differ by", asymmetry));
    }
    let eigen = SymmetricEigen::new(covariance).ok_or_else(|| invalid("its eigenvalues are", f64::NAN))?;
    match eigen.values.iter().find(|value| value.is_nan() || **value <= 0.0) {
        Some(&value) => Err(invalid("it has the eigenvalue", value)),
        None => Ok(eigen),
    }
}
