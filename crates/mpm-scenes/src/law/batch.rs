//! Several particles at once, each run of those that follow one law.

use std::ops::Range;

use mpm_materials::Law;
use mpm_tensor::Matrix;

use super::LawState;
use super::memory::Remembered;

/// Particles of which the internal variables are recalled at once.
const GROUP: usize = 32;

/// The longest pieces of at most `GROUP` particles that follow one law.
pub fn pieces(states: &[LawState]) -> impl Iterator<Item = Range<usize>> {
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

/// The internal variables of a piece as those of its law.
fn recalled<S: Remembered + Copy>(states: &[LawState]) -> [S; GROUP] {
    let mut own = [S::default(); GROUP];
    for (own, state) in own.iter_mut().zip(states) {
        *own = S::recall(&state.memory);
    }
    own
}

/// [`Law::kirchhoff_stresses`] of one law for a piece.
#[allow(non_snake_case)]
pub fn kirchhoff_stresses<const D: usize, L: Law<D>>(
    law: &L,
    F: &[Matrix<D>],
    states: &[LawState],
    velocity_gradients: &[Matrix<D>],
    stresses: &mut [Matrix<D>],
) where
    L::State: Remembered,
{
    law.kirchhoff_stresses(F, &recalled(states)[..states.len()], velocity_gradients, stresses);
}

/// [`Law::wave_speeds`] of one law for a piece.
#[allow(non_snake_case)]
pub fn wave_speeds<const D: usize, L: Law<D>>(
    law: &L,
    F: &[Matrix<D>],
    states: &[LawState],
    reference_densities: &[f64],
    wave_speeds: &mut [f64],
) where
    L::State: Remembered,
{
    law.wave_speeds(F, &recalled(states)[..states.len()], reference_densities, wave_speeds);
}
