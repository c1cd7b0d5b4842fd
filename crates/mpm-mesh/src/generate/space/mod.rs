//! Tetrahedra from lattices and prisms.

mod ball;
mod cuboid;
mod extruded;

pub use self::ball::ball;
pub use self::cuboid::cuboid;
pub use self::extruded::{extruded, slope};

use super::GenerationError;

/// The number of slices of about `length` that an extent divides into, at least one.
fn slices(name: &'static str, extent: f64, length: f64) -> Result<f64, GenerationError> {
    GenerationError::check_positive(name, extent)?;
    GenerationError::check_positive("length", length)?;
    Ok((extent / length).round().max(1.0))
}
