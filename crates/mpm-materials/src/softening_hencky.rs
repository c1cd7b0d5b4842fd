//! Metal plasticity (von Mises) with a yield stress that decays as the material flows.

use mpm_tensor::Matrix;

use crate::any_law::remembered;
use crate::error::{not_negative, positive, within};
use crate::exponential::exponential;
use crate::log_strain::{deviator_bound, log_strain};
use crate::material::{log_volume_ratio, shifted};
use crate::{ElasticModuli, Hencky, Law, ParameterError};

/// Iterations after which Newton's method stops in any case; it needs about five.
const MAXIMUM_ITERATIONS: usize = 100;

/// Strain by which a return stays inside the yield surface: rounding of the next strain must not yield again, for near
/// the point where softening is as steep as elasticity the flow that follows would be far larger than the rounding.
const INSIDE: f64 = 16.0 * f64::EPSILON;

/// Internal variables of [`SofteningHencky`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SofteningState {
    /// ε_q = ∫ √(2/3) ‖dᵖ‖ dt, the accumulated plastic strain; never decreases.
    pub accumulated_plastic_strain: f64,
    /// ε_z, the elastic logarithmic strain along each axis that D < 3 leaves out; zero for D ≥ 3. The total strain
    /// there is zero (plane strain for D = 2, uniaxial strain for D = 1), so ε_z is minus the plastic one.
    pub out_of_plane_strain: f64,
}

remembered!(SofteningState: accumulated_plastic_strain, out_of_plane_strain);

/// J2 (von Mises) plasticity with exponential softening on the [`Hencky`] solid: f = ‖dev τ‖ − κ ≤ 0.
///
/// κ = (κ_p − κ_r) e^(−η ε_q) + κ_r with the peak κ_p, the residual κ_r, the rate η (no unit) and the accumulated
/// plastic strain ε_q = ∫ √(2/3) ‖dᵖ‖ dt. In terms of the uniaxial yield stress σ_y, κ = √(2/3) σ_y. ‖·‖ is the
/// Frobenius norm and dev the deviator of **three** dimensions also for D < 3, where the axes left out do not strain
/// but are stressed: they flow plastically, and the state keeps their elastic strain. For D > 3 it is the deviator of D
/// dimensions. κ_r = κ_p is perfect plasticity.
///
/// **Return mapping.** The trial Fᵉ has the logarithmic strain ε = ½ ln(Fᵉ Fᵉᵀ). Plastic flow is along the deviator
/// (associated, volume preserving), so with s = ‖dev τ‖ of the trial the multiplier Δγ solves
///
/// s − 2μ Δγ − κ(ε_q + √(2/3) Δγ) = 0,
///
/// the deviator shrinks by κ/s, and Fᵉ becomes exp(ε − ε_trial) F_trial. The left side is concave and positive at Δγ =
/// 0, so there is exactly one root, however steep the softening, and Newton's method from the upper end (s − κ_r)/2μ
/// falls monotonically onto it. Softening steeper than elasticity, η (κ_p − κ_r) > √6 μ, drops the stress at once by a
/// finite amount (snap back). Softening localises: results depend on the cell size, unless whoever steps averages ε_q over a length (`nonlocal_radius` of
/// scenes).
///
/// det F is the elastic volume ratio within D dimensions; [`volume_ratio`](Law::volume_ratio) adds the axes left out.
///
/// Source: Simo, *Algorithms for static and dynamic multiplicative plasticity that preserve the classical return
/// mapping schemes of the infinitesimal theory*, CMAME 99, 1992; Simo & Hughes, *Computational Inelasticity*, Box 3.1
/// and ch. 9.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SofteningHencky {
    elastic: Hencky,
    peak: f64,
    residual: f64,
    rate: f64,
}

