//! How a seed makes a law of each family, one per file. Laws have a scale of about 1 and stand near 0; place, units and
//! direction come after.

mod blend;
mod cusp;
mod funnel;
mod grid;
mod heavy_tail;
mod modes;
mod moons;
mod nested;
mod parts;
mod plateau;
mod product;
mod ridge;
mod spiral;

use super::dice::Dice;
use crate::catalogue::making::no_dimension;
use crate::{BoxedLaw, RandomFamily, TargetError};

pub(crate) use parts::placed;

/// A law of a family.
///
/// # Errors
/// [`TargetError::DimensionNotAllowed`] below the family's smallest dimension.
pub(crate) fn law_of<const D: usize>(family: RandomFamily, dice: &mut Dice) -> Result<BoxedLaw<D>, TargetError> {
    if D < family.minimum_dimension() {
        let target = format!("random target of the family {}", family.name());
        return Err(no_dimension(
            &target,
            D,
            format!("{} or more", family.minimum_dimension()),
        ));
    }
    match family {
        RandomFamily::Plateau => plateau::law(dice),
        RandomFamily::Cusp => cusp::law(dice),
        RandomFamily::HeavyTail => heavy_tail::law(dice),
        RandomFamily::Nested => nested::law(dice),
        RandomFamily::Modes => modes::law(dice),
        RandomFamily::Ridge => ridge::law(dice),
        RandomFamily::Spiral => spiral::law(dice),
        RandomFamily::Moons => moons::law(dice),
        RandomFamily::Funnel => funnel::law(dice),
        RandomFamily::Product => product::law(dice),
        RandomFamily::Grid => grid::law(dice),
        RandomFamily::Blend => blend::law(dice),
    }
}
