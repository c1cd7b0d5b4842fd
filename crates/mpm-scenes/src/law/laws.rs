use mpm_materials::{DeformationError, Law};
use mpm_tensor::Matrix;

use super::any_law::with_law;
use super::batch;
use super::memory::Remembered;
use super::{AnyLaw, MEMORY_SIZE, Memory};

/// The laws of a scene in the order of the materials' names: a law whose particles say by their state which one they follow.
#[derive(Clone, Debug, PartialEq)]
pub struct Laws {
    table: Vec<AnyLaw>,
}

/// Which law a particle follows, and what that one remembers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LawState {
    /// Number of the law.
    pub law: u32,
    /// Its internal variables.
    pub memory: Memory,
}

impl Laws {
    /// The laws; `None` if there are none.
    pub fn new(table: Vec<AnyLaw>) -> Option<Self> {
        (!table.is_empty()).then_some(Self { table })
    }

    /// The virgin state of a particle that follows the law of this number.
    pub fn virgin(&self, law: u32) -> LawState {
        let memory = match self.of(law) {
            AnyLaw::SofteningHencky(_) => Memory::Softening(Default::default()),
            AnyLaw::DruckerPrager(_) => Memory::DruckerPrager(Default::default()),
            _ => Memory::Nothing,
        };
        LawState { law, memory }
    }

    /// The state of a particle that follows the law of this number and remembers these [`numbers`](Memory::numbers).
    pub fn recall(&self, law: u32, numbers: &[f64; MEMORY_SIZE]) -> LawState {
        let memory = self.virgin(law).memory.with_numbers(numbers);
        LawState { law, memory }
    }

    /// h² ρ₀ / (2 D μ_v) of the fluid for which that is least, the longest explicit step for viscous stresses on a grid of spacing h;
    /// infinite without viscosity.
    pub fn viscous_step(&self, dimension: usize, spacing: f64) -> f64 {
        let steps = self.table.iter().map(|law| match law {
            AnyLaw::TaitFluid(fluid) if fluid.viscosity() > 0.0 => {
                spacing * spacing * fluid.reference_density() / (2.0 * dimension as f64 * fluid.viscosity())
            }
            _ => f64::INFINITY,
        });
        steps.fold(f64::INFINITY, f64::min)
    }

    /// The law of this number; the first one for a number that there is not, which no state made by [`virgin`](Self::virgin) has.
    #[inline(always)]
    fn of(&self, law: u32) -> &AnyLaw {
        self.table.get(law as usize).unwrap_or(&self.table[0])
    }
}

/// [`Law::advance`] of one law on the memory of any.
#[inline(always)]
fn advance<const D: usize, L: Law<D>>(law: &L, trial: &Matrix<D>, memory: &mut Memory) -> Matrix<D>
where
    L::State: Remembered,
{
    let mut own = L::State::recall(memory);
    let admissible = law.advance(trial, &mut own);
    *memory = own.store();
    admissible
}

/// Every method is compiled once per dimension and called: copied into the steps of all bases and transfers, the laws would take minutes
/// to compile and save nanoseconds.
#[allow(non_snake_case)]
impl<const D: usize> Law<D> for Laws {
    type State = LawState;

    /// Whether one of them is.
    fn rate_dependent(&self) -> bool {
        self.table
            .iter()
            .any(|any| with_law!(any, law => Law::<D>::rate_dependent(law)))
    }

    #[inline(never)]
    fn advance(&self, trial: &Matrix<D>, state: &mut LawState) -> Matrix<D> {
        with_law!(self.of(state.law), law => advance(law, trial, &mut state.memory))
    }

    #[inline(never)]
    fn energy_density(&self, F: &Matrix<D>, state: &LawState) -> f64 {
        with_law!(self.of(state.law), law => Law::energy_density(law, F, &Remembered::recall(&state.memory)))
    }

    #[inline(never)]
    fn kirchhoff_stress(&self, F: &Matrix<D>, state: &LawState, velocity_gradient: &Matrix<D>) -> Matrix<D> {
        with_law!(self.of(state.law), law => {
            Law::kirchhoff_stress(law, F, &Remembered::recall(&state.memory), velocity_gradient)
        })
    }

    #[inline(never)]
    fn wave_speed(&self, F: &Matrix<D>, state: &LawState, reference_density: f64) -> f64 {
        with_law!(self.of(state.law), law => {
            Law::wave_speed(law, F, &Remembered::recall(&state.memory), reference_density)
        })
    }

    fn kirchhoff_stresses(
        &self,
        F: &[Matrix<D>],
        states: &[LawState],
        velocity_gradients: &[Matrix<D>],
        stresses: &mut [Matrix<D>],
    ) {
        for piece in batch::pieces(states) {
            let (F, states, stresses) = (&F[piece.clone()], &states[piece.clone()], &mut stresses[piece.clone()]);
            let rates = velocity_gradients.get(piece).unwrap_or(&[]);
            with_law!(self.of(states[0].law), law => batch::kirchhoff_stresses(law, F, states, rates, stresses));
        }
    }

    fn wave_speeds(&self, F: &[Matrix<D>], states: &[LawState], reference_densities: &[f64], wave_speeds: &mut [f64]) {
        for piece in batch::pieces(states) {
            let (F, states) = (&F[piece.clone()], &states[piece.clone()]);
            let (densities, speeds) = (&reference_densities[piece.clone()], &mut wave_speeds[piece]);
            with_law!(self.of(states[0].law), law => batch::wave_speeds(law, F, states, densities, speeds));
        }
    }

