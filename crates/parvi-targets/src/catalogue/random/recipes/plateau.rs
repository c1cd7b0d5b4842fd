//! Flat tops with soft edges.

use super::parts::{on_axes, pushed, soft_uniform, wave};
use crate::catalogue::random::dice::Dice;
use crate::{Affine, BoxedBijection, BoxedLaw, TargetError, Twist};

/// A box with edges of its own per axis, then a wave or a slow twist.
pub fn law<const D: usize>(dice: &mut Dice) -> Result<BoxedLaw<D>, TargetError> {
    let edges: Vec<_> = (0..D).map(|_| soft_uniform(dice)).collect::<Result<_, _>>()?;
    let scales = std::array::from_fn(|_| dice.scale(0.4, 2.0));
    let mut maps: Vec<BoxedBijection<D>> = vec![Box::new(Affine::scales([0.0; D], scales)?)];
    if D >= 2 {
        if dice.chance(0.5) {
            maps.push(wave(dice, 0, D - 1)?);
        } else {
            maps.push(Box::new(Twist::by_radius::<D>([0, 1], dice.signed(0.2, 0.8))?));
        }
    }
    Ok(pushed(on_axes(|axis| edges[axis])?, maps))
}
