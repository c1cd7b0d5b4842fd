//! Spirals and helices.

use super::parts::{line, long_first, pushed};
use crate::catalogue::random::dice::Dice;
use crate::{Affine, BoxedBijection, BoxedLaw, TargetError, Twist};

/// A long piece wound up by its distance from a centre: two arms where it lies across the centre, one where it lies beside it.
/// From three dimensions on, half of them are wound along a third axis instead.
pub fn law<const D: usize>(dice: &mut Dice) -> Result<BoxedLaw<D>, TargetError> {
    let base = line(dice)?;
    let length = dice.between(1.5, 3.0);
    let mut maps = vec![long_first::<D>(dice, length, [0.05, 0.25])?];
    let mut shift = [0.0; D];
    if D >= 3 && dice.chance(0.5) {
        // A line beside the first axis becomes a helix around it.
        shift[1] = dice.between(0.5, 1.2);
        maps.push(Box::new(Affine::scales(shift, [1.0; D])?));
        maps.push(Box::new(Twist::by_axis::<D>([1, 2], 0, dice.signed(1.0, 2.5))?));
    } else {
        if dice.chance(0.5) {
            shift[0] = length + dice.between(0.3, 1.0);
            maps.push(Box::new(Affine::scales(shift, [1.0; D])?));
        }
        let twist: BoxedBijection<D> = Box::new(Twist::by_radius::<D>([0, 1], dice.signed(1.0, 2.2))?);
        maps.push(twist);
    }
    Ok(pushed(base, maps))
}
