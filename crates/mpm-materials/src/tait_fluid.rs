//! The weakly compressible fluid.

use mpm_tensor::Matrix;

use crate::error::{not_negative, positive, within};
use crate::material::{shifted, volume_alone, volume_ratio};
use crate::{Law, ParameterError};

/// The exponent γ of the equation of state, that of water.
const EXPONENT: f64 = 7.0;

/// The weakly compressible Newtonian fluid with Tait's equation of state, p = max(0, ρ₀ c²/7 ((ρ/ρ₀)⁷ − 1)), ρ = ρ₀/J.
///
/// τ = J (−p I + 2 μ_v dev d) with the viscosity μ_v (stress × time), the rate d = ½ (L + Lᵀ) and its deviator in D
/// dimensions (so a bar has no viscosity). Per reference volume ψ = ρ₀ c²/7 (J⁻⁶/6 + J − 7/6) for J < 1 and zero above.
/// c is the speed of sound at rest; about ten times the fastest flow keeps changes of density near a percent. Only the
/// volume is remembered: [`advance`](Law::advance) returns J^(1/D) I.
///
/// **No tension.** A fluid pulled apart, J > 1, has no pressure, and viscosity alone acts. What happens to its volume
/// is a choice:
///
/// * By default J is followed, as material point codes do (NairnMPM's Tait liquid, for one): a drop that returns feels
///   no pressure before it has its reference volume again. The error of J, which is integrated and never measured, can
///   leave a fluid that has splashed a long time too dense.
/// * [`forgetting_expansion`](Self::forgetting_expansion) sets J to 1 wherever it is above. Every compression is then
///   felt at once, but expansions are lost and compressions are not, so a volume that breathes about J = 1 creeps
///   apart: choose it for spray, not for long rest.
///
/// **Defined for J > 0 only**: otherwise [`Law::check`] fails with J, and the other methods give NaN. The wave speed
/// does not hold the viscous limit of an explicit step, Δt ≲ h² ρ / (2 D μ_v) for the cell size h
/// and the dynamic viscosity μ_v.
///
/// Source: Monaghan, *Simulating free surface flows with SPH*, J. Comput. Phys. 110, 1994 (equation of state); Landau &
/// Lifshitz, *Fluid Mechanics*, 2nd ed., Eq. 15.3 (viscous stress, here without a bulk viscosity in D dimensions).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TaitFluid {
    reference_density: f64,
    sound_speed: f64,
    viscosity: f64,
    forgets_expansion: bool,
}

impl TaitFluid {
    /// The fluid with density ρ₀ and speed of sound c at rest, and dynamic viscosity μ_v, which may be zero.
    ///
    /// # Errors
    ///
    /// [`ParameterError`] unless 0 < ρ₀ < ∞, 0 < c < ∞, ρ₀ c² is positive and finite and 0 ≤ μ_v < ∞.
    pub fn new(reference_density: f64, sound_speed: f64, viscosity: f64) -> Result<Self, ParameterError> {
        let reference_density = positive("density", reference_density)?;
        let bulk_modulus = reference_density * sound_speed * sound_speed;
        let sound = sound_speed > 0.0 && sound_speed.is_finite() && bulk_modulus > 0.0 && bulk_modulus.is_finite();
        let expected = "positive and finite, also its square times the density";
        Ok(Self {
            reference_density,
            sound_speed: within("sound_speed", sound_speed, sound, expected)?,
            viscosity: not_negative("viscosity", viscosity)?,
            forgets_expansion: false,
        })
    }

    /// The same fluid, with J set to 1 in [`advance`](Law::advance) where it is above.
    pub fn forgetting_expansion(self) -> Self {
        Self {
            forgets_expansion: true,
            ..self
        }
    }

    /// The pressure p at the volume ratio J = ρ₀/ρ; NaN unless 0 < J < ∞.
    #[inline]
    pub fn pressure(&self, volume_ratio: f64) -> f64 {
        let J = volume_ratio;
        if !(J > 0.0 && J < f64::INFINITY) {
            f64::NAN
        } else if J < 1.0 {
            self.bulk_modulus() / EXPONENT * (J.powi(-7) - 1.0)
        } else {
            0.0
        }
    }

