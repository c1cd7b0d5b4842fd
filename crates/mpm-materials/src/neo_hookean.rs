//! The compressible Neo-Hookean solid.

use mpm_tensor::Matrix;
use wide::f64x4;

use crate::material::{inverse_transpose, log_volume_ratio, shifted, stresses_one_by_one, wave_speeds_one_by_one};
use crate::side_by_side::{LANES, groups, write_wave_speeds};
use crate::stretch::{largest_squared_stretch, left_cauchy_green};
use crate::{ElasticModuli, Material};

/// The compressible Neo-Hookean solid, ψ = μ/2 (tr FᵀF − D) − μ ln J + λ/2 ln² J with J = det F.
///
/// P = μ (F − F⁻ᵀ) + λ ln J F⁻ᵀ and τ = μ (F Fᵀ − I) + λ ln J I, which needs no inverse. Objective and isotropic; ψ = 0 and
/// τ = 0 at rest.
///
/// **Defined for J > 0 only.** ψ grows without bound as J → 0, so the exact motion never gets there, but a time step that is
/// too long can. [`Material::check`] and [`Material::checked_kirchhoff_stress`] then return
/// [`DeformationError::VolumeRatio`](crate::DeformationError::VolumeRatio) with J; the unchecked methods return NaN (all diagonal entries of a stress).
///
/// Source: Bonet & Wood, *Nonlinear Continuum Mechanics*, 2nd ed., Eqs. 6.27–6.29; Huang, arXiv 2407.20287.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NeoHookean {
    /// λ and μ.
    pub moduli: ElasticModuli,
}

impl NeoHookean {
    /// The material with these moduli.
    pub fn new(moduli: ElasticModuli) -> Self {
        Self { moduli }
    }
}

impl<const D: usize> Material<D> for NeoHookean {
    #[inline]
    fn energy_density(&self, F: &Matrix<D>) -> f64 {
        let log_J = log_volume_ratio(F);
        self.moduli.shear_modulus() * (0.5 * (F.contract(F) - D as f64) - log_J)
            + 0.5 * self.moduli.first_lame_parameter() * log_J * log_J
    }

    #[inline]
    fn kirchhoff_stress(&self, F: &Matrix<D>) -> Matrix<D> {
        let mu = self.moduli.shear_modulus();
        let pressure = self.moduli.first_lame_parameter() * log_volume_ratio(F);
        shifted(left_cauchy_green(F) * mu, pressure - mu)
    }

    /// λ ln J.
    fn kirchhoff_stress_across(&self, F: &Matrix<D>) -> Option<f64> {
        Some(self.moduli.first_lame_parameter() * log_volume_ratio(F))
    }

    fn first_piola_kirchhoff(&self, F: &Matrix<D>) -> Matrix<D> {
        let mu = self.moduli.shear_modulus();
        let pressure = self.moduli.first_lame_parameter() * log_volume_ratio(F);
        *F * mu + inverse_transpose(F) * (pressure - mu)
    }

    /// ρ₀ c² = μ Λ² + max(0, λ + μ − λ ln J) with a bound of the largest stretch Λ of F.
    #[inline]
    fn wave_speed(&self, F: &Matrix<D>, reference_density: f64) -> f64 {
        let (lambda, mu) = (self.moduli.first_lame_parameter(), self.moduli.shear_modulus());
        let pressure_part = lambda + mu - lambda * log_volume_ratio(F);
        // Not f64::max, which would hide NaN.
        let pressure_part = if pressure_part < 0.0 { 0.0 } else { pressure_part };
        ((mu * largest_squared_stretch(F) + pressure_part) / reference_density).sqrt()
    }

    fn kirchhoff_stresses(&self, F: &[Matrix<D>], stresses: &mut [Matrix<D>]) {
        let (lambda, mu) = (self.moduli.first_lame_parameter(), self.moduli.shear_modulus());
        if D > 3 {
            return stresses_one_by_one(self, F, stresses); // a group has no determinant
        }
        for (F, stresses) in groups(F).zip(stresses.chunks_mut(LANES)) {
            let pressure = F.log_volume_ratio() * lambda;
            let stress = F.left_cauchy_green().scaled_and_shifted(mu, pressure - mu);
            stress.write(stresses);
        }
    }

    fn wave_speeds(&self, F: &[Matrix<D>], reference_densities: &[f64], wave_speeds: &mut [f64]) {
        let (lambda, mu) = (self.moduli.first_lame_parameter(), self.moduli.shear_modulus());
        if D > 3 {
            return wave_speeds_one_by_one(self, F, reference_densities, wave_speeds);
        }
        let each = reference_densities.chunks(LANES).zip(wave_speeds.chunks_mut(LANES));
        for (F, (densities, speeds)) in groups(F).zip(each) {
            let pressure_part = (lambda + mu) - F.log_volume_ratio() * lambda;
            // Where F has NaN, so have ln J and this.
            let pressure_part = pressure_part.simd_lt(f64x4::ZERO).select(f64x4::ZERO, pressure_part);
            let stiffness = F.left_cauchy_green().largest_row_sum() * mu + pressure_part;
            write_wave_speeds(stiffness, densities, speeds);
        }
    }
}
