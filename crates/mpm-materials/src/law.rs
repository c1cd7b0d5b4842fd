//! The interface of every law a particle can follow, with memory and rate dependence or without.

use mpm_tensor::Matrix;

use crate::material::check_volume_ratio;
use crate::{DeformationError, Material};

/// A constitutive law that may remember (internal variables) and may depend on the rate of deformation.
///
/// A step takes the deformation gradient Fⁿ of a particle to the trial F = (I + Δt L) Fⁿ, L the velocity gradient,
/// hands it to [`advance`](Self::advance), which returns the part of it that the law stores, and asks for the stress
/// there. For a plastic law this part is the elastic deformation Fᵉ of F = Fᵉ Fᵖ (return mapping; Simo & Hughes,
/// *Computational Inelasticity*, ch. 9). Symbols and units as in [`Material`].
///
/// Every [`Material`] is a law without memory: `State` is `()`, `advance` the identity. The methods of both traits have
/// the same names, so import the one that is meant.
pub trait Law<const D: usize>: Sync {
    /// Internal variables of one particle beside F; the default is the virgin material. `()` for hyperelastic laws.
    type State: Copy + Send + Sync + Default + PartialEq + std::fmt::Debug;

    /// Whether the stress reads the velocity gradient L (viscosity). Without, L is neither stored nor computed for it.
    fn rate_dependent(&self) -> bool {
        false
    }

    /// Names of the internal variables, as files call them, in the order of the numbers of a [`Memory`](crate::Memory).
    fn internal_variables(&self) -> &'static [&'static str] {
        &[]
    }

    /// The longest explicit step for viscous stresses on a grid of this spacing; infinite without viscosity, and where the law does not say.
    fn longest_viscous_step(&self, _spacing: f64) -> f64 {
        f64::INFINITY
    }

    /// The internal variables of a particle that has not deformed yet, of `reference_density` mass per reference volume; the default ones unless the law's stress depends on the mass.
    fn virgin(&self, _reference_density: f64) -> Self::State {
        Self::State::default()
    }

    /// Takes a trial F to an admissible one and updates the state: the return mapping. By default the identity, as for
    /// hyperelastic laws.
    ///
    /// An F for which [`check`](Self::check) fails is returned as it is, and the state is kept, so that the check that
    /// follows finds the fault.
    #[inline(always)]
    fn advance(&self, trial: &Matrix<D>, _state: &mut Self::State) -> Matrix<D> {
        *trial
    }

    /// ψ, the stored energy per reference volume. Not finite where [`check`](Self::check) fails.
    fn energy_density(&self, F: &Matrix<D>, state: &Self::State) -> f64;

    /// τ, the Kirchhoff stress at an admissible F. `velocity_gradient` is L (1/time); it is not read, and may be zero,
    /// unless the law is [`rate_dependent`](Self::rate_dependent). Not finite where [`check`](Self::check) fails.
    fn kirchhoff_stress(&self, F: &Matrix<D>, state: &Self::State, velocity_gradient: &Matrix<D>) -> Matrix<D>;

    /// τ along each axis that D < 3 leaves out, where nothing strains: plane strain for D = 2, uniaxial strain for D = 1. `None` where the law does not know it. Not finite where
    /// [`check`](Self::check) fails.
    fn kirchhoff_stress_across(&self, _F: &Matrix<D>, _state: &Self::State) -> Option<f64> {
        None
    }

    /// An upper bound of the speed of small elastic waves on the deformed state, as [`Material::wave_speed`]. Plastic
    /// flow only makes them slower; viscosity is not in it.
    fn wave_speed(&self, F: &Matrix<D>, state: &Self::State, reference_density: f64) -> f64;

    /// [`kirchhoff_stress`](Self::kirchhoff_stress) of many particles, as many as `stresses`; `velocity_gradients` may be empty unless the law is
    /// [`rate_dependent`](Self::rate_dependent). Laws that can work on several particles at once override it; each result depends on its own
    /// particle alone, and agrees with that of the single particle up to rounding.
    fn kirchhoff_stresses(
        &self,
        F: &[Matrix<D>],
        states: &[Self::State],
        velocity_gradients: &[Matrix<D>],
        stresses: &mut [Matrix<D>],
    ) {
        for (k, ((F, state), stress)) in F.iter().zip(states).zip(stresses).enumerate() {
            let velocity_gradient = velocity_gradients.get(k).unwrap_or(&Matrix::ZERO);
            *stress = self.kirchhoff_stress(F, state, velocity_gradient);
        }
    }

    /// [`wave_speed`](Self::wave_speed) of many particles, in the same way.
    fn wave_speeds(
        &self,
        F: &[Matrix<D>],
        states: &[Self::State],
        reference_densities: &[f64],
        wave_speeds: &mut [f64],
    ) {
        for (((F, state), &density), wave_speed) in F.iter().zip(states).zip(reference_densities).zip(wave_speeds) {
            *wave_speed = self.wave_speed(F, state, density);
        }
    }

    /// Whether the law has a stress at F; by default, whether det F > 0.
    ///
    /// # Errors
    ///
    /// [`DeformationError`] with the entry, or with the volume ratio where the law needs det F > 0.
    fn check(&self, F: &Matrix<D>) -> Result<(), DeformationError> {
        check_volume_ratio(F)
    }

    /// The current volume per reference volume of a particle: det F, unless the state carries a part of it.
    #[inline]
    fn volume_ratio(&self, F: &Matrix<D>, _state: &Self::State) -> f64 {
        F.determinant()
    }
}

