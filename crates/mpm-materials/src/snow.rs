//! Snow: fixed corotated elasticity within bounds of stretch, which hardens as it is packed.

use mpm_tensor::{Matrix, SymmetricEigen};

use crate::any_law::remembered;
use crate::error::{not_negative, positive, within};
use crate::stretch::left_cauchy_green;
use crate::{DeformationError, ElasticModuli, FixedCorotated, Law, Material, ParameterError};

/// Internal variables of [`Snow`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SnowState {
    /// ln J_P, the volume that plastic flow has left: below 0 packed, above 0 loosened.
    pub log_plastic_volume: f64,
}

remembered!(SnowState: log_plastic_volume);

/// Elasto-plastic snow: ψ = h ψ_E(F_E) with the [`FixedCorotated`] ψ_E and the hardening h = e^(ξ (1 − J_P)), F = F_E F_P, J_P = det F_P; τ = h τ_E(F_E).
///
/// **Return mapping** of a trial F_E with singular values σ_a: each is clamped to [1 − θ_c, 1 + θ_s] in its own direction, and J_P takes what that leaves of the volume, so that det F is kept. Within the bounds
/// the snow is elastic; pressed beyond θ_c it is packed and hardens, drawn beyond θ_s it loosens and breaks.
///
/// The law is made for pictures: h changes the energy stored at the same F_E, so that packing may raise it. [`volume_ratio`](Law::volume_ratio) is det F_E · J_P.
///
/// **Defined for det F_E > 0 only**, as [`FixedCorotated`].
///
/// Source: Stomakhin, Schroeder, Chai, Teran & Selle, *A material point method for snow simulation*, ACM Trans. Graph. 32, 2013, Eq. 1 and 2, §7; θ_c = 0.025, θ_s = 0.0075, ξ = 10 are those of its Table 2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Snow {
    elastic: FixedCorotated,
    critical_compression: f64,
    critical_stretch: f64,
    hardening: f64,
}

impl Snow {
    /// θ_c, θ_s and ξ of the source.
    pub const FRESH: [f64; 3] = [0.025, 0.0075, 10.0];

    /// The material with these moduli at J_P = 1, the critical compression θ_c and stretch θ_s, and the hardening ξ.
    ///
    /// # Errors
    ///
    /// [`ParameterError`] unless 0 < θ_c < 1, 0 < θ_s < ∞ and 0 ≤ ξ < ∞.
    pub fn new(
        moduli: ElasticModuli,
        critical_compression: f64,
        critical_stretch: f64,
        hardening: f64,
    ) -> Result<Self, ParameterError> {
        let (compression, expected) = (critical_compression, "above 0 and below 1");
        let part = compression > 0.0 && compression < 1.0;
        Ok(Self {
            elastic: FixedCorotated::new(moduli),
            critical_compression: within("critical_compression", compression, part, expected)?,
            critical_stretch: positive("critical_stretch", critical_stretch)?,
            hardening: not_negative("hardening", hardening)?,
        })
    }

    /// Fresh snow, θ_c = 0.025, θ_s = 0.0075, ξ = 10, with these moduli.
    pub fn fresh(moduli: ElasticModuli) -> Self {
        let [critical_compression, critical_stretch, hardening] = Self::FRESH;
        Self {
            elastic: FixedCorotated::new(moduli),
            critical_compression,
            critical_stretch,
            hardening,
        }
    }

    /// h = e^(ξ (1 − J_P)).
    fn stiffening(&self, state: &SnowState) -> f64 {
        (self.hardening * -state.log_plastic_volume.exp_m1()).exp()
    }
}

impl<const D: usize> Law<D> for Snow {
    type State = SnowState;

