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

#[cfg(test)]
mod tests {
    use super::*;

    fn material() -> LinearElastic {
        LinearElastic::new(ElasticModuli::from_lame(3.0, 2.0).expect("in range"))
    }

    #[test]
    fn a_shear_gives_the_hand_calculation() {
        let F = Matrix([[1.0, 0.2], [0.0, 1.0]]);
        assert!((material().energy_density(&F) - 0.04).abs() < 1e-16);
        let P = material().first_piola_kirchhoff(&F);
        assert!((P - Matrix([[0.0, 0.4], [0.4, 0.0]])).frobenius_norm() < 1e-15);
        let expected = Matrix([[0.08, 0.4], [0.4, 0.0]]);
        assert!((material().kirchhoff_stress(&F) - expected).frobenius_norm() < 1e-15);
    }

    #[test]
    fn a_half_turn_is_taken_for_a_strain() {
        let half_turn = Matrix::diagonal(&[-1.0, -1.0, 1.0]);
        assert_eq!(material().energy_density(&half_turn), 8.0 * 2.0 + 8.0 * 3.0);
    }

    #[test]
    fn a_bar_without_poisson_ratio_follows_hooke() {
        let bar = LinearElastic::new(ElasticModuli::new(7.0, 0.0).expect("in range"));
        let F = Matrix([[1.25]]);
        assert_eq!(bar.first_piola_kirchhoff(&F), Matrix([[7.0 * 0.25]]));
        assert_eq!(bar.energy_density(&F), 3.5 * 0.0625);
        assert_eq!(bar.wave_speed(&Matrix([[1.0]]), 7.0), 1.0);
    }
}
