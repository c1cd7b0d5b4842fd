//! The isothermal gas as a law of F for particles of any mass and volume.

use mpm_tensor::Matrix;

use crate::any_law::remembered;
use crate::material::{log_volume_ratio, volume_alone};
use crate::{IsothermalGas, Law};

/// What [`DeformingGas`] remembers of a particle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GasState {
    /// ρ₀ = m/V⁰; 0 is a vacuum.
    pub reference_density: f64,
}

remembered!(GasState: reference_density);

/// The isothermal gas as a constitutive law of the deformation gradient, Ψ(F) = −κ (m/V⁰) ln det F per reference volume: τ = −κ (m/V⁰) I, V⁰ τ = −κ m I.
///
/// With it, and with α ∇log p as a force per unit mass, a step made for solids rests where κ ∇log ρ = α ∇log p: the one law whose rest state is the target (κ = α = 1). The stress of a
/// particle does not depend on F at all as long as det F > 0, which is why [`IsothermalGas`] stores none, and it does not depend on V⁰ either. ρ₀ is the particle's own and comes from
/// [`Law::virgin`]; [`TrackedGas`](crate::TrackedGas) has one for all particles.
///
/// Only the volume is remembered, as by [`TaitFluid`](crate::TaitFluid). **Defined for det F > 0 only.** Source: that of [`IsothermalGas`]; P = ∂Ψ/∂F = −κ (m/V⁰) F⁻ᵀ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeformingGas {
    /// κ.
    pub gas: IsothermalGas,
}

impl<const D: usize> Law<D> for DeformingGas {
    type State = GasState;

    fn virgin(&self, reference_density: f64) -> GasState {
        GasState { reference_density }
    }

    /// J^(1/D) I: a gas shears without end, and of a sheared F rounding would leave no determinant.
    #[inline]
    fn advance(&self, trial: &Matrix<D>, _state: &mut GasState) -> Matrix<D> {
        volume_alone(trial)
    }

    #[inline]
    fn energy_density(&self, F: &Matrix<D>, state: &GasState) -> f64 {
        -self.gas.pressure(state.reference_density) * log_volume_ratio(F)
    }

    #[inline]
    fn kirchhoff_stress(&self, F: &Matrix<D>, state: &GasState, _velocity_gradient: &Matrix<D>) -> Matrix<D> {
        Matrix::diagonal(&[-self.gas.kirchhoff_pressure(F, state.reference_density); D])
    }

    /// −κ ρ₀.
    fn kirchhoff_stress_across(&self, F: &Matrix<D>, state: &GasState) -> Option<f64> {
        Some(-self.gas.kirchhoff_pressure(F, state.reference_density))
    }

    /// c = √(κ ρ₀ / `reference_density`), which is √κ.
    #[inline]
    fn wave_speed(&self, F: &Matrix<D>, state: &GasState, reference_density: f64) -> f64 {
        (self.gas.kirchhoff_pressure(F, state.reference_density) / reference_density).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Material;

    #[test]
    fn it_is_the_tracked_gas_of_the_particles_own_density() {
        let gas = IsothermalGas::new(1.5).expect("positive");
        let law = DeformingGas { gas };
        let F = Matrix([[1.3, 0.2], [-0.1, 0.7]]);
        for density in [0.3, 4.0] {
            let tracked = gas.with_reference_density(density).expect("positive");
            let state = Law::<2>::virgin(&law, density);
            let stress = law.kirchhoff_stress(&F, &state, &Matrix::ZERO);
            assert_eq!(stress, Material::kirchhoff_stress(&tracked, &F));
            assert_eq!(law.energy_density(&F, &state), Material::energy_density(&tracked, &F));
            assert_eq!(law.wave_speed(&F, &state, density), gas.wave_speed());
        }
        let inverted = Matrix::diagonal(&[1.0, -2.0]);
        assert!(law.check(&inverted).is_err());
        let stress = law.kirchhoff_stress(&inverted, &GasState::default(), &Matrix::ZERO);
        assert!(stress.trace().is_nan());
    }
}