    /// ρ₀ c², the bulk modulus at rest.
    #[inline]
    fn bulk_modulus(&self) -> f64 {
        self.reference_density * self.sound_speed * self.sound_speed
    }
}

impl<const D: usize> Law<D> for TaitFluid {
    type State = ();

    #[inline]
    fn rate_dependent(&self) -> bool {
        self.viscosity > 0.0
    }

    /// h² ρ₀ / (2 D μ_v) for the spacing h.
    fn longest_viscous_step(&self, spacing: f64) -> f64 {
        if self.viscosity == 0.0 {
            return f64::INFINITY;
        }
        spacing * spacing * self.reference_density / (2.0 * D as f64 * self.viscosity)
    }

    #[inline]
    fn advance(&self, trial: &Matrix<D>, _state: &mut ()) -> Matrix<D> {
        if self.forgets_expansion && trial.determinant() > 1.0 && trial.determinant() < f64::INFINITY {
            return Matrix::IDENTITY;
        }
        volume_alone(trial)
    }

    #[inline]
    fn energy_density(&self, F: &Matrix<D>, _state: &()) -> f64 {
        let J = F.determinant();
        if J > 0.0 && J < 1.0 {
            // With y = 1/J the bracket is (y⁷ − 7y + 6) / 6y, whose double root at y = 1 is taken out.
            let y = 1.0 / J;
            let excess = (1.0 - J) / J;
            let quotient = 6.0 + y * (5.0 + y * (4.0 + y * (3.0 + y * (2.0 + y))));
            self.bulk_modulus() / EXPONENT * excess * excess * quotient * (J / 6.0)
        } else {
            self.pressure(J)
        }
    }

    #[inline]
    fn kirchhoff_stress(&self, F: &Matrix<D>, _state: &(), velocity_gradient: &Matrix<D>) -> Matrix<D> {
        let J = F.determinant();
        let pressure = self.pressure(J);
        let mut isotropic = -J * pressure;
        if self.viscosity == 0.0 {
            return Matrix::diagonal(&[isotropic; D]);
        }
        let factor = 2.0 * self.viscosity * J;
        let stress = velocity_gradient.symmetric_part() * factor;
        isotropic -= stress.trace() / D as f64;
        shifted(stress, isotropic)
    }

    /// −J p: the deviator of D dimensions has no part across.
    fn kirchhoff_stress_across(&self, F: &Matrix<D>, _state: &()) -> Option<f64> {
        let J = F.determinant();
        Some(-J * self.pressure(J))
    }

