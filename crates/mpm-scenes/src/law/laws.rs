//! The laws of a scene as one law.

use std::fmt::{self, Debug, Formatter};
use std::ops::Range;

use mpm_materials::{DeformationError, Law, Memory};
use mpm_tensor::Matrix;

use super::AnyLaw;

/// The laws of a scene in the order of the materials' names: a law whose particles say by their state which one they follow.
#[derive(Clone)]
pub struct Laws<const D: usize> {
    table: Vec<AnyLaw<D>>,
}

impl<const D: usize> Debug for Laws<D> {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        formatter.debug_tuple("Laws").field(&self.table.len()).finish()
    }
}

/// Which law a particle follows, and what that one remembers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LawState {
    /// Number of the law.
    pub law: u32,
    /// Its internal variables.
    pub memory: Memory,
}

impl LawState {
    /// The state of a particle of this law that has not moved yet.
    pub fn virgin(law: u32) -> Self {
        let memory = Memory::default();
        Self { law, memory }
    }
}

impl<const D: usize> Laws<D> {
    /// The laws; `None` if there are none.
    pub fn new(table: Vec<AnyLaw<D>>) -> Option<Self> {
        (!table.is_empty()).then_some(Self { table })
    }

    /// The longest explicit step for the viscous stresses of particles on a grid of this spacing, that of the particle for which it is shortest; infinite without viscosity.
    ///
    /// That of a law is for its density at rest: a particle of J > 1 pulls at its nodes with V⁰ J σ, and has a step J times as short.
    #[allow(non_snake_case)]
    pub fn viscous_step(&self, spacing: f64, F: &[Matrix<D>], states: &[LawState]) -> f64 {
        let at_rest: Vec<f64> = self.table.iter().map(|law| law.longest_viscous_step(spacing)).collect();
        if at_rest.iter().all(|step| *step == f64::INFINITY) {
            return f64::INFINITY;
        }
        let each = F.iter().zip(states).map(|(F, state)| {
            let step = at_rest.get(state.law as usize).unwrap_or(&f64::INFINITY);
            step / self.volume_ratio(F, state).max(1.0)
        });
        each.fold(f64::INFINITY, f64::min)
    }

    /// The names of all internal variables, those of the first law first.
    pub fn internal_variables(&self) -> Vec<&'static str> {
        let mut names = Vec::new();
        for &name in self.table.iter().flat_map(|law| law.internal_variables()) {
            if !names.contains(&name) {
                names.push(name);
            }
        }
        names
    }

    /// An internal variable of a particle by its name; `None` where its law has no such one.
    pub fn internal_variable(&self, state: &LawState, name: &str) -> Option<f64> {
        self.place(state, name).map(|place| state.memory.0[place])
    }

    /// Sets it; nothing where its law has no such one.
    pub fn set_internal_variable(&self, state: &mut LawState, name: &str, value: f64) {
        if let Some(place) = self.place(state, name) {
            state.memory.0[place] = value;
        }
    }

    /// The place of an internal variable in a particle's memory.
    fn place(&self, state: &LawState, name: &str) -> Option<usize> {
        let names = self.of(state.law).internal_variables();
        names.iter().position(|known| *known == name)
    }

    /// The law of this number; the first one for a number that there is not, which no particle of a scene has.
    #[inline(always)]
    fn of(&self, law: u32) -> &AnyLaw<D> {
        self.table.get(law as usize).unwrap_or(&self.table[0])
    }
}

/// Particles that are worked on at once, at most.
const GROUP: usize = 32;

/// The longest pieces of at most `GROUP` particles that follow one law.
fn pieces(states: &[LawState]) -> impl Iterator<Item = Range<usize>> {
    let mut start = 0;
    std::iter::from_fn(move || {
        let first = states.get(start)?;
        let limit = states.len().min(start + GROUP);
        let same = states[start..limit].iter().take_while(|state| state.law == first.law);
        let piece = start..start + same.count();
        start = piece.end;
        Some(piece)
    })
}

/// What the particles of a piece remember.
fn memories(states: &[LawState]) -> [Memory; GROUP] {
    let mut memories = [Memory::default(); GROUP];
    for (memory, state) in memories.iter_mut().zip(states) {
        *memory = state.memory;
    }
    memories
}

#[allow(non_snake_case)]
impl<const D: usize> Law<D> for Laws<D> {
    type State = LawState;

    /// Whether one of them is.
    fn rate_dependent(&self) -> bool {
        self.table.iter().any(|law| law.rate_dependent())
    }

    fn advance(&self, trial: &Matrix<D>, state: &mut LawState) -> Matrix<D> {
        self.of(state.law).advance(trial, &mut state.memory)
    }

    fn energy_density(&self, F: &Matrix<D>, state: &LawState) -> f64 {
        self.of(state.law).energy_density(F, &state.memory)
    }

    fn kirchhoff_stress(&self, F: &Matrix<D>, state: &LawState, velocity_gradient: &Matrix<D>) -> Matrix<D> {
        self.of(state.law).kirchhoff_stress(F, &state.memory, velocity_gradient)
    }

    fn kirchhoff_stress_across(&self, F: &Matrix<D>, state: &LawState) -> Option<f64> {
        self.of(state.law).kirchhoff_stress_across(F, &state.memory)
    }

    fn wave_speed(&self, F: &Matrix<D>, state: &LawState, reference_density: f64) -> f64 {
        self.of(state.law).wave_speed(F, &state.memory, reference_density)
    }

    fn kirchhoff_stresses(
        &self,
        F: &[Matrix<D>],
        states: &[LawState],
        velocity_gradients: &[Matrix<D>],
        stresses: &mut [Matrix<D>],
    ) {
        for piece in pieces(states) {
            let (F, states, stresses) = (&F[piece.clone()], &states[piece.clone()], &mut stresses[piece.clone()]);
            let rates = velocity_gradients.get(piece).unwrap_or(&[]);
            let law = self.of(states[0].law);
            law.kirchhoff_stresses(F, &memories(states)[..states.len()], rates, stresses);
        }
    }

    fn wave_speeds(&self, F: &[Matrix<D>], states: &[LawState], reference_densities: &[f64], wave_speeds: &mut [f64]) {
        for piece in pieces(states) {
            let (F, states) = (&F[piece.clone()], &states[piece.clone()]);
            let (densities, speeds) = (&reference_densities[piece.clone()], &mut wave_speeds[piece]);
            let law = self.of(states[0].law);
            law.wave_speeds(F, &memories(states)[..states.len()], densities, speeds);
        }
    }

    /// What the first of the laws that have no stress at F says: asked only where a particle has none, without its state.
    fn check(&self, F: &Matrix<D>) -> Result<(), DeformationError> {
        self.table.iter().try_for_each(|law| law.check(F))
    }

    fn volume_ratio(&self, F: &Matrix<D>, state: &LawState) -> f64 {
        self.of(state.law).volume_ratio(F, &state.memory)
    }
}
