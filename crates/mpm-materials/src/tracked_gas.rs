//! The isothermal gas as a function of the deformation gradient.

use mpm_tensor::Matrix;

use crate::error::positive;
use crate::material::{inverse_transpose, log_volume_ratio};
use crate::{IsothermalGas, Material, ParameterError};

/// The isothermal gas whose volume is tracked by F: ψ = −κ ρ₀ ln J, P = −κ ρ₀ F⁻ᵀ, τ = −κ ρ₀ I.
///
/// τ is constant because V⁰ τ = −V P I = −κ m I: the reason why [`IsothermalGas`] needs no F. Use this form to run the gas
/// through a step made for solids, and to measure the elastic energy −κ Σ_p m_p ln J_p. Objective; **not** free of stress at
/// F = I, a gas has no such state. Defined for J > 0 only: otherwise [`Material::check`] fails with J, and the unchecked
/// methods return NaN.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrackedGas {
    gas: IsothermalGas,
    reference_density: f64,
}

impl TrackedGas {
    /// The gas with mass ρ₀ per reference volume.
    ///
    /// # Errors
    ///
    /// [`ParameterError`] unless 0 < ρ₀ < ∞.
    pub fn new(gas: IsothermalGas, reference_density: f64) -> Result<Self, ParameterError> {
        let reference_density = positive("density", reference_density)?;
        Ok(Self { gas, reference_density })
    }
}

impl<const D: usize> Material<D> for TrackedGas {
    #[inline]
    fn energy_density(&self, F: &Matrix<D>) -> f64 {
        -self.gas.pressure(self.reference_density) * log_volume_ratio(F)
    }

    #[inline]
    fn kirchhoff_stress(&self, F: &Matrix<D>) -> Matrix<D> {
        Matrix::diagonal(&[-self.gas.kirchhoff_pressure(F, self.reference_density); D])
    }

    /// −κ ρ₀.
    fn kirchhoff_stress_across(&self, F: &Matrix<D>) -> Option<f64> {
        Some(-self.gas.kirchhoff_pressure(F, self.reference_density))
    }

    fn first_piola_kirchhoff(&self, F: &Matrix<D>) -> Matrix<D> {
        inverse_transpose(F) * -self.gas.kirchhoff_pressure(F, self.reference_density)
    }

    /// c = √(κ ρ₀ / `reference_density`), which is √κ if the density passed is the gas's own ρ₀.
    #[inline]
    fn wave_speed(&self, F: &Matrix<D>, reference_density: f64) -> f64 {
        (self.gas.kirchhoff_pressure(F, self.reference_density) / reference_density).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::DeformationError;

    #[test]
    fn the_stress_times_the_volume_is_that_of_the_gas_without_deformation() {
        let (kappa, density, reference_volume) = (1.5, 0.8, 0.25);
        let gas = IsothermalGas::new(kappa).expect("positive");
        let tracked = gas.with_reference_density(density).expect("positive");
        let F = Matrix([[1.3, 0.2], [-0.1, 0.7]]);
        let expected = Matrix::IDENTITY * -gas.pressure_times_volume(density * reference_volume);
        let force_factor = tracked.kirchhoff_stress(&F) * reference_volume;
        assert!((force_factor - expected).frobenius_norm() < 1e-15);
        assert!((tracked.wave_speed(&F, density) - gas.wave_speed()).abs() < 1e-15);
    }

    #[test]
    fn an_inverted_gas_is_an_error_with_its_volume_ratio() {
        let tracked = IsothermalGas::CALIBRATED.with_reference_density(1.0).expect("positive");
        let F = Matrix::diagonal(&[1.0, -2.0]);
        let error = tracked.checked_kirchhoff_stress(&F).expect_err("inverted");
        assert_eq!(error, DeformationError::VolumeRatio { volume_ratio: -2.0 });
        assert!(tracked.kirchhoff_stress(&F).trace().is_nan());
    }
}
