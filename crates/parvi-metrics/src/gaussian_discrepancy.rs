//! The squared maximum mean discrepancy of a cloud from a Gaussian, in closed form.

use mpm_tensor::{Matrix, SymmetricEigen};

use crate::error::finite;
use crate::gaussian_energy::checked_eigen;
use crate::maximum_mean_discrepancy::mean_kernel;
use crate::summation::chunked_sum;
use crate::{Cloud, MetricError, RadialKernel};

/// The Gaussian N(m, C) as a reference whose maximum mean discrepancy with the kernel of bandwidth b is exact:
///
/// MMD²(cloud, N) = Σ_ij w_i w_j k(x_i, x_j) + E k(Y, Y') − 2 Σ_i w_i E k(x_i, Y),
/// E k(x, Y) = Π_l (1 + λ_l/b²)^{−1/2} exp(−½ a_l² / (b² + λ_l)),   E k(Y, Y') = Π_l (1 + 2λ_l/b²)^{−1/2},
///
/// with λ_l the eigenvalues of C and a_l the components of x − m along its axes. M independent particles have the
/// expectation (1 − E k(Y, Y')) / M.
///
/// Source: Gretton et al. 2012 (as for
/// [`maximum_mean_discrepancy_squared`](crate::maximum_mean_discrepancy_squared)), Eq. (5), with Gaussian integrals.
#[derive(Clone, Debug)]
pub struct GaussianDiscrepancy<const D: usize> {
    kernel: RadialKernel,
    mean: [f64; D],
    eigen: SymmetricEigen<D>,
    amplitude: f64,
    mean_kernel: f64,
}

impl<const D: usize> GaussianDiscrepancy<D> {
    /// The reference N(`mean`, `covariance`).
    ///
    /// # Errors
    /// Those of [`GaussianEnergy::new`](crate::GaussianEnergy::new).
    pub fn new(mean: [f64; D], covariance: &Matrix<D>, kernel: RadialKernel) -> Result<Self, MetricError> {
        let eigen = checked_eigen(&mean, covariance)?;
        let square = kernel.bandwidth() * kernel.bandwidth();
        let product = |factor: f64| {
            eigen
                .values
                .iter()
                .map(|l| (1.0 + factor * l / square).sqrt().recip())
                .product()
        };
        Ok(Self {
            kernel,
            mean,
            eigen,
            amplitude: product(1.0),
            mean_kernel: product(2.0),
        })
    }

    /// E k(Y, Y').
    pub fn mean_kernel(&self) -> f64 {
        self.mean_kernel
    }

    /// E k(x, Y).
    pub fn expected_kernel(&self, x: &[f64; D]) -> f64 {
        let offset = std::array::from_fn(|axis| x[axis] - self.mean[axis]);
        let components = self.eigen.vectors.apply_transposed(&offset);
        let square = self.kernel.bandwidth() * self.kernel.bandwidth();
        let exponent: f64 = components
            .iter()
            .zip(&self.eigen.values)
            .map(|(a, l)| a * a / (square + l))
            .sum();
        self.amplitude * (-0.5 * exponent).exp()
    }

    /// The squared maximum mean discrepancy of a cloud from the Gaussian, O(M²), in parallel and independent of the
    /// number of threads.
    ///
    /// # Errors
    /// [`MetricError::Overflow`] if a term is not finite.
    pub fn squared(&self, cloud: &Cloud<'_, D>) -> Result<f64, MetricError> {
        let cross = chunked_sum(cloud.len(), |i| {
            cloud.weight(i) * self.expected_kernel(&cloud.points()[i])
        });
        let value = mean_kernel(cloud, &self.kernel) + self.mean_kernel - 2.0 * cross;
        finite("the maximum mean discrepancy from a Gaussian", value)
    }
}
