//! Heavy tails.

use super::parts::{boxed, pushed, wave};
use crate::catalogue::random::dice::Dice;
use crate::{BoxedBijection, BoxedLaw, Skew, StudentT, TargetError};

/// A multivariate t whose first axis is skewed, then a wave. The tails keep a finite variance: ν δ > 2.6.
pub fn law<const D: usize>(dice: &mut Dice) -> Result<BoxedLaw<D>, TargetError> {
    let base = boxed(StudentT::<D>::new(dice.scale(3.0, 8.0))?);
    let skew = Skew::new::<D>(0, dice.signed(0.0, 0.7), dice.between(0.9, 1.2))?;
    let mut maps: Vec<BoxedBijection<D>> = vec![Box::new(skew)];
    if D >= 2 && dice.chance(0.7) {
        maps.push(wave(dice, 0, 1)?);
    }
    Ok(pushed(base, maps))
}
