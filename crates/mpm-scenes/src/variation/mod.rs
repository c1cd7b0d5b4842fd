//! Scenes that follow from a file by changes of some of its keys.
//!
//! Keys are dotted: `bodies.0.shape.upper.1` is the second entry of `upper` of the first body's shape.

mod axis;
mod document;
mod keys;
mod prepared;

pub use axis::{Axis, Choice, Combination, combinations};
pub use document::SceneDocument;
pub use prepared::PreparedScene;
