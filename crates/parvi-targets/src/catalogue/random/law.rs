//! What random targets are made of.

use std::fmt::Debug;

use crate::{Target, UnitCubeTransport};

/// A probability law on ℝᴰ with density, score and exact draws: any target that has a map from the unit cube.
///
/// Where laws are put together ([`PushForward`](crate::PushForward), [`MixtureLaw`](crate::MixtureLaw),
/// [`ProductLaw`](crate::ProductLaw)), their log densities are taken as normalised, ∫ p = 1, as those of this crate that state it are.
pub trait Law<const D: usize>: Target<D> + UnitCubeTransport<D> + Debug + Send {}

impl<T: Target<D> + UnitCubeTransport<D> + Debug + Send, const D: usize> Law<D> for T {}

/// A law whichever it is.
pub type BoxedLaw<const D: usize> = Box<dyn Law<D>>;
