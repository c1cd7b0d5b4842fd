//! Mixtures of different families.

use super::parts::{boxed, placed};
use super::{cusp, funnel, heavy_tail, moons, plateau, ridge, spiral};
use crate::catalogue::random::dice::Dice;
use crate::{BoxedLaw, MixtureLaw, TargetError};

/// Two to four laws of different families, within a few of their scales of each other, of unequal sizes and masses.
pub fn law<const D: usize>(dice: &mut Dice) -> Result<BoxedLaw<D>, TargetError> {
    let count = dice.whole(2, 4);
    let first = dice.whole(0, 6);
    let mut parts = Vec::new();
    for index in 0..count {
        let part = match (first + 2 * index) % 7 {
            0 => ridge::law(dice)?,
            1 => plateau::law(dice)?,
            2 => spiral::law(dice)?,
            3 => cusp::law(dice)?,
            4 => moons::law(dice)?,
            5 => heavy_tail::law(dice)?,
            _ => funnel::law(dice)?,
        };
        let centre = std::array::from_fn(|_| dice.between(-3.0, 3.0));
        let scale = dice.scale(0.3, 1.2);
        parts.push((dice.between(0.2, 1.0), placed(part, dice, centre, scale, 1.5)?));
    }
    Ok(boxed(MixtureLaw::new(parts)?))
}
