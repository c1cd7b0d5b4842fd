//! The isothermal gas of the calibrated law.

use mpm_tensor::Matrix;

use crate::error::positive;
use crate::material::volume_ratio;
use crate::{ParameterError, TrackedGas};

/// The isothermal ideal gas, P = κρ, σ = −P I: the law whose equilibrium under the body force m_p ∇log p per particle
/// *is* the target density, for κ = 1.
///
/// κ is pressure per density, the square of a speed. A particle of mass m and current volume V = m/ρ has V P = κ m whatever
/// its deformation, so the internal force on node i is
///
/// f_i = −Σ_p V_p σ_p ∇w_ip = κ Σ_p m_p ∇w_ip,
///
/// without F and without J. For this reason the gas does not implement [`Material`](crate::Material): a step that is
/// given a gas has no deformation gradient to store. [`with_reference_density`](Self::with_reference_density) makes the
/// same law a function of F, for comparison and for tests.
///
/// Source: the equation of state of an ideal gas at constant temperature (Landau & Lifshitz, *Fluid Mechanics*, §64: c² =
/// ∂P/∂ρ); ∇P = ρ ∇log p at rest gives ∇log ρ = ∇log p / κ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IsothermalGas {
    pressure_per_density: f64,
}

impl IsothermalGas {
    /// The calibrated gas, κ = 1: it rests at the target density itself.
    pub const CALIBRATED: Self = Self {
        pressure_per_density: 1.0,
    };

    /// The gas with the given κ; at rest it is distributed as p^(1/κ), a tempered target.
    ///
    /// # Errors
    ///
    /// [`ParameterError`] unless 0 < κ < ∞.
    pub fn new(pressure_per_density: f64) -> Result<Self, ParameterError> {
        let pressure_per_density = positive("pressure_per_density", pressure_per_density)?;
        Ok(Self { pressure_per_density })
    }

    /// κ, pressure per density.
    #[inline]
    pub fn pressure_per_density(&self) -> f64 {
        self.pressure_per_density
    }

    /// The pressure P = κρ at mass density ρ.
    #[inline]
    pub fn pressure(&self, density: f64) -> f64 {
        self.pressure_per_density * density
    }

    /// J P = κ ρ₀, the Kirchhoff pressure, the same for every admissible F; NaN unless det F is positive and finite.
    #[inline]
    pub(crate) fn kirchhoff_pressure<const D: usize>(&self, F: &Matrix<D>, reference_density: f64) -> f64 {
        match volume_ratio(F).is_nan() {
            true => f64::NAN,
            false => self.pressure(reference_density),
        }
    }

    /// V_p P_p = κ m_p, the factor of ∇w_ip in a particle's force on node i; an energy.
    #[inline]
    pub fn pressure_times_volume(&self, mass: f64) -> f64 {
        self.pressure_per_density * mass
    }

    /// The isothermal speed of sound c = √κ, the same in every state.
    #[inline]
    pub fn wave_speed(&self) -> f64 {
        self.pressure_per_density.sqrt()
    }

    /// The same law as a function of F, ψ(F) = −κ ρ₀ ln J.
    ///
    /// # Errors
    ///
    /// [`ParameterError`] unless 0 < ρ₀ < ∞.
    pub fn with_reference_density(self, reference_density: f64) -> Result<TrackedGas, ParameterError> {
        TrackedGas::new(self, reference_density)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_law_follows_its_formulas() {
        let gas = IsothermalGas::new(4.0).expect("positive");
        assert_eq!(gas.pressure_per_density(), 4.0);
        assert_eq!(gas.pressure(0.5), 2.0);
        assert_eq!(gas.pressure_times_volume(3.0), 12.0);
        assert_eq!(gas.wave_speed(), 2.0);
        assert_eq!(IsothermalGas::new(1.0), Ok(IsothermalGas::CALIBRATED));
    }

    #[test]
    fn parameters_out_of_range_are_named() {
        for value in [0.0, -1.0, f64::INFINITY] {
            let error = IsothermalGas::new(value).expect_err("out of range");
            assert_eq!(error.parameter(), ("pressure_per_density", value));
            let error = IsothermalGas::CALIBRATED.with_reference_density(value);
            assert_eq!(error.expect_err("out of range").parameter(), ("density", value));
        }
        assert!(IsothermalGas::new(f64::NAN).is_err());
    }
}
