//! Lattices of modes.

use super::parts::boxed;
use crate::catalogue::random::axis_law::Bump;
use crate::catalogue::random::dice::Dice;
use crate::{AxisLaw, BoxedLaw, MixtureLaw, ProductLaw, TargetError};

/// Modes per axis and axes with modes: 8 and 64 in the plane, 64 and 512 beyond it.
const COUNTS: [(usize, usize); 7] = [(4, 1), (8, 1), (4, 2), (8, 2), (4, 3), (8, 3), (2, 6)];

/// Axes with 2, 4 or 8 bumps each, of unequal masses and about 6 to 10 of their widths apart, times normal laws.
pub fn law<const D: usize>(dice: &mut Dice) -> Result<BoxedLaw<D>, TargetError> {
    // The richest lattices that the dimension has room for.
    let possible: Vec<_> = COUNTS.into_iter().filter(|(_, axes)| *axes <= D).collect();
    let (per_axis, axes) = dice.pick(&possible[possible.len().saturating_sub(3)..]);
    let mut lines: Vec<BoxedLaw<1>> = Vec::new();
    for axis in 0..D {
        if axis >= axes {
            lines.push(boxed(AxisLaw::Normal));
            continue;
        }
        let spacing = 4.0 / per_axis as f64;
        let width = spacing / dice.between(6.0, 10.0);
        let mut parts = Vec::new();
        for (index, mass) in dice.masses(per_axis).into_iter().enumerate() {
            let middle = (index as f64 - 0.5 * (per_axis as f64 - 1.0)) * spacing;
            let centre = middle + spacing * dice.between(-0.1, 0.1);
            // Square roots: products of the masses themselves would leave modes without any.
            parts.push((mass.sqrt(), boxed(Bump::new(centre, width)?)));
        }
        lines.push(boxed(MixtureLaw::new(parts)?));
    }
    Ok(boxed(ProductLaw::<D>::new(Vec::new(), lines)?))
}
