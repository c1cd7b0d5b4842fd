//! Tetrahedra cut from lattices.

mod ball;
mod cubes;
mod shapes;

pub use self::ball::ball;
pub use self::shapes::{cuboid, slope};
