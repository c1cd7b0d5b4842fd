//! Linear elasticity.

use mpm_tensor::Matrix;

use crate::material::{check_finite, shifted};
use crate::stretch::largest_squared_stretch;
use crate::{DeformationError, ElasticModuli, Material};

/// The linear elastic solid of small strain, ψ = μ ε : ε + λ/2 (tr ε)² with ε = ½ (F + Fᵀ) − I.
///
/// P = 2μ ε + λ tr ε I, τ = P Fᵀ. **Not objective**: ψ(Q F) ≠ ψ(F) for a finite rotation Q, which the law takes for a
/// strain (a half turn in a plane costs ψ = 8μ + 8λ), and τ is symmetric only to first order in F − I, so angular
/// momentum is lost at finite strain. Meant for small displacements and as the simplest law of the ParVI paper (Huang,
/// arXiv 2407.20287). Any finite F is admissible, inverted ones too: nothing resists J → 0.
///
/// Source: Landau & Lifshitz, *Theory of Elasticity*, 3rd ed., Eq. 4.1 (with the −I of the strain written out).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearElastic {
    /// λ and μ.
    pub moduli: ElasticModuli,
}

impl LinearElastic {
    /// The material with these moduli.
    pub fn new(moduli: ElasticModuli) -> Self {
        Self { moduli }
    }
}

/// ε = ½ (F + Fᵀ) − I.
#[inline]
fn small_strain<const D: usize>(F: &Matrix<D>) -> Matrix<D> {
    (*F - Matrix::IDENTITY).symmetric_part()
}

impl<const D: usize> Material<D> for LinearElastic {
    #[inline]
    fn energy_density(&self, F: &Matrix<D>) -> f64 {
        let strain = small_strain(F);
        let trace = strain.trace();
        self.moduli.shear_modulus() * strain.contract(&strain)
            + 0.5 * self.moduli.first_lame_parameter() * trace * trace
    }

    #[inline]
    fn kirchhoff_stress(&self, F: &Matrix<D>) -> Matrix<D> {
        self.first_piola_kirchhoff(F) * F.transpose()
    }

    /// λ tr ε.
    fn kirchhoff_stress_across(&self, F: &Matrix<D>) -> Option<f64> {
        Some(self.moduli.first_lame_parameter() * small_strain(F).trace())
    }

    #[inline]
    fn first_piola_kirchhoff(&self, F: &Matrix<D>) -> Matrix<D> {
        let strain = small_strain(F);
        let pressure = self.moduli.first_lame_parameter() * strain.trace();
        shifted(strain * (2.0 * self.moduli.shear_modulus()), pressure)
    }

    /// c = Λ √((λ + 2μ)/ρ₀) with a bound of the largest stretch Λ of F: the stress is linear in F, but nodes feel P Fᵀ.
    #[inline]
    fn wave_speed(&self, F: &Matrix<D>, reference_density: f64) -> f64 {
        (self.moduli.p_wave_modulus() * largest_squared_stretch(F) / reference_density).sqrt()
    }

    fn check(&self, F: &Matrix<D>) -> Result<(), DeformationError> {
        check_finite(F)
    }
}
