//! Any law behind one type, for programs that choose it while they run.

use mpm_tensor::Matrix;

use crate::stretch_limit::limited;
use crate::{DeformationError, Law};

/// The internal variables of any law, as plain numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Memory(pub [f64; 2]);

/// A law's own internal variables, in and out of a [`Memory`].
pub trait Remembered: Copy {
    /// From the numbers that [`store`](Self::store) has made.
    fn recall(memory: &Memory) -> Self;

    /// As plain numbers.
    fn store(self) -> Memory;
}

impl Remembered for () {
    #[inline(always)]
    fn recall(_: &Memory) -> Self {}

    #[inline(always)]
    fn store(self) -> Memory {
        Memory::default()
    }
}

/// [`Remembered`] for a struct of numbers: the fields in their order.
macro_rules! remembered {
    ($state:ident: $($field:ident),+) => {
        impl $crate::Remembered for $state {
            #[inline]
            fn recall(memory: &$crate::Memory) -> Self {
                let [$($field,)+ ..] = memory.0;
                Self { $($field),+ }
            }

            #[inline]
            fn store(self) -> $crate::Memory {
                let mut memory = $crate::Memory::default();
                [$(self.$field),+].into_iter().zip(&mut memory.0).for_each(|(value, number)| *number = value);
                memory
            }
        }
    };
}
pub(crate) use remembered;

/// A law whose internal variables are kept as a [`Memory`], so that all laws have one type as trait objects: `&Numbered(law) as &dyn Law<D, State = Memory>`.
///
/// Its results have the bits of the law's own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Numbered<L>(pub L);

/// Particles whose internal variables are recalled at once.
const GROUP: usize = 32;

impl<L> Numbered<L> {
    /// Call `work` with the places of at most [`GROUP`] particles and their recalled variables, until all have had their turn.
    fn in_groups<const D: usize>(states: &[Memory], mut work: impl FnMut(std::ops::Range<usize>, &[L::State]))
    where
        L: Law<D, State: Remembered>,
    {
        let mut own = [L::State::default(); GROUP];
        for (k, group) in states.chunks(GROUP).enumerate() {
            for (own, memory) in own.iter_mut().zip(group) {
                *own = L::State::recall(memory);
            }
            work(k * GROUP..k * GROUP + group.len(), &own[..group.len()]);
        }
    }
}

impl<const D: usize, L: Law<D, State: Remembered>> Law<D> for Numbered<L> {
    type State = Memory;

    fn rate_dependent(&self) -> bool {
        self.0.rate_dependent()
    }

    fn internal_variables(&self) -> &'static [&'static str] {
        self.0.internal_variables()
    }

    fn longest_viscous_step(&self, spacing: f64) -> f64 {
        self.0.longest_viscous_step(spacing)
    }

    fn virgin(&self, reference_density: f64) -> Memory {
        self.0.virgin(reference_density).store()
    }

    fn advance(&self, trial: &Matrix<D>, memory: &mut Memory) -> Matrix<D> {
        let mut own = L::State::recall(memory);
        let admitted = self.0.advance(trial, &mut own);
        *memory = own.store();
        admitted
    }

    fn energy_density(&self, F: &Matrix<D>, memory: &Memory) -> f64 {
        self.0.energy_density(F, &L::State::recall(memory))
    }

    fn kirchhoff_stress(&self, F: &Matrix<D>, memory: &Memory, velocity_gradient: &Matrix<D>) -> Matrix<D> {
        self.0.kirchhoff_stress(F, &L::State::recall(memory), velocity_gradient)
    }

    fn kirchhoff_stress_across(&self, F: &Matrix<D>, memory: &Memory) -> Option<f64> {
        self.0.kirchhoff_stress_across(F, &L::State::recall(memory))
    }

    fn wave_speed(&self, F: &Matrix<D>, memory: &Memory, reference_density: f64) -> f64 {
        self.0.wave_speed(F, &L::State::recall(memory), reference_density)
    }

    fn kirchhoff_stresses(
        &self,
        F: &[Matrix<D>],
        states: &[Memory],
        velocity_gradients: &[Matrix<D>],
        stresses: &mut [Matrix<D>],
    ) {
        Self::in_groups(states, |group, own| {
            let rates = velocity_gradients.get(group.clone()).unwrap_or(&[]);
            self.0
                .kirchhoff_stresses(&F[group.clone()], own, rates, &mut stresses[group]);
        });
    }

    fn wave_speeds(&self, F: &[Matrix<D>], states: &[Memory], reference_densities: &[f64], wave_speeds: &mut [f64]) {
        Self::in_groups(states, |group, own| {
            let densities = &reference_densities[group.clone()];
            self.0
                .wave_speeds(&F[group.clone()], own, densities, &mut wave_speeds[group]);
        });
    }

    fn check(&self, F: &Matrix<D>) -> Result<(), DeformationError> {
        self.0.check(F)
    }

    fn volume_ratio(&self, F: &Matrix<D>, memory: &Memory) -> f64 {
        self.0.volume_ratio(F, &L::State::recall(memory))
    }
}

/// A reference to a law that is chosen while a program runs, as a law: what a step is compiled for, once for all laws.
#[derive(Clone, Copy)]
pub struct AnyLaw<'a, const D: usize> {
    /// The law.
    pub law: &'a dyn Law<D, State = Memory>,
    /// k > 1: trial deformation gradients are first brought back to principal stretches in [1/k, k], with det F > 0.
    ///
    /// A material that yields to large strain (a fixed corotated solid, a plastic one) is sheared and crushed on and on, until the determinant of F is nothing but rounding and the body comes to an
    /// end that the motion does not know. F = U diag(σ) Vᵀ becomes U diag(min(max(σ, 1/k), k)) Vᵀ, as in the snow of Stomakhin et al. 2013, §5; where det F < 0 the least stretch is the one that has
    /// turned over. An F within the limits stays as it is, to the bit.
    pub stretch_limit: Option<f64>,
}

