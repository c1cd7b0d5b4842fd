//! The Kelvin–Voigt solid: a spring beside a dashpot.

use mpm_tensor::Matrix;

use crate::error::{not_negative, positive};
use crate::{DeformationError, ElasticModuli, Law, Material, NeoHookean, ParameterError};

/// Visco-elasticity after Kelvin and Voigt at large strain: the [`NeoHookean`] spring beside a Newtonian dashpot, σ = σ_e(F) + 2 η d.
///
/// τ = τ_e(F) + 2 η J d with the rate d = ½ (L + Lᵀ), the viscosity η (stress × time) and J = det F. The dashpot resists every rate, that of volume too, in any D: in D = 1 the law is σ = σ_e + 2 η ε̇. It
/// is objective, and it dissipates 2 η J d : d ≥ 0 per reference volume. The energy stored is that of the spring.
///
/// **Defined for J > 0 only**, as the spring is. The wave speed is the spring's and does not hold the viscous limit of an explicit step, h² ρ₀ / (4 D η) for the spacing h, which the law says where it
/// knows its density ([`with_reference_density`](Self::with_reference_density)).
///
/// Source: the one-dimensional model in Simo & Hughes, *Computational Inelasticity*, ch. 10; Landau & Lifshitz, *Theory of Elasticity*, 3rd ed., Eq. 34.5 for the viscous stress (2η d, and ζ = 2η/D).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KelvinVoigt {
    spring: NeoHookean,
    viscosity: f64,
    reference_density: Option<f64>,
}

impl KelvinVoigt {
    /// The material with these moduli and the viscosity η, which may be zero.
    ///
    /// # Errors
    ///
    /// [`ParameterError`] unless 0 ≤ η < ∞.
    pub fn new(moduli: ElasticModuli, viscosity: f64) -> Result<Self, ParameterError> {
        Ok(Self {
            spring: NeoHookean::new(moduli),
            viscosity: not_negative("viscosity", viscosity)?,
            reference_density: None,
        })
    }

    /// The same, of a density ρ₀ at rest.
    ///
    /// # Errors
    ///
    /// [`ParameterError`] unless 0 < ρ₀ < ∞.
    pub fn with_reference_density(self, reference_density: f64) -> Result<Self, ParameterError> {
        Ok(Self {
            reference_density: Some(positive("density", reference_density)?),
            ..self
        })
    }
}

impl<const D: usize> Law<D> for KelvinVoigt {
    type State = ();

    #[inline]
    fn rate_dependent(&self) -> bool {
        self.viscosity > 0.0
    }

    /// h² ρ₀ / (4 D η) for the spacing h; infinite without a density.
    fn longest_viscous_step(&self, spacing: f64) -> f64 {
        let inertia = self
            .reference_density
            .map_or(f64::INFINITY, |density| spacing * spacing * density);
        if self.viscosity == 0.0 {
            return f64::INFINITY;
        }
        inertia / (4.0 * D as f64 * self.viscosity)
    }

    #[inline]
    fn energy_density(&self, F: &Matrix<D>, _state: &()) -> f64 {
        Material::energy_density(&self.spring, F)
    }

    #[inline]
    fn kirchhoff_stress(&self, F: &Matrix<D>, _state: &(), velocity_gradient: &Matrix<D>) -> Matrix<D> {
        let elastic = Material::kirchhoff_stress(&self.spring, F);
        if self.viscosity == 0.0 {
            return elastic;
        }
        elastic + velocity_gradient.symmetric_part() * (2.0 * self.viscosity * F.determinant())
    }

    /// That of the spring: nothing moves across.
    fn kirchhoff_stress_across(&self, F: &Matrix<D>, _state: &()) -> Option<f64> {
        Material::kirchhoff_stress_across(&self.spring, F)
    }

    #[inline]
    fn wave_speed(&self, F: &Matrix<D>, _state: &(), reference_density: f64) -> f64 {
        Material::wave_speed(&self.spring, F, reference_density)
    }

    fn check(&self, F: &Matrix<D>) -> Result<(), DeformationError> {
        Material::check(&self.spring, F)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn law(viscosity: f64) -> KelvinVoigt {
        KelvinVoigt::new(ElasticModuli::from_lame(3.0, 2.0).expect("in range"), viscosity).expect("in range")
    }

    #[test]
    fn the_dashpot_is_beside_the_spring() {
        let F = Matrix([[1.2, 0.1], [-0.3, 0.9]]);
        let rate = Matrix([[1.0, 4.0], [-2.0, 0.5]]);
        let spring = Material::kirchhoff_stress(&NeoHookean::new(law(0.0).spring.moduli), &F);
        assert_eq!(law(0.0).kirchhoff_stress(&F, &(), &rate), spring);
        let dashpot = law(0.7).kirchhoff_stress(&F, &(), &rate) - spring;
        let expected = Matrix([[1.0, 1.0], [1.0, 0.5]]) * (2.0 * 0.7 * 1.11);
        assert!((dashpot - expected).frobenius_norm() < 1e-14);
        assert!(Law::<2>::rate_dependent(&law(0.7)) && !Law::<2>::rate_dependent(&law(0.0)));
    }

    /// A bar that is held at a constant rate of strain and then let go of: σ − σ_e = 2 η ε̇, which vanishes at rest.
    #[test]
    fn a_bar_follows_the_model_in_one_dimension() {
        let (F, rate) = (Matrix([[1.3]]), Matrix([[0.4]]));
        let moving = law(0.5).kirchhoff_stress(&F, &(), &rate).0[0][0];
        let resting = law(0.5).kirchhoff_stress(&F, &(), &Matrix::ZERO).0[0][0];
        assert!((moving / 1.3 - resting / 1.3 - 2.0 * 0.5 * 0.4).abs() < 1e-15);
    }

    #[test]
    fn no_rate_gains_energy_and_a_spin_feels_no_dashpot() {
        let F = Matrix([[0.8, 0.3], [0.1, 1.4]]);
        let resting = law(0.5).kirchhoff_stress(&F, &(), &Matrix::ZERO);
        for rate in [Matrix([[1.0, -2.0], [0.3, 4.0]]), Matrix([[-1.0, 0.0], [5.0, -1.0]])] {
            let viscous = law(0.5).kirchhoff_stress(&F, &(), &rate) - resting;
            assert!(viscous.contract(&rate) > 0.0);
        }
        let spin = Matrix([[0.0, 1.0], [-1.0, 0.0]]);
        assert_eq!(law(0.5).kirchhoff_stress(&F, &(), &spin), resting);
    }

    #[test]
    fn a_viscosity_out_of_range_is_named() {
        for value in [-1.0, f64::INFINITY] {
            let error = KelvinVoigt::new(law(0.0).spring.moduli, value).expect_err("out of range");
            assert_eq!(error.parameter(), ("viscosity", value));
            let error = law(0.5).with_reference_density(value).expect_err("out of range");
            assert_eq!(error.parameter(), ("density", value));
        }
    }

    #[test]
    fn a_viscous_step_has_a_density() {
        let step = |law: KelvinVoigt| Law::<2>::longest_viscous_step(&law, 0.1);
        let of_density = |law: KelvinVoigt| law.with_reference_density(3.0).expect("in range");
        assert_eq!(step(of_density(law(0.5))), 0.1 * 0.1 * 3.0 / (4.0 * 2.0 * 0.5));
        assert_eq!([step(law(0.5)), step(of_density(law(0.0)))], [f64::INFINITY; 2]);
    }
}
