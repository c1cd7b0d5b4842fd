//! Scales within scales.

use super::parts::{boxed, placed, simple};
use crate::catalogue::random::dice::Dice;
use crate::{BoxedLaw, MixtureLaw, TargetError};

/// Two or three simple laws, each 10 to 100 (with three: 5 to 20) times as narrow as the one it stands in.
pub fn law<const D: usize>(dice: &mut Dice) -> Result<BoxedLaw<D>, TargetError> {
    let levels = if dice.chance(0.3) { 3 } else { 2 };
    let ratios = if levels == 2 { [10.0, 100.0] } else { [5.0, 20.0] };
    let (mut centre, mut scale, mut parts) = ([0.0; D], 1.0, Vec::new());
    for level in 0..levels {
        if level > 0 {
            let offset = dice.normal::<D>();
            for axis in 0..D {
                centre[axis] += 0.7 * scale * offset[axis];
            }
            scale /= dice.scale(ratios[0], ratios[1]);
        }
        let base = simple(dice)?;
        parts.push((dice.between(0.25, 0.75), placed(base, dice, centre, scale, 1.5)?));
    }
    Ok(boxed(MixtureLaw::new(parts)?))
}