impl SofteningHencky {
    /// The material with the given moduli, κ_p and κ_r (stress, as ‖dev τ‖) and η (per plastic strain).
    ///
    /// # Errors
    ///
    /// [`ParameterError`] unless 0 < κ_p < ∞, 0 ≤ κ_r ≤ κ_p and 0 ≤ η < ∞.
    pub fn new(
        moduli: ElasticModuli,
        peak_yield_stress: f64,
        residual_yield_stress: f64,
        softening_rate: f64,
    ) -> Result<Self, ParameterError> {
        let peak = positive("peak_yield_stress", peak_yield_stress)?;
        let residual = residual_yield_stress;
        let lower = (0.0..=peak).contains(&residual);
        Ok(Self {
            elastic: Hencky::new(moduli),
            peak,
            residual: within(
                "residual_yield_stress",
                residual,
                lower,
                format!("between 0 and the peak {peak}"),
            )?,
            rate: not_negative("softening_rate", softening_rate)?,
        })
    }

    /// λ and μ of the elastic part.
    pub fn moduli(&self) -> ElasticModuli {
        self.elastic.moduli
    }

    /// κ = (κ_p − κ_r) e^(−η ε_q) + κ_r at the accumulated plastic strain ε_q.
    #[inline]
    pub fn yield_stress(&self, accumulated_plastic_strain: f64) -> f64 {
        (self.peak - self.residual) * (-self.rate * accumulated_plastic_strain).exp() + self.residual
    }

    /// Δγ for the trial s = ‖dev τ‖ > κ(ε_q).
    fn multiplier(&self, trial_stress: f64, plastic_strain: f64) -> f64 {
        let rate_of_strain = (2.0f64 / 3.0).sqrt();
        let twice_shear = 2.0 * self.elastic.moduli.shear_modulus();
        let mut multiplier = (trial_stress - self.residual) / twice_shear;
        for _ in 0..MAXIMUM_ITERATIONS {
            let yield_stress = self.yield_stress(plastic_strain + rate_of_strain * multiplier);
            let excess = trial_stress - twice_shear * multiplier - yield_stress;
            let slope = self.rate * rate_of_strain * (yield_stress - self.residual) - twice_shear;
            let next = multiplier - excess / slope;
            // Monotone from above in exact arithmetic, so a step that does not fall is rounding.
            if !(next < multiplier && next >= 0.0) {
                break;
            }
            multiplier = next;
        }
        multiplier
    }
}

/// The number of axes that D leaves out of three.
const fn axes_left_out(dimension: usize) -> usize {
    3usize.saturating_sub(dimension)
}

/// ε : ε and tr ε over all axes, those left out included.
#[inline]
fn all_invariants<const D: usize>(strain: &Matrix<D>, state: &SofteningState) -> (f64, f64) {
    let (left_out, out_of_plane) = (axes_left_out(D) as f64, state.out_of_plane_strain);
    (
        strain.contract(strain) + left_out * out_of_plane * out_of_plane,
        strain.trace() + left_out * out_of_plane,
    )
}

impl<const D: usize> Law<D> for SofteningHencky {
    type State = SofteningState;

