//! The fixed corotated solid.

use mpm_tensor::{Matrix, Polar};

use crate::material::{inverse_transpose, shifted, stresses_one_by_one, volume_ratio, wave_speeds_one_by_one};
use crate::side_by_side::{LANES, groups, write_wave_speeds};
use crate::stretch::{largest_squared_stretch, squared_stretch_range};
use crate::{ElasticModuli, Material};

/// The fixed corotated solid, ψ = μ ‖F − R‖² + λ/2 (J − 1)² with the rotation R of F = R S and J = det F.
///
/// P = 2μ (F − R) + λ (J − 1) J F⁻ᵀ and τ = 2μ (F − R) Fᵀ + λ (J − 1) J I, which needs no inverse. Objective and
/// isotropic; ψ = 0 and τ = 0 at rest. Softer in compression than [`NeoHookean`](crate::NeoHookean): ψ stays finite as
/// J → 0.
///
/// **Defined for J > 0 only**, as in the other laws: [`Material::check`] fails with J otherwise, and the unchecked
/// methods return NaN. (ψ itself has a continuation to inverted elements, which the source uses.)
///
/// Source: Stomakhin, Howes, Schroeder & Teran, *Energetically consistent invertible elasticity*, SCA 2012; in the
/// material point method Stomakhin et al., *A material point method for snow simulation*, 2013, Eq. 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FixedCorotated {
    /// λ and μ.
    pub moduli: ElasticModuli,
}

impl FixedCorotated {
    /// The material with these moduli.
    pub fn new(moduli: ElasticModuli) -> Self {
        Self { moduli }
    }
}

/// F − R and J; NaN unless F is finite and J > 0.
#[inline]
fn corotated_strain<const D: usize>(F: &Matrix<D>) -> (Matrix<D>, f64) {
    let J = volume_ratio(F);
    match Polar::new(F) {
        Some(polar) if J > 0.0 => (*F - polar.rotation, J),
        _ => (Matrix([[f64::NAN; D]; D]), f64::NAN),
    }
}

impl<const D: usize> Material<D> for FixedCorotated {
    #[inline]
    fn energy_density(&self, F: &Matrix<D>) -> f64 {
        let (strain, J) = corotated_strain(F);
        self.moduli.shear_modulus() * strain.contract(&strain)
            + 0.5 * self.moduli.first_lame_parameter() * (J - 1.0) * (J - 1.0)
    }

    #[inline]
    fn kirchhoff_stress(&self, F: &Matrix<D>) -> Matrix<D> {
        let (strain, J) = corotated_strain(F);
        // Symmetric in exact arithmetic: F Fᵀ less the left stretch.
        let stress = (strain * F.transpose()).symmetric_part() * (2.0 * self.moduli.shear_modulus());
        shifted(stress, self.moduli.first_lame_parameter() * (J - 1.0) * J)
    }

    /// λ (J − 1) J.
    fn kirchhoff_stress_across(&self, F: &Matrix<D>) -> Option<f64> {
        let J = volume_ratio(F);
        Some(self.moduli.first_lame_parameter() * (J - 1.0) * J)
    }

    fn first_piola_kirchhoff(&self, F: &Matrix<D>) -> Matrix<D> {
        let (strain, J) = corotated_strain(F);
        let pressure = self.moduli.first_lame_parameter() * (J - 1.0) * J;
        strain * (2.0 * self.moduli.shear_modulus()) + inverse_transpose(F) * pressure
    }

    /// ρ₀ c² = 2μ Λ² + λ J² for λ ≥ 0, with a bound of the largest stretch Λ of F.
    ///
    /// Along a nᵀ, in principal axes with stretches λ_i, the second derivative of ψ is
    ///
    /// 2μ Σ_i λ_i² n_i² − 2μ Σ_{i<j} (λ_j a_i n_j − λ_i a_j n_i)² / (λ_i + λ_j) + λ J² (a · n)².
    ///
    /// For λ < 0 the second sum must not be dropped, or the bound is above the speed at rest. It is at least ‖m‖²
    /// sin²∠(a, m) / 2Λ with m_i = λ_i n_i, and by Kantorovich's inequality sin ∠(n, m) ≤ δ = (Λ − ℓ)/(Λ + ℓ) with the
    /// smallest stretch ℓ, which leaves ρ₀ c² ≤ 2μ Λ² + min(0, 2kδ + max(λ J², −k)), k = μ ℓ²/Λ.
    #[inline]
    fn wave_speed(&self, F: &Matrix<D>, reference_density: f64) -> f64 {
        let (lambda, mu) = (self.moduli.first_lame_parameter(), self.moduli.shear_modulus());
        let J = volume_ratio(F);
        let volumetric = lambda * J * J;
        if lambda >= 0.0 {
            return ((2.0 * mu * largest_squared_stretch(F) + volumetric) / reference_density).sqrt();
        }
        let (smallest, largest) = squared_stretch_range(F);
        let k = mu * smallest / largest.sqrt();
        let delta = (largest.sqrt() - smallest.sqrt()) / (largest.sqrt() + smallest.sqrt());
        let correction = 2.0 * k * delta + if volumetric < -k { -k } else { volumetric };
        let correction = if correction > 0.0 { 0.0 } else { correction };
        ((2.0 * mu * largest + correction) / reference_density).sqrt()
    }

    fn kirchhoff_stresses(&self, F: &[Matrix<D>], stresses: &mut [Matrix<D>]) {
        let (lambda, mu) = (self.moduli.first_lame_parameter(), self.moduli.shear_modulus());
        if D > 3 {
            return stresses_one_by_one(self, F, stresses); // a group has no determinant
        }
        for (F, stresses) in groups(F).zip(stresses.chunks_mut(LANES)) {
            let (J, R) = (F.volume_ratio(), F.rotation());
            let pressure = (J - 1.0) * J * lambda;
            let strain = F.minus(&R);
            strain
                .symmetric_product(&F)
                .scaled_and_shifted(2.0 * mu, pressure)
                .write(stresses);
        }
    }

    fn wave_speeds(&self, F: &[Matrix<D>], reference_densities: &[f64], wave_speeds: &mut [f64]) {
        let (lambda, mu) = (self.moduli.first_lame_parameter(), self.moduli.shear_modulus());
        if D > 3 || lambda < 0.0 {
            return wave_speeds_one_by_one(self, F, reference_densities, wave_speeds);
        }
        let each = reference_densities.chunks(LANES).zip(wave_speeds.chunks_mut(LANES));
        for (F, (densities, speeds)) in groups(F).zip(each) {
            let J = F.volume_ratio();
            let stiffness = F.left_cauchy_green().largest_row_sum() * (2.0 * mu) + J * J * lambda;
            write_wave_speeds(stiffness, densities, speeds);
        }
    }
}