impl<const D: usize, M: Material<D> + ?Sized> Law<D> for M {
    type State = ();

    #[inline(always)]
    fn energy_density(&self, F: &Matrix<D>, _state: &()) -> f64 {
        Material::energy_density(self, F)
    }

    #[inline(always)]
    fn kirchhoff_stress(&self, F: &Matrix<D>, _state: &(), _velocity_gradient: &Matrix<D>) -> Matrix<D> {
        Material::kirchhoff_stress(self, F)
    }

    fn kirchhoff_stress_across(&self, F: &Matrix<D>, _state: &()) -> Option<f64> {
        Material::kirchhoff_stress_across(self, F)
    }

    #[inline(always)]
    fn wave_speed(&self, F: &Matrix<D>, _state: &(), reference_density: f64) -> f64 {
        Material::wave_speed(self, F, reference_density)
    }

    #[inline]
    fn kirchhoff_stresses(&self, F: &[Matrix<D>], _: &[()], _: &[Matrix<D>], stresses: &mut [Matrix<D>]) {
        Material::kirchhoff_stresses(self, F, stresses);
    }

    #[inline]
    fn wave_speeds(&self, F: &[Matrix<D>], _: &[()], reference_densities: &[f64], wave_speeds: &mut [f64]) {
        Material::wave_speeds(self, F, reference_densities, wave_speeds);
    }

    #[inline]
    fn check(&self, F: &Matrix<D>) -> Result<(), DeformationError> {
        Material::check(self, F)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ElasticModuli, NeoHookean};

    #[test]
    fn a_material_is_a_law_without_memory_also_behind_a_reference() {
        fn stress<L: Law<2, State = ()> + ?Sized>(law: &L, trial: &Matrix<2>) -> Matrix<2> {
            let F = law.advance(trial, &mut ());
            assert_eq!((F, law.rate_dependent()), (*trial, false));
            assert_eq!(law.volume_ratio(&F, &()), F.determinant());
            law.kirchhoff_stress(&F, &(), &Matrix::ZERO)
        }
        let rubber = NeoHookean::new(ElasticModuli::from_lame(3.0, 2.0).expect("in range"));
        let object: &dyn Material<2> = &rubber;
        let F = Matrix([[1.2, 0.3], [0.1, 0.9]]);
        let expected = Material::kirchhoff_stress(&rubber, &F);
        assert_eq!(stress(&rubber, &F), expected);
        assert_eq!(stress(object, &F), expected);
        assert_eq!(stress(&object, &F), expected);
    }
}