    fn internal_variables(&self) -> &'static [&'static str] {
        &["log_plastic_volume"]
    }

    fn advance(&self, trial: &Matrix<D>, state: &mut SnowState) -> Matrix<D> {
        if Material::check(&self.elastic, trial).is_err() {
            return *trial;
        }
        let Some(eigen) = SymmetricEigen::new(&left_cauchy_green(trial)) else {
            return *trial;
        };
        let bounds = [1.0 - self.critical_compression, 1.0 + self.critical_stretch];
        let kept = eigen.values.map(|square| {
            let stretch = square.sqrt();
            stretch.clamp(bounds[0], bounds[1]) / stretch
        });
        // A stretch whose square is lost to rounding cannot be returned: the check that follows finds what is left of it.
        if kept.iter().all(|share| *share == 1.0) || !kept.iter().all(|share| *share > 0.0 && share.is_finite()) {
            return *trial;
        }
        state.log_plastic_volume -= kept.iter().map(|share| share.ln()).sum::<f64>();
        let mut scaled = eigen.vectors;
        for row in &mut scaled.0 {
            for (entry, share) in row.iter_mut().zip(&kept) {
                *entry *= share;
            }
        }
        scaled * eigen.vectors.transpose() * *trial
    }

    fn energy_density(&self, F: &Matrix<D>, state: &SnowState) -> f64 {
        Material::energy_density(&self.elastic, F) * self.stiffening(state)
    }

    fn kirchhoff_stress(&self, F: &Matrix<D>, state: &SnowState, _velocity_gradient: &Matrix<D>) -> Matrix<D> {
        Material::kirchhoff_stress(&self.elastic, F) * self.stiffening(state)
    }

    /// h times that of the elastic part: a stretch of one is within all bounds.
    fn kirchhoff_stress_across(&self, F: &Matrix<D>, state: &SnowState) -> Option<f64> {
        let elastic = Material::kirchhoff_stress_across(&self.elastic, F)?;
        Some(elastic * self.stiffening(state))
    }

    fn wave_speed(&self, F: &Matrix<D>, state: &SnowState, reference_density: f64) -> f64 {
        Material::wave_speed(&self.elastic, F, reference_density) * self.stiffening(state).sqrt()
    }

    fn check(&self, F: &Matrix<D>) -> Result<(), DeformationError> {
        Material::check(&self.elastic, F)
    }

    fn volume_ratio(&self, F: &Matrix<D>, state: &SnowState) -> f64 {
        F.determinant() * state.log_plastic_volume.exp()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn snow() -> Snow {
        Snow::fresh(ElasticModuli::new(1.0, 0.2).expect("in range"))
    }

    #[test]
    fn within_the_bounds_it_is_elastic() {
        let F = Matrix([[1.004, 0.003], [-0.002, 0.985]]);
        let mut state = SnowState::default();
        assert_eq!(snow().advance(&F, &mut state), F);
        assert_eq!(state, SnowState::default());
        let elastic = FixedCorotated::new(snow().elastic.moduli);
        let stress = snow().kirchhoff_stress(&F, &state, &Matrix::ZERO);
        assert_eq!(stress, Material::kirchhoff_stress(&elastic, &F));
        assert_eq!(
            snow().energy_density(&F, &state),
            Material::energy_density(&elastic, &F)
        );
    }

    #[test]
    fn stretches_are_clamped_in_their_directions_and_the_volume_is_kept() {
        let (sine, cosine) = 0.6_f64.sin_cos();
        let turn = Matrix([[cosine, -sine], [sine, cosine]]);
        let trial = turn * Matrix::diagonal(&[0.9, 1.2]) * turn * turn;
        let mut state = SnowState::default();
        let F = snow().advance(&trial, &mut state);
        let expected = turn * Matrix::diagonal(&[0.975, 1.0075]) * turn * turn;
        assert!((F - expected).maximum_norm() < 1e-14);
        assert!((Law::<2>::volume_ratio(&snow(), &F, &state) - 0.9 * 1.2).abs() < 1e-14);
        let again = snow().advance(&F, &mut state);
        assert!((again - F).maximum_norm() < 1e-14);
    }

    #[test]
    fn packed_snow_is_harder_and_loose_snow_is_softer() {
        let stress_after = |stretch: f64| {
            let mut state = SnowState::default();
            let F = snow().advance(&(Matrix::<3>::IDENTITY * stretch), &mut state);
            let elastic = Material::kirchhoff_stress(&FixedCorotated::new(snow().elastic.moduli), &F);
            let speeds = [SnowState::default(), state].map(|state| snow().wave_speed(&F, &state, 2.0));
            let ratio = snow().kirchhoff_stress(&F, &state, &Matrix::ZERO).trace() / elastic.trace();
            assert!((speeds[1] / speeds[0] - ratio.sqrt()).abs() < 1e-12);
            (ratio, state.log_plastic_volume)
        };
        let (harder, packed) = stress_after(0.9);
        assert!((packed - 3.0 * (0.9_f64 / 0.975).ln()).abs() < 1e-14);
        assert!((harder - (10.0 * (1.0 - packed.exp())).exp()).abs() < 1e-12 && harder > 1.0);
        let (softer, loosened) = stress_after(1.1);
        assert!(softer < 1.0 && loosened > 0.0);
    }

    #[test]
    fn the_stress_is_the_gradient_of_the_energy_at_the_same_plastic_volume() {
        let F = Matrix([[1.1, 0.2], [-0.1, 0.9]]);
        let state = SnowState {
            log_plastic_volume: -0.05,
        };
        let stress = snow().kirchhoff_stress(&F, &state, &Matrix::ZERO);
        let step = 1e-6;
        for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let energy = |step: f64| {
                let mut change = Matrix::IDENTITY;
                change.0[i][j] += step;
                snow().energy_density(&(change * F), &state)
            };
            // τ = ∂ψ/∂F Fᵀ: the derivative along F ← (I + t e_i e_jᵀ) F.
            let slope = (energy(step) - energy(-step)) / (2.0 * step);
            assert!(
                (slope - stress.0[i][j]).abs() < 1e-8,
                "{i} {j}: {slope} and {}",
                stress.0[i][j]
            );
        }
    }

    #[test]
    fn parameters_out_of_range_are_named() {
        let moduli = snow().elastic.moduli;
        for (numbers, name) in [
            ([1.0, 0.1, 1.0], "critical_compression"),
            ([0.0, 0.1, 1.0], "critical_compression"),
            ([0.1, 0.0, 1.0], "critical_stretch"),
            ([0.1, f64::NAN, 1.0], "critical_stretch"),
            ([0.1, 0.1, -1.0], "hardening"),
        ] {
            let error = Snow::new(moduli, numbers[0], numbers[1], numbers[2]).expect_err("out of range");
            assert_eq!(error.parameter().0, name);
        }
    }
}