    fn internal_variables(&self) -> &'static [&'static str] {
        &["plastic_strain", "out_of_plane_strain"]
    }

    fn advance(&self, trial: &Matrix<D>, state: &mut SofteningState) -> Matrix<D> {
        let twice_shear = 2.0 * self.elastic.moduli.shear_modulus();
        let plastic_strain = state.accumulated_plastic_strain;
        let yields_at = self.yield_stress(plastic_strain);
        // Far from yield, and in all axes, no logarithm is needed to see it.
        if axes_left_out(D) == 0 && trial.determinant() > 0.0 && twice_shear * deviator_bound(trial) < yields_at {
            return *trial;
        }
        let Some(strain) = log_strain(trial) else {
            return *trial;
        };
        let left_out = axes_left_out(D);
        let mean = all_invariants(&strain, state).1 / (D + left_out) as f64;
        let out_of_plane = state.out_of_plane_strain - mean;
        let in_plane = shifted(strain, -mean);
        let deviator = (in_plane.contract(&in_plane) + left_out as f64 * out_of_plane * out_of_plane).sqrt();
        let trial_stress = twice_shear * deviator;
        if !(trial_stress > yields_at && trial_stress < f64::INFINITY) {
            return *trial;
        }
        let flow = self.multiplier(trial_stress, plastic_strain);
        state.accumulated_plastic_strain = plastic_strain + (2.0f64 / 3.0).sqrt() * flow;
        let returned_stress = self.yield_stress(state.accumulated_plastic_strain) - twice_shear * INSIDE;
        let kept = returned_stress.max(0.0) / trial_stress;
        if left_out > 0 {
            state.out_of_plane_strain = mean + kept * out_of_plane;
        }
        exponential(&(in_plane * (kept - 1.0))) * *trial
    }

    #[inline]
    fn energy_density(&self, F: &Matrix<D>, state: &SofteningState) -> f64 {
        log_strain(F).map_or(f64::NAN, |strain| {
            let (squared, trace) = all_invariants(&strain, state);
            self.elastic.energy_of(squared, trace)
        })
    }

    #[inline]
    fn kirchhoff_stress(&self, F: &Matrix<D>, state: &SofteningState, _velocity_gradient: &Matrix<D>) -> Matrix<D> {
        log_strain(F).map_or(Matrix([[f64::NAN; D]; D]), |strain| {
            self.elastic.stress_of(&strain, all_invariants(&strain, state).1)
        })
    }

    /// 2μ ε_z + λ tr ε over all axes.
    fn kirchhoff_stress_across(&self, F: &Matrix<D>, state: &SofteningState) -> Option<f64> {
        let trace = log_volume_ratio(F) + axes_left_out(D) as f64 * state.out_of_plane_strain;
        let moduli = self.elastic.moduli;
        Some(2.0 * moduli.shear_modulus() * state.out_of_plane_strain + moduli.first_lame_parameter() * trace)
    }

    /// That of [`Hencky`], with the pressure of all axes.
    #[inline]
    fn wave_speed(&self, F: &Matrix<D>, state: &SofteningState, reference_density: f64) -> f64 {
        let trace = log_volume_ratio(F) + axes_left_out(D) as f64 * state.out_of_plane_strain;
        (self.elastic.wave_modulus(F, trace) / reference_density).sqrt()
    }

    /// det F e^((3 − D) ε_z) for D < 3: plastic flow keeps it.
    #[inline]
    fn volume_ratio(&self, F: &Matrix<D>, state: &SofteningState) -> f64 {
        match axes_left_out(D) {
            0 => F.determinant(),
            left_out => F.determinant() * (left_out as f64 * state.out_of_plane_strain).exp(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn moduli() -> ElasticModuli {
        ElasticModuli::from_lame(3.0, 2.0).expect("in range")
    }

    #[test]
    fn a_shear_beyond_yield_gives_the_hand_calculation() {
        // ε = ±0.1 in the plane, so ‖dev τ‖ = 4 · 0.1 √2 returns to κ = 0.2 √2, that is to ε = ±0.05.
        let law = SofteningHencky::new(moduli(), 0.2 * 2f64.sqrt(), 0.2 * 2f64.sqrt(), 0.0).expect("in range");
        let mut state = SofteningState::default();
        let trial = Matrix::diagonal(&[0.1f64.exp(), (-0.1f64).exp()]);
        let F = law.advance(&trial, &mut state);
        let expected = Matrix::diagonal(&[0.05f64.exp(), (-0.05f64).exp()]);
        assert!((F - expected).frobenius_norm() < 2.0 * INSIDE);
        let plastic = (2.0f64 / 3.0).sqrt() * 0.05 * 2f64.sqrt();
        assert!((state.accumulated_plastic_strain - plastic).abs() < 1e-16);
        assert!(state.out_of_plane_strain.abs() < 1e-16);
    }

    /// Uniaxial strain is the same material point in one, two and three dimensions.
    #[test]
    fn the_axes_left_out_are_those_of_three_dimensions() {
        let law = SofteningHencky::new(moduli(), 0.1, 0.02, 5.0).expect("in range");
        let (mut one, mut two, mut three) = Default::default();
        let mut bar = Matrix::diagonal(&[1.0]);
        let mut plate = Matrix::diagonal(&[1.0; 2]);
        let mut block = Matrix::diagonal(&[1.0; 3]);
        // Each step rounds F, and the P-wave modulus 7 makes stress of it.
        let rounding = 40.0 * 7.0 * f64::EPSILON;
        for step in 0..40 {
            let rate = if step < 25 { 0.01 } else { -0.02 };
            bar = law.advance(&Matrix::diagonal(&[bar.0[0][0] * (1.0 + rate)]), &mut one);
            plate = law.advance(&(Matrix::diagonal(&[1.0 + rate, 1.0]) * plate), &mut two);
            block = law.advance(&(Matrix::diagonal(&[1.0 + rate, 1.0, 1.0]) * block), &mut three);
            let stress = law.kirchhoff_stress(&block, &three, &Matrix::ZERO).0[0][0];
            assert!((law.kirchhoff_stress(&bar, &one, &Matrix::ZERO).0[0][0] - stress).abs() < rounding);
            assert!((law.kirchhoff_stress(&plate, &two, &Matrix::ZERO).0[0][0] - stress).abs() < rounding);
            let energy = law.energy_density(&block, &three);
            assert!((law.energy_density(&bar, &one) - energy).abs() < rounding);
            let volume = law.volume_ratio(&block, &three);
            assert!((law.volume_ratio(&bar, &one) - volume).abs() < rounding);
            assert!((law.volume_ratio(&plate, &two) - volume).abs() < rounding);
        }
        assert!(three.accumulated_plastic_strain > 0.1 && three.out_of_plane_strain == 0.0);
        assert!((one.accumulated_plastic_strain - three.accumulated_plastic_strain).abs() < 1e-14);
    }

    proptest! {
        /// The left side is zero there to rounding, and positive before, for softening of any steepness.
        #[test]
        fn the_multiplier_is_the_root(
            excess in -12.0..2.0f64,
            residual_part in 0.0..1.0f64,
            rate in -2.0..6.0f64,
            plastic_strain in 0.0..1.0f64,
        ) {
            let (peak, rate) = (0.5, 10f64.powf(rate));
            let law = SofteningHencky::new(moduli(), peak, residual_part * peak, rate).expect("in range");
            let trial = law.yield_stress(plastic_strain) + 10f64.powf(excess);
            let rate_of_strain = (2.0f64 / 3.0).sqrt();
            let left = |x: f64| trial - 4.0 * x - law.yield_stress(plastic_strain + rate_of_strain * x);
            let root = law.multiplier(trial, plastic_strain);
            let softened = law.yield_stress(plastic_strain + rate_of_strain * root) - residual_part * peak;
            let steepness = 4.0 + rate * rate_of_strain * softened;
            let rounding = 4.0 * f64::EPSILON * (trial.max(1.0) + steepness * (root + plastic_strain));
            prop_assert!(left(root).abs() <= rounding, "{:e} left at {root:e}", left(root));
            for part in 0..20 {
                prop_assert!(left(root * f64::from(part) / 20.0) > -rounding);
            }
        }
    }

    #[test]
    fn parameters_out_of_range_are_named() {
        let new =
            |peak, residual, rate| SofteningHencky::new(moduli(), peak, residual, rate).expect_err("out of range");
        assert_eq!(new(0.0, 0.0, 1.0).parameter(), ("peak_yield_stress", 0.0));
        let error = new(1.0, 2.0, 1.0).to_string();
        assert_eq!(error, "residual_yield_stress must be between 0 and the peak 1, not 2");
        assert_eq!(new(1.0, 0.5, -1.0).parameter(), ("softening_rate", -1.0));
        assert!(SofteningHencky::new(moduli(), 1.0, f64::NAN, 1.0).is_err());
        assert!(SofteningHencky::new(moduli(), 1.0, 0.5, f64::INFINITY).is_err());
        let law = SofteningHencky::new(moduli(), 1.0, 0.5, 2.0).expect("in range");
        assert_eq!((law.yield_stress(0.0), law.yield_stress(1e9)), (1.0, 0.5));
    }
}
