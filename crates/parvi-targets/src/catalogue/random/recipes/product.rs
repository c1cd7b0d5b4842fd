//! Products of planes.

use super::parts::{boxed, placed, simple};
use super::{modes, moons, plateau, ridge, spiral};
use crate::catalogue::random::dice::Dice;
use crate::{BoxedLaw, ProductLaw, TargetError};

/// A plane for every two coordinates, of equal or different families, and a line where D is odd. Half of them are planes of two
/// moons each: 2^(D/2) curved pieces.
pub fn law<const D: usize>(dice: &mut Dice) -> Result<BoxedLaw<D>, TargetError> {
    let all_moons = dice.chance(0.5);
    let mut planes = Vec::new();
    for _ in 0..D / 2 {
        let family = if all_moons { 0 } else { dice.whole(0, 4) };
        planes.push(match family {
            0 => moons::law(dice)?,
            1 => ridge::law(dice)?,
            2 => spiral::law(dice)?,
            3 => plateau::law(dice)?,
            _ => modes::law(dice)?,
        });
    }
    let mut lines = Vec::new();
    if D % 2 == 1 {
        let line = simple(dice)?;
        lines.push(placed(line, dice, [0.0], 1.0, 2.0)?);
    }
    Ok(boxed(ProductLaw::<D>::new(planes, lines)?))
}
