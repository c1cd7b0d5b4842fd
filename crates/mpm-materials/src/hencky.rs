//! The Hencky solid: linear elasticity in logarithmic strain.

use mpm_tensor::Matrix;

use crate::log_strain::log_strain;
use crate::material::{inverse_transpose, log_volume_ratio, shifted};
use crate::stretch::squared_stretch_range;
use crate::{ElasticModuli, Material};

/// The Hencky solid, ψ = μ ε : ε + λ/2 (tr ε)² with the logarithmic strain ε = ½ ln(F Fᵀ), tr ε = ln J.
///
/// τ = 2μ ε + λ tr ε I, coaxial with F Fᵀ, and P = τ F⁻ᵀ. Objective and isotropic; ψ = 0 and τ = 0 at rest. Stretches
/// multiply where their logarithms add, so metal plasticity and soils use it for their elastic part
/// ([`SofteningHencky`](crate::SofteningHencky), [`DruckerPrager`](crate::DruckerPrager)). Meant for moderate strain:
/// waves are sure to be stable for principal stretches in [0.21, 1.40] only (Bruhns, Xiao & Meyers, Proc. R. Soc. A
/// 457, 2001).
///
/// **Defined for J > 0 only**: otherwise [`Material::check`] fails with J, and the unchecked methods return NaN.
///
/// Source: Hencky, *Über die Form des Elastizitätsgesetzes bei ideal elastischen Stoffen*, Z. techn. Phys. 9, 1928;
/// Simo & Hughes, *Computational Inelasticity*, ch. 9.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hencky {
    /// λ and μ.
    pub moduli: ElasticModuli,
}

impl Hencky {
    /// The material with these moduli.
    pub fn new(moduli: ElasticModuli) -> Self {
        Self { moduli }
    }

    /// μ ε : ε + λ/2 θ² for the given ε : ε and θ = tr ε.
    #[inline]
    pub(crate) fn energy_of(&self, strain_squared: f64, trace: f64) -> f64 {
        self.moduli.shear_modulus() * strain_squared + 0.5 * self.moduli.first_lame_parameter() * trace * trace
    }

    /// 2μ ε + λ θ I.
    #[inline]
    pub(crate) fn stress_of<const D: usize>(&self, strain: &Matrix<D>, trace: f64) -> Matrix<D> {
        let pressure = self.moduli.first_lame_parameter() * trace;
        shifted(*strain * (2.0 * self.moduli.shear_modulus()), pressure)
    }

    /// A bound of ρ₀ c², at the elastic F whose stress is 2μ ε + λ θ I: μ (2√(1 + w²) − 1 + 2w) + max(0, λ (1 − θ) + μ
    /// (1 − 2 ε̄)) with w = ε_max − ε_min and ε̄ the midpoint of an interval that holds the principal strains.
    ///
    /// Along a nᵀ the second derivative of ψ is (Ogden, *Non-Linear Elastic Deformations*, ch. 6), with p_i = a_i n_i
    /// and x_ij = ε_i − ε_j,
    ///
    /// λ (a·n)² + Σ_ij μ (x coth x − x) a_i² n_j² + Σ_ij μ (x coth x) p_i p_j − (a·n) (a·τ n).
    ///
    /// 1 ≤ x coth x ≤ √(1 + w²) =: C bounds the two cosh sums by μ C and μ ((a·n)² + C − 1); −Σ x a_i² n_j² ≤ w; and
    /// −2μ (a·n) (a·ε n) ≤ −2μ ε̄ (a·n)² + μ w. What is left is linear in (a·n)², largest at an end of [0, 1].
    #[inline]
    pub(crate) fn wave_modulus<const D: usize>(&self, F: &Matrix<D>, trace: f64) -> f64 {
        let (lambda, mu) = (self.moduli.first_lame_parameter(), self.moduli.shear_modulus());
        let (smallest, largest) = squared_stretch_range(F);
        let (smallest, largest) = (0.5 * smallest.ln(), 0.5 * largest.ln());
        let spread = largest - smallest;
        let along = lambda * (1.0 - trace) + mu * (1.0 - smallest - largest);
        // Not f64::max, which would hide NaN.
        let along = if along < 0.0 { 0.0 } else { along };
        mu * (2.0 * (1.0 + spread * spread).sqrt() - 1.0 + 2.0 * spread) + along
    }
}

impl<const D: usize> Material<D> for Hencky {
    #[inline]
    fn energy_density(&self, F: &Matrix<D>) -> f64 {
        log_strain(F).map_or(f64::NAN, |strain| {
            self.energy_of(strain.contract(&strain), strain.trace())
        })
    }

    #[inline]
    fn kirchhoff_stress(&self, F: &Matrix<D>) -> Matrix<D> {
        log_strain(F).map_or(Matrix([[f64::NAN; D]; D]), |strain| {
            self.stress_of(&strain, strain.trace())
        })
    }

    /// λ ln J.
    fn kirchhoff_stress_across(&self, F: &Matrix<D>) -> Option<f64> {
        Some(self.moduli.first_lame_parameter() * log_volume_ratio(F))
    }

    fn first_piola_kirchhoff(&self, F: &Matrix<D>) -> Matrix<D> {
        Material::kirchhoff_stress(self, F) * inverse_transpose(F)
    }

    /// ρ₀ c² = μ (2√(1 + w²) − 1 + 2w) + max(0, λ (1 − ln J) + μ (1 − 2 ε̄)), w the width and ε̄ the midpoint of a
    /// bound of the principal strains.
    #[inline]
    fn wave_speed(&self, F: &Matrix<D>, reference_density: f64) -> f64 {
        (self.wave_modulus(F, log_volume_ratio(F)) / reference_density).sqrt()
    }
}