    /// c J⁻³ √(ρ₀ / `reference_density`) for J < 1; at J ≥ 1 the speed at rest, with which the fluid is met when it
    /// comes together.
    #[inline]
    fn wave_speed(&self, F: &Matrix<D>, _state: &(), reference_density: f64) -> f64 {
        // NaN stays NaN.
        let stiffening = match volume_ratio(F) {
            J if J >= 1.0 => 1.0,
            J => J.powi(-3),
        };
        self.sound_speed * stiffening * (self.reference_density / reference_density).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::DeformationError;

    fn water() -> TaitFluid {
        TaitFluid::new(2.0, 3.0, 0.0).expect("in range")
    }

    #[test]
    fn half_the_volume_gives_the_hand_calculation() {
        let F = Matrix::diagonal(&[0.5, 1.0]);
        let fluid = water();
        assert!((fluid.pressure(0.5) - 18.0 / 7.0 * 127.0).abs() < 1e-12);
        let energy = 18.0 / 7.0 * (64.0 / 6.0 + 0.5 - 7.0 / 6.0);
        assert!((fluid.energy_density(&F, &()) - energy).abs() < 1e-13);
        let stress = fluid.kirchhoff_stress(&F, &(), &Matrix([[5.0, 1.0], [2.0, 7.0]]));
        assert!((stress + Matrix::IDENTITY * (9.0 / 7.0 * 127.0)).frobenius_norm() < 1e-12);
        assert!((Law::<2>::wave_speed(&fluid, &F, &(), 2.0) - 24.0).abs() < 1e-13);
        assert!(!Law::<2>::rate_dependent(&fluid));
    }

    #[test]
    fn a_small_compression_keeps_the_digits_of_its_energy() {
        // ψ = ½ ρ₀ c² x² (1 + O(x)) with x = 1 − J.
        let energy = water().energy_density(&Matrix([[1.0 - 2f64.powi(-40)]]), &());
        assert!((energy / (9.0 * 2f64.powi(-80)) - 1.0).abs() < 1e-11);
    }

    #[test]
    fn viscosity_acts_on_the_rate_of_shear_alone() {
        let oil = TaitFluid::new(1.0, 1.0, 0.5).expect("in range");
        let velocity_gradient = Matrix([[4.0, 3.0], [1.0, 2.0]]);
        let stress = oil.kirchhoff_stress(&(Matrix::IDENTITY * 2.0), &(), &velocity_gradient);
        assert!((stress - Matrix([[4.0, 8.0], [8.0, -4.0]])).frobenius_norm() < 1e-14);
        assert!(Law::<2>::rate_dependent(&oil));
        let spin = Matrix([[0.0, 1.0], [-1.0, 0.0]]);
        assert_eq!(oil.kirchhoff_stress(&Matrix::IDENTITY, &(), &spin), Matrix::ZERO);
        let turning_and_swelling = spin + Matrix::IDENTITY;
        let stress = oil.kirchhoff_stress(&Matrix::IDENTITY, &(), &turning_and_swelling);
        assert_eq!(stress, Matrix::ZERO);
    }

    #[test]
    fn only_the_volume_is_kept_and_expansion_as_chosen() {
        let F = Matrix([[1.5, 0.5], [0.2, 1.1]]);
        let kept = water().advance(&F, &mut ());
        assert!((kept.determinant() / F.determinant() - 1.0).abs() < 1e-15);
        assert_eq!(kept.0[0], [kept.0[1][1], 0.0]);
        assert_eq!(water().kirchhoff_stress(&kept, &(), &Matrix::ZERO), Matrix::ZERO);
        let forgetful = water().forgetting_expansion();
        assert_eq!(forgetful.advance(&F, &mut ()), Matrix::IDENTITY);
        let pressed = F * 0.5;
        assert_eq!(forgetful.advance(&pressed, &mut ()), water().advance(&pressed, &mut ()));
    }

    #[test]
    fn an_inverted_particle_is_an_error_with_its_volume_ratio() {
        let F = Matrix::diagonal(&[1.0, -0.5]);
        assert_eq!(water().advance(&F, &mut ()), F);
        let error = Law::<2>::check(&water(), &F).expect_err("inverted");
        assert_eq!(error, DeformationError::VolumeRatio { volume_ratio: -0.5 });
        assert!(water().kirchhoff_stress(&F, &(), &Matrix::ZERO).trace().is_nan());
        assert!(water().energy_density(&F, &()).is_nan());
        assert!(Law::<2>::wave_speed(&water(), &F, &(), 1.0).is_nan());
    }

    #[test]
    fn parameters_out_of_range_are_named() {
        let refused = |density, speed, viscosity| {
            let fluid = TaitFluid::new(density, speed, viscosity);
            fluid.expect_err("out of range").parameter()
        };
        for value in [0.0, -1.0, f64::INFINITY] {
            assert_eq!(refused(value, 1.0, 0.0), ("density", value));
            assert_eq!(refused(1.0, value, 0.0), ("sound_speed", value));
        }
        for value in [-1.0, f64::INFINITY] {
            assert_eq!(refused(1.0, 1.0, value), ("viscosity", value));
        }
        assert!(TaitFluid::new(1.0, 1.0, f64::NAN).is_err());
        let overflow = refused(1.0, 1e200, 0.0);
        assert_eq!(overflow, ("sound_speed", 1e200), "the bulk modulus overflows");
    }
}
