//! Linear elasticity between small strain and Cauchy stress.

use mpm_tensor::Matrix;

use crate::material::{check_finite, shifted};
use crate::stretch::largest_squared_stretch;
use crate::{DeformationError, ElasticModuli, Law};

/// Linear elasticity as the MPM-ParVI paper has it: the **Cauchy** stress σ = λ tr ε I + 2μ ε with ε = ½ (F + Fᵀ) − I, so τ = J σ, J = det F.
///
/// [`LinearElastic`](crate::LinearElastic) has the same right side as the first Piola–Kirchhoff stress; both agree to first order in F − I. τ is symmetric, so that angular momentum is
/// kept, but a rotation is taken for a strain, and P = J σ F⁻ᵀ is not the derivative of an energy: beyond small strain a closed cycle of deformations may gain or lose work. Any finite F
/// is admissible, also one turned inside out (J ≤ 0), where the sign of τ turns.
///
/// Source: Huang, arXiv 2407.20287, Eq. 19, with σ in Eq. 30; λ and μ by Eq. 23.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearCauchy {
    /// λ and μ.
    pub moduli: ElasticModuli,
}

impl LinearCauchy {
    /// The material with these moduli.
    pub fn new(moduli: ElasticModuli) -> Self {
        Self { moduli }
    }
}

impl<const D: usize> Law<D> for LinearCauchy {
    type State = ();

    /// μ ε : ε + λ/2 (tr ε)², of which the stress is the derivative for small strain only.
    #[inline]
    fn energy_density(&self, F: &Matrix<D>, _state: &()) -> f64 {
        let strain = (*F - Matrix::IDENTITY).symmetric_part();
        let trace = strain.trace();
        self.moduli.shear_modulus() * strain.contract(&strain)
            + 0.5 * self.moduli.first_lame_parameter() * trace * trace
    }

    #[inline]
    fn kirchhoff_stress(&self, F: &Matrix<D>, _state: &(), _velocity_gradient: &Matrix<D>) -> Matrix<D> {
        let J = F.determinant();
        let strain = (*F - Matrix::IDENTITY).symmetric_part();
        let pressure = self.moduli.first_lame_parameter() * strain.trace() * J;
        shifted(strain * (2.0 * self.moduli.shear_modulus() * J), pressure)
    }

    /// J λ tr ε.
    fn kirchhoff_stress_across(&self, F: &Matrix<D>, _state: &()) -> Option<f64> {
        let strain = (*F - Matrix::IDENTITY).trace();
        Some(self.moduli.first_lame_parameter() * strain * F.determinant())
    }

    /// ρ₀ c² = |J| Λ (|λ| + 2μ) with a bound of the largest stretch Λ of F.
    ///
    /// Along a nᵀ, with g = Fᵀ n, the traction of δP is J (λ (g · a) n + μ (g · n) a + μ (a · n) g), no longer than |J| |g| (|λ| + 2μ), and |g| ≤ Λ. At rest that is the speed of pressure waves for λ ≥ 0.
    #[inline]
    fn wave_speed(&self, F: &Matrix<D>, _state: &(), reference_density: f64) -> f64 {
        let modulus = self.moduli.first_lame_parameter().abs() + 2.0 * self.moduli.shear_modulus();
        let stretch = largest_squared_stretch(F).sqrt();
        (F.determinant().abs() * stretch * modulus / reference_density).sqrt()
    }

    fn check(&self, F: &Matrix<D>) -> Result<(), DeformationError> {
        check_finite(F)
    }
}
