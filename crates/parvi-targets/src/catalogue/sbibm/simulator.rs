//! What a simulator of the benchmark says of itself.

use rand::Rng;

use crate::{Mode, Target, TargetError};

/// A simulator of one observation x, as its likelihood p(x | θ), normalised in x, of the parameters θ in the box (−b, b)ᴰ.
pub trait Simulator<const D: usize>: Target<D> {
    /// b.
    const HALF_WIDTH: f64;

    /// The posterior's name in the catalogue.
    fn name(&self) -> &'static str;

    /// A draw from the posterior under the uniform prior on the box.
    fn posterior_draw(&self, rng: &mut dyn Rng) -> [f64; D];

    /// log ∫ p(x | θ) dθ/(2b)ᴰ over the box.
    fn log_evidence(&self) -> f64;

    /// Points that every part of a posterior of several equal parts is nearest to one of.
    fn centres(&self) -> Vec<[f64; D]> {
        Vec::new()
    }
}

/// Modes of equal mass about centres.
pub(super) fn equal_modes<const D: usize>(centres: &[[f64; D]]) -> Vec<Mode<D>> {
    let of_one = |&centre| Mode {
        centre,
        width: 1.0,
        mass: 1.0 / centres.len() as f64,
    };
    centres.iter().map(of_one).collect()
}

/// The observation of a number, counted from 1.
pub(super) fn numbered<T: Copy>(observations: &[T], number: usize) -> Result<T, TargetError> {
    let found = number.checked_sub(1).and_then(|index| observations.get(index));
    found.copied().ok_or_else(|| TargetError::OutOfRange {
        field: "the number of an observation".to_owned(),
        value: number as f64,
        allowed: "1 to the number of observations that there are",
    })
}
