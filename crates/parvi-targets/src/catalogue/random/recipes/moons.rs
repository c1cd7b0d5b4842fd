//! Two moons.

use super::parts::{bend, boxed, long_first, on_axes, pushed};
use crate::catalogue::random::dice::Dice;
use crate::{Affine, AxisLaw, BoxedLaw, MixtureLaw, TargetError};

/// Two pieces 0.04 to 0.1 thick and bent to opposite sides, the arm of one within the other, of unequal masses.
///
/// One is y = −c x² for |x| ≤ 1, the other y = c (x − 1)² − c − g: the first is above by 2 c x (1 − x) + g where both are, so that
/// the gap is at least g there, and a little less beyond the soft ends.
pub fn law<const D: usize>(dice: &mut Dice) -> Result<BoxedLaw<D>, TargetError> {
    let along = AxisLaw::soft_uniform(dice.scale(0.03, 0.06))?;
    let (curvature, gap) = (dice.between(0.8, 1.5), dice.between(0.6, 0.8));
    let (thin, thick) = (dice.scale(0.04, 0.1), dice.scale(0.2, 0.8));
    let mass = dice.between(0.2, 0.8);
    let mut parts = Vec::new();
    for (side, mass) in [(1.0, mass), (-1.0, 1.0 - mass)] {
        let base = on_axes(|axis| if axis == 0 { along } else { AxisLaw::Normal })?;
        let scales = std::array::from_fn(|axis| match axis {
            0 => 1.0,
            1 => thin,
            _ => thick,
        });
        let mut shift = [0.0; D];
        (shift[0], shift[1]) = (0.5 * side, -0.5 * side * (curvature + gap));
        let maps = vec![
            Box::new(Affine::scales([0.0; D], scales)?) as _,
            bend(0, 1, side * curvature)?,
            Box::new(Affine::scales(shift, [1.0; D])?),
        ];
        parts.push((mass, pushed(base, maps)));
    }
    // A coordinate beyond the plane that both share.
    let moons = boxed(MixtureLaw::new(parts)?);
    if D >= 3 && dice.chance(0.5) {
        let length = dice.between(0.8, 1.2);
        let maps = vec![
            long_first::<D>(dice, length, [0.7, 1.3])?,
            bend(0, 2, dice.signed(0.2, 0.6))?,
        ];
        return Ok(pushed(moons, maps));
    }
    Ok(moons)
}
