//! Dry or cohesive granular material: friction without dilation.

use mpm_tensor::Matrix;

use crate::any_law::remembered;
use crate::error::{not_negative, within};
use crate::exponential::exponential;
use crate::log_strain::log_strain;
use crate::material::{log_volume_ratio, shifted};
use crate::{ElasticModuli, Hencky, Law, Material, ParameterError};

/// Internal variables of [`DruckerPrager`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DruckerPragerState {
    /// v_c ≥ 0, the logarithmic volume strain by which the grains have come apart: ln J is ln det F + v_c.
    pub volume_correction: f64,
}

remembered!(DruckerPragerState: volume_correction);

/// Drucker–Prager plasticity without dilation on the [`Hencky`] solid, for sand and gravel.
///
/// With s = dev τ and p = −tr τ/D in D dimensions, the friction angle φ and the cohesion c (a stress),
///
/// ‖s‖ ≤ M (p + c cot φ), M = √((D−1)/D) · 2D sin φ / (D − (D−2) sin φ),
///
/// the cone through the compression edges (one axis pressed harder than the D − 1 others) of the Mohr–Coulomb criterion:
/// half the difference of the extreme pressures is at most half their sum times sin φ, plus c cos φ. M is
/// 2√6 sin φ / (3 − sin φ) for D = 3, and √2 sin φ for D = 2, plane strain, where the cone *is* Mohr–Coulomb in the
/// plane. A bar (D = 1) has no deviator: only tension is cut.
///
/// **Return mapping** of the trial with the logarithmic strain ε and θ = tr ε + v_c:
///
/// * Opening. Where −p exceeds the tensile strength c cot φ the grains come apart: F becomes the rotation of the trial,
///   so that the stress is zero, and v_c = θ remembers the volume gained. A gap, v_c > 0, has no strength: it stays
///   free of stress while θ > 0.
/// * Closing. For θ ≤ 0 the gap is given back, v_c = 0 and tr ε = θ; contact restores the cohesion. Without v_c the
///   material would resist before the grains touch, and gain volume with each cycle.
/// * Sliding. A deviator outside the cone shrinks onto it at the same p: the flow is deviatoric and keeps the volume
///   (no dilation; not associated).
///
/// No return raises the energy (where λ + 2μ/D > 0). [`volume_ratio`](Law::volume_ratio) is det F e^(v_c).
///
/// Source: Klar et al., *Drucker–Prager elastoplasticity for sand animation*, ACM Trans. Graph. 35, 2016 (Hencky
/// strain, the three cases); Tampubolon et al., *Multi-species simulation of porous sand and water mixtures*, ACM
/// Trans. Graph. 36, 2017 (volume correction). M is derived here: the pressures a, b, …, b with a − b = (a + b) sin φ
/// have ‖s‖ = √((D−1)/D) (a − b) and D p = a + (D−1) b; cohesion moves the apex to p = −c cot φ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DruckerPrager {
    elastic: Hencky,
    /// sin φ.
    friction_sine: f64,
    /// cot φ.
    friction_cotangent: f64,
    cohesion: f64,
}

impl DruckerPrager {
    /// The material without cohesion; the friction angle φ in radians.
    ///
    /// # Errors
    ///
    /// [`ParameterError`] unless 0 < φ < π/2.
    pub fn new(moduli: ElasticModuli, friction_angle: f64) -> Result<Self, ParameterError> {
        let acute = friction_angle > 0.0 && friction_angle < std::f64::consts::FRAC_PI_2;
        let expected = "strictly between 0 and pi/2 (radians)";
        let friction_angle = within("friction_angle", friction_angle, acute, expected)?;
        Ok(Self {
            elastic: Hencky::new(moduli),
            friction_sine: friction_angle.sin(),
            friction_cotangent: friction_angle.tan().recip(),
            cohesion: 0.0,
        })
    }