    /// What the first of the laws that have no stress at F says: asked only where a particle has none, without its state.
    fn check(&self, F: &Matrix<D>) -> Result<(), DeformationError> {
        self.table
            .iter()
            .try_for_each(|any| with_law!(any, law => Law::check(law, F)))
    }

    #[inline(never)]
    fn volume_ratio(&self, F: &Matrix<D>, state: &LawState) -> f64 {
        with_law!(self.of(state.law), law => Law::volume_ratio(law, F, &Remembered::recall(&state.memory)))
    }
}

#[cfg(test)]
#[allow(non_snake_case)]
mod tests {
    use super::*;
    use mpm_materials::{DruckerPrager, ElasticModuli, NeoHookean, SofteningHencky, TaitFluid};

    fn moduli() -> ElasticModuli {
        ElasticModuli::new(100.0, 0.3).expect("in range")
    }

    #[test]
    fn many_particles_at_once_are_as_one_by_one() {
        let clay = SofteningHencky::new(moduli(), 1.0, 0.5, 3.0).expect("in range");
        let water = TaitFluid::new(2.0, 10.0, 0.1).expect("in range");
        let table = vec![
            AnyLaw::NeoHookean(NeoHookean::new(moduli())),
            AnyLaw::SofteningHencky(clay),
            AnyLaw::TaitFluid(water),
        ];
        let laws = Laws::new(table).expect("three");
        let count = 150;
        let number = |k: usize, a: usize| ((7 * k + 3 * a) % 13) as f64 / 130.0;
        let F: Vec<Matrix<2>> = (0..count)
            .map(|k| Matrix([[1.0 + number(k, 0), number(k, 1)], [-number(k, 2), 1.1 - number(k, 3)]]))
            .collect();
        let rates: Vec<Matrix<2>> = F.iter().map(|F| *F * 3.0).collect();
        // Long runs, short runs and single particles.
        let law = |k: usize| if k < 70 { 0 } else { (k / (1 + k % 4) % 3) as u32 };
        let mut states: Vec<LawState> = (0..count).map(|k| laws.virgin(law(k))).collect();
        let F: Vec<Matrix<2>> = F
            .iter()
            .zip(&mut states)
            .map(|(F, state)| laws.advance(F, state))
            .collect();
        let densities: Vec<f64> = (0..count).map(|k| 1.0 + number(k, 5)).collect();

        let (mut stresses, mut speeds) = (vec![Matrix::ZERO; count], vec![0.0; count]);
        laws.kirchhoff_stresses(&F, &states, &rates, &mut stresses);
        laws.wave_speeds(&F, &states, &densities, &mut speeds);
        for k in 0..count {
            let stress = laws.kirchhoff_stress(&F[k], &states[k], &rates[k]);
            assert!(
                (stresses[k] - stress).maximum_norm() <= 1e-13 * (1.0 + stress.maximum_norm()),
                "particle {k}"
            );
            let speed = laws.wave_speed(&F[k], &states[k], densities[k]);
            assert!((speeds[k] - speed).abs() <= 1e-13 * speed, "particle {k}");
        }
    }

    #[test]
    fn every_particle_follows_its_own_law_and_remembers_by_it() {
        let metal = SofteningHencky::new(moduli(), 1.0, 0.5, 3.0).expect("in range");
        let sand = DruckerPrager::new(moduli(), 0.5).expect("in range");
        let water = TaitFluid::new(2.0, 10.0, 0.1).expect("in range");
        let rubber = NeoHookean::new(moduli());
        let laws = Laws::new(vec![
            AnyLaw::SofteningHencky(metal),
            AnyLaw::DruckerPrager(sand),
            AnyLaw::TaitFluid(water),
            AnyLaw::NeoHookean(rubber),
        ])
        .expect("four");
        let trial = Matrix([[1.1, 0.2], [0.0, 1.05]]);
        let rate = Matrix([[0.0, 1.0], [2.0, 0.5]]);
        let mut states: Vec<LawState> = (0..4).map(|law| laws.virgin(law)).collect();
        let advanced: Vec<Matrix<2>> = states.iter_mut().map(|state| laws.advance(&trial, state)).collect();

        let mut own = Default::default();
        let F = Law::advance(&metal, &trial, &mut own);
        assert!(own.accumulated_plastic_strain > 0.0);
        assert_eq!((advanced[0], states[0].memory), (F, Memory::Softening(own)));
        assert_eq!(laws.energy_density(&F, &states[0]), metal.energy_density(&F, &own));
        let mut own = Default::default();
        let F = Law::advance(&sand, &trial, &mut own);
        assert!(own.volume_correction > 0.0);
        assert_eq!((advanced[1], states[1].memory), (F, Memory::DruckerPrager(own)));
        assert_eq!(
            laws.volume_ratio(&F, &states[1]),
            Law::<2>::volume_ratio(&sand, &F, &own)
        );
        let F = Law::advance(&water, &trial, &mut ());
        assert_eq!(
            laws.kirchhoff_stress(&F, &states[2], &rate),
            water.kirchhoff_stress(&F, &(), &rate)
        );
        assert_eq!(
            laws.wave_speed(&trial, &states[3], 2.0),
            Law::wave_speed(&rubber, &trial, &(), 2.0)
        );
        assert!(Law::<2>::rate_dependent(&laws));
        assert!((laws.viscous_step(2, 0.1) - 0.01 * 2.0 / 0.4).abs() < 1e-15);
        assert!(Law::<2>::check(&laws, &Matrix([[1.0, 0.0], [0.0, -1.0]])).is_err());
        for state in states {
            assert_eq!(laws.recall(state.law, &state.memory.numbers()), state);
        }
    }
}
