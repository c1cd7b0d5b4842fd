//! Cusps.

use super::parts::{on_axes, placed, pushed, wave};
use crate::catalogue::random::dice::Dice;
use crate::{AxisLaw, BoxedBijection, BoxedLaw, Skew, TargetError};

/// Laplace laws with unequal scales along directions of their own, then a wave or a skewed axis.
pub fn law<const D: usize>(dice: &mut Dice) -> Result<BoxedLaw<D>, TargetError> {
    let turned = placed(on_axes(|_| AxisLaw::Laplace)?, dice, [0.0; D], 0.7, 3.0)?;
    let map: BoxedBijection<D> = if D >= 2 && dice.chance(0.6) {
        wave(dice, D - 1, 0)?
    } else {
        Box::new(Skew::new::<D>(0, dice.signed(0.2, 0.8), dice.between(0.9, 1.3))?)
    };
    Ok(pushed(turned, vec![map]))
}