    /// The same material with cohesion c (stress).
    ///
    /// # Errors
    ///
    /// [`ParameterError`] unless 0 ≤ c < ∞.
    pub fn with_cohesion(self, cohesion: f64) -> Result<Self, ParameterError> {
        let cohesion = not_negative("cohesion", cohesion)?;
        Ok(Self { cohesion, ..self })
    }

    /// M of ‖s‖ ≤ M (p + c cot φ) in D dimensions.
    #[inline]
    pub fn cone_slope(&self, dimension: usize) -> f64 {
        let (dimension, sine) = (dimension as f64, self.friction_sine);
        ((dimension - 1.0) / dimension).sqrt() * 2.0 * dimension * sine / (dimension - (dimension - 2.0) * sine)
    }

    /// c cot φ, the isotropic tension at the apex of the cone.
    #[inline]
    pub fn tensile_strength(&self) -> f64 {
        self.cohesion * self.friction_cotangent
    }
}

impl<const D: usize> Law<D> for DruckerPrager {
    type State = DruckerPragerState;

    fn internal_variables(&self) -> &'static [&'static str] {
        &["volume_correction"]
    }

    fn advance(&self, trial: &Matrix<D>, state: &mut DruckerPragerState) -> Matrix<D> {
        let Some(strain) = log_strain(trial) else {
            return *trial;
        };
        let trial_trace = strain.trace();
        let trace = trial_trace + state.volume_correction;
        let tension = self.elastic.moduli.bulk_modulus(D) * trace;
        let is_open = state.volume_correction > 0.0;
        let strength = if is_open { 0.0 } else { self.tensile_strength() };
        if trace > 0.0 && tension > strength {
            state.volume_correction = trace;
            return exponential(&-strain) * *trial;
        }
        let strain_deviator = shifted(strain, -(trial_trace / D as f64));
        let deviator = 2.0 * self.elastic.moduli.shear_modulus() * strain_deviator.frobenius_norm();
        let largest = self.cone_slope(D) * (self.tensile_strength() - tension);
        let kept = if deviator > largest { largest / deviator } else { 1.0 };
        if kept == 1.0 && !is_open {
            return *trial;
        }
        let closing = state.volume_correction / D as f64;
        state.volume_correction = 0.0;
        exponential(&shifted(strain_deviator * (kept - 1.0), closing)) * *trial
    }

    #[inline]
    fn energy_density(&self, F: &Matrix<D>, _state: &DruckerPragerState) -> f64 {
        Material::energy_density(&self.elastic, F)
    }

    #[inline]
    fn kirchhoff_stress(
        &self,
        F: &Matrix<D>,
        _state: &DruckerPragerState,
        _velocity_gradient: &Matrix<D>,
    ) -> Matrix<D> {
        Material::kirchhoff_stress(&self.elastic, F)
    }

    /// That of [`Hencky`], also for a gap, so that the step is short enough when it closes.
    #[inline]
    fn wave_speed(&self, F: &Matrix<D>, _state: &DruckerPragerState, reference_density: f64) -> f64 {
        (self.elastic.wave_modulus(F, log_volume_ratio(F)) / reference_density).sqrt()
    }

    /// det F e^(v_c).
    #[inline]
    fn volume_ratio(&self, F: &Matrix<D>, state: &DruckerPragerState) -> f64 {
        F.determinant() * state.volume_correction.exp()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sand() -> DruckerPrager {
        let moduli = ElasticModuli::from_lame(3.0, 2.0).expect("in range");
        DruckerPrager::new(moduli, 30f64.to_radians()).expect("in range")
    }

    fn stretch<const D: usize>(strains: [f64; D]) -> Matrix<D> {
        Matrix::diagonal(&strains.map(f64::exp))
    }

    #[test]
    fn the_cone_is_mohr_coulomb_in_the_plane_and_on_the_compression_edges() {
        assert!((sand().cone_slope(2) - 0.5f64.sqrt()).abs() < 1e-15);
        assert!((sand().cone_slope(3) - 2.0 * 6f64.sqrt() * 0.5 / 2.5).abs() < 1e-15);
        assert_eq!(sand().cone_slope(1), 0.0);
        // At 30 degrees the larger pressure at failure is three times the smaller, (1 + sin φ)/(1 − sin φ).
        let stress = stress_at_failure(stretch([-0.3, 0.0]));
        assert!((stress.0[0][0] / stress.0[1][1] - 3.0).abs() < 1e-14, "{stress:?}");
        let stress = stress_at_failure(stretch([-0.3, 0.0, 0.0]));
        assert!((stress.0[0][0] / stress.0[1][1] - 3.0).abs() < 1e-14, "{stress:?}");
    }

    /// The stress after the return.
    fn stress_at_failure<const D: usize>(trial: Matrix<D>) -> Matrix<D> {
        let mut state = DruckerPragerState::default();
        // A deviator far outside: λ = 3 and μ = 2 alone would keep this inside.
        let soft = ElasticModuli::from_lame(0.1, 2.0).expect("in range");
        let law = DruckerPrager::new(soft, 30f64.to_radians()).expect("in range");
        let F = law.advance(&trial, &mut state);
        assert_ne!(F, trial);
        law.kirchhoff_stress(&F, &state, &Matrix::ZERO)
    }

    #[test]
    fn a_gap_is_closed_before_the_grains_press() {
        let mut state = DruckerPragerState::default();
        let opened = sand().advance(&stretch([0.1, 0.2]), &mut state);
        assert!((opened - Matrix::IDENTITY).frobenius_norm() < 1e-15);
        assert!((state.volume_correction - 0.3).abs() < 1e-15);
        let half_closed = sand().advance(&stretch([-0.1, -0.1]), &mut state);
        assert!((half_closed - Matrix::IDENTITY).frobenius_norm() < 1e-15);
        assert!((state.volume_correction - 0.1).abs() < 1e-15);
        let pressed = sand().advance(&stretch([-0.1, -0.1]), &mut state);
        assert!((pressed - stretch([-0.05, -0.05])).frobenius_norm() < 1e-15);
        assert_eq!(state.volume_correction, 0.0);
    }

    #[test]
    fn cohesion_holds_up_to_the_apex_and_is_lost_beyond_it() {
        let wet = sand().with_cohesion(0.1).expect("in range");
        // Bulk modulus 5 in the plane, apex at 0.1 cot 30°.
        let apex = 0.1 * 3f64.sqrt() / 5.0;
        let mut state = DruckerPragerState::default();
        let held = stretch([0.49 * apex, 0.49 * apex]);
        assert_eq!(wet.advance(&held, &mut state), held);
        let broken = wet.advance(&stretch([0.51 * apex, 0.51 * apex]), &mut state);
        assert!((broken - Matrix::IDENTITY).frobenius_norm() < 1e-15);
        assert!((state.volume_correction - 1.02 * apex).abs() < 1e-15);
        let still_open = wet.advance(&stretch([-0.1 * apex, -0.1 * apex]), &mut state);
        assert!((still_open - Matrix::IDENTITY).frobenius_norm() < 1e-15);
    }

    #[test]
    fn parameters_out_of_range_are_named() {
        let moduli = sand().elastic.moduli;
        for value in [0.0, -0.1, 1.6, f64::INFINITY] {
            let error = DruckerPrager::new(moduli, value).expect_err("out of range");
            assert_eq!(error.parameter(), ("friction_angle", value));
        }
        for value in [-1.0, f64::INFINITY] {
            let error = sand().with_cohesion(value).expect_err("out of range");
            assert_eq!(error.parameter(), ("cohesion", value));
        }
        assert!(DruckerPrager::new(moduli, f64::NAN).is_err() && sand().with_cohesion(f64::NAN).is_err());
    }
}
