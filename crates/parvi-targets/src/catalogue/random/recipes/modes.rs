//! Many unequal modes.

use super::parts::{bend, boxed, placed, pushed, simple};
use crate::catalogue::random::dice::Dice;
use crate::{BoxedLaw, MixtureLaw, TargetError};

/// 4 to 16 simple laws, some of them bent, in a box of ±4.
pub fn law<const D: usize>(dice: &mut Dice) -> Result<BoxedLaw<D>, TargetError> {
    let masses = {
        let count = dice.whole(4, 16);
        dice.masses(count)
    };
    let mut parts = Vec::new();
    for mass in masses {
        let mut base = simple(dice)?;
        if D >= 2 && dice.chance(0.4) {
            base = pushed(base, vec![bend(0, 1, dice.signed(0.3, 1.0))?]);
        }
        let centre = std::array::from_fn(|_| dice.between(-4.0, 4.0));
        let scale = dice.scale(0.06, 0.5);
        parts.push((mass, placed(base, dice, centre, scale, 2.0)?));
    }
    Ok(boxed(MixtureLaw::new(parts)?))
}