impl<const D: usize> Law<D> for AnyLaw<'_, D> {
    type State = Memory;

    fn rate_dependent(&self) -> bool {
        self.law.rate_dependent()
    }

    fn internal_variables(&self) -> &'static [&'static str] {
        self.law.internal_variables()
    }

    fn longest_viscous_step(&self, spacing: f64) -> f64 {
        self.law.longest_viscous_step(spacing)
    }

    fn virgin(&self, reference_density: f64) -> Memory {
        self.law.virgin(reference_density)
    }

    fn advance(&self, trial: &Matrix<D>, memory: &mut Memory) -> Matrix<D> {
        match self.stretch_limit {
            None => self.law.advance(trial, memory),
            Some(limit) => self.law.advance(&limited(trial, limit), memory),
        }
    }

    fn energy_density(&self, F: &Matrix<D>, memory: &Memory) -> f64 {
        self.law.energy_density(F, memory)
    }

    fn kirchhoff_stress(&self, F: &Matrix<D>, memory: &Memory, velocity_gradient: &Matrix<D>) -> Matrix<D> {
        self.law.kirchhoff_stress(F, memory, velocity_gradient)
    }

    fn kirchhoff_stress_across(&self, F: &Matrix<D>, memory: &Memory) -> Option<f64> {
        self.law.kirchhoff_stress_across(F, memory)
    }

    fn wave_speed(&self, F: &Matrix<D>, memory: &Memory, reference_density: f64) -> f64 {
        self.law.wave_speed(F, memory, reference_density)
    }

    fn kirchhoff_stresses(
        &self,
        F: &[Matrix<D>],
        states: &[Memory],
        velocity_gradients: &[Matrix<D>],
        stresses: &mut [Matrix<D>],
    ) {
        self.law.kirchhoff_stresses(F, states, velocity_gradients, stresses);
    }

    fn wave_speeds(&self, F: &[Matrix<D>], states: &[Memory], reference_densities: &[f64], wave_speeds: &mut [f64]) {
        self.law.wave_speeds(F, states, reference_densities, wave_speeds);
    }

    fn check(&self, F: &Matrix<D>) -> Result<(), DeformationError> {
        self.law.check(F)
    }

    fn volume_ratio(&self, F: &Matrix<D>, memory: &Memory) -> f64 {
        self.law.volume_ratio(F, memory)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{DeformingGas, DruckerPrager, ElasticModuli, IsothermalGas, KelvinVoigt, NeoHookean, SofteningHencky};

    /// A walk of 40 particles with the law itself and with what stands for it: the same bits.
    fn agrees<L: Law<2, State: Remembered>>(law: L) {
        let object = Numbered(law);
        let any = AnyLaw {
            law: &object,
            stretch_limit: None,
        };
        let law = &object.0;
        let density = |p: usize| 0.5 + p as f64;
        let mut F = vec![Matrix::<2>::IDENTITY; 40];
        let mut own: Vec<L::State> = (0..40).map(|p| law.virgin(density(p))).collect();
        let mut memory: Vec<Memory> = (0..40).map(|p| any.virgin(density(p))).collect();
        let rates: Vec<Matrix<2>> = (0..40)
            .map(|p| Matrix([[0.3 - 0.01 * p as f64, 0.4], [-0.1, 0.02 * p as f64 - 0.5]]))
            .collect();
        let densities: Vec<f64> = (0..40).map(density).collect();
        assert_eq!(law.rate_dependent(), any.rate_dependent());
        for _ in 0..5 {
            for p in 0..40 {
                let trial = (Matrix::IDENTITY + rates[p] * 0.2) * F[p];
                F[p] = law.advance(&trial, &mut own[p]);
                assert_eq!(any.advance(&trial, &mut memory[p]), F[p]);
                assert_eq!(memory[p], own[p].store());
                assert_eq!(
                    any.energy_density(&F[p], &memory[p]),
                    law.energy_density(&F[p], &own[p])
                );
                assert_eq!(any.volume_ratio(&F[p], &memory[p]), law.volume_ratio(&F[p], &own[p]));
                assert_eq!(any.check(&F[p]), law.check(&F[p]));
                assert_eq!(
                    any.kirchhoff_stress_across(&F[p], &memory[p]),
                    law.kirchhoff_stress_across(&F[p], &own[p])
                );
            }
            let (mut expected, mut stresses) = ([Matrix::ZERO; 40], [Matrix::ZERO; 40]);
            law.kirchhoff_stresses(&F, &own, &rates, &mut expected);
            any.kirchhoff_stresses(&F, &memory, &rates, &mut stresses);
            assert_eq!(expected, stresses);
            let (mut expected, mut speeds) = ([0.0; 40], [0.0; 40]);
            law.wave_speeds(&F, &own, &densities, &mut expected);
            any.wave_speeds(&F, &memory, &densities, &mut speeds);
            assert_eq!(expected, speeds);
        }
    }

    #[test]
    fn any_law_is_the_law_itself() {
        let moduli = ElasticModuli::new(1.0, 0.3).expect("in range");
        agrees(NeoHookean::new(moduli));
        agrees(KelvinVoigt::new(moduli, 0.1).expect("in range"));
        agrees(SofteningHencky::new(moduli, 0.05, 0.01, 2.0).expect("in range"));
        agrees(DruckerPrager::new(moduli, 0.5).expect("in range"));
        agrees(DeformingGas {
            gas: IsothermalGas::CALIBRATED,
        });
    }
}
