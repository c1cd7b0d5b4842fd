//! Thin curved ridges.

use super::parts::{bend, line, long_first, pushed, wave};
use crate::catalogue::random::dice::Dice;
use crate::{BoxedLaw, TargetError};

/// A long piece, 1 to 2 along and 0.03 to 0.4 across, that bends or waves into one or more of the other axes; sometimes a
/// second bend follows the first.
pub fn law<const D: usize>(dice: &mut Dice) -> Result<BoxedLaw<D>, TargetError> {
    let base = line(dice)?;
    let length = dice.between(1.0, 2.0);
    let mut maps = vec![long_first::<D>(dice, length, [0.03, 0.4])?];
    for axis in 1..D {
        if axis > 1 && dice.chance(0.5) {
            continue;
        }
        maps.push(if dice.chance(0.5) {
            bend(0, axis, dice.signed(0.2, 0.8))?
        } else {
            wave(dice, 0, axis)?
        });
    }
    if D >= 3 && dice.chance(0.5) {
        maps.push(bend(1, 2, dice.signed(0.2, 0.6))?);
    }
    Ok(pushed(base, maps))
}
