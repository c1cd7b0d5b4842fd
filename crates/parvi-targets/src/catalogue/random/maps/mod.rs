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

/// `Ok` if all axes are below D and differ from each other.
fn distinct_axes<const D: usize>(axes: &[usize]) -> Result<(), TargetError> {
    for (place, &axis) in axes.iter().enumerate() {
        if axis >= D || axes[..place].contains(&axis) {
            return Err(TargetError::OutOfRange {
                field: "the axis of a map".to_owned(),
                value: axis as f64,
                allowed: "an axis below the dimension that the map has no other use for",
            });
        }
    }
    Ok(())
}
