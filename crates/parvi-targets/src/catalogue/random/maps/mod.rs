//! One invertible map per file.

mod affine;
mod neck;
mod shear;
mod skew;
mod twist;

pub use affine::Affine;
pub use neck::Neck;
pub use shear::{Profile, Shear};
pub use skew::Skew;
pub use twist::Twist;

use crate::TargetError;
use crate::error::within;

/// `Ok` if all axes are below D and differ from each other.
fn distinct_axes<const D: usize>(axes: &[usize]) -> Result<(), TargetError> {
    for (place, &axis) in axes.iter().enumerate() {
        let is_allowed = axis < D && !axes[..place].contains(&axis);
        let allowed = "an axis below the dimension that the map has no other use for";
        within("the axis of a map", axis as f64, is_allowed, allowed)?;
    }
    Ok(())
}
