//! Scales that depend on a place.

use super::parts::{bend, on_axes, pushed};
use crate::catalogue::random::dice::Dice;
use crate::{AxisLaw, BoxedBijection, BoxedLaw, Neck, TargetError};

/// Normal laws whose thickness on all axes but the first changes along it, by factors of 3 to 12 either way; sometimes bent.
pub fn law<const D: usize>(dice: &mut Dice) -> Result<BoxedLaw<D>, TargetError> {
    let (log_scale, width) = (dice.signed(1.1, 2.5), dice.between(1.0, 2.0));
    let mut maps = Vec::<BoxedBijection<D>>::new();
    for axis in 1..D {
        maps.push(Box::new(Neck::new::<D>(0, axis, log_scale, width)?));
    }
    if dice.chance(0.5) {
        maps.push(bend(0, 1, dice.signed(0.2, 0.5))?);
    }
    Ok(pushed(on_axes(|_| AxisLaw::Normal)?, maps))
}
