//! Small scenes that tests share.

use std::path::Path;

use mpm_scenes::output::read_series;
use mpm_scenes::{Scene, Series, simulate};

/// A bar that swings in its first mode, D = 1.
pub const BAR: &str = include_str!("../data/bar.toml");

/// A block that falls on a floor and slides on it, beside a disk, D = 2.
pub const BLOCK: &str = include_str!("../data/block.toml");

/// Sand, metal and water that fall side by side, D = 2: laws with memory and a stress that depends on the rate.
pub const HEAPS: &str = include_str!("../data/heaps.toml");

/// A cube in free rotation, D = 3.
pub const CUBE: &str = include_str!("../data/cube.toml");

/// A block that turns and swings freely on a lattice of triangles, D = 2.
pub const BLOCK_ON_MESH: &str = include_str!("../data/block_on_mesh.toml");

/// A block inside a square mesh whose boundary it cannot pass, D = 2.
pub const RUBBER_ON_MESH: &str = include_str!("../data/rubber_on_mesh.toml");

/// The scene of a text.
pub fn scene(text: &str) -> Scene {
    Scene::parse(text, Path::new("test.toml")).expect("a good scene")
}

/// The series of a scene.
pub fn series_of(text: &str) -> Series {
    let directory = tempfile::tempdir().expect("a directory");
    simulate(&scene(text), directory.path(), &mut ()).expect("runs");
    read_series(directory.path()).expect("written")
}
