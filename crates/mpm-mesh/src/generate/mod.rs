//! Meshes of simple domains, near-regular and the same in every run.
//!
//! * one dimension: [`segments`];
//! * two: [`polygon`], [`outlines`], [`rectangle`], [`disk`], [`wavy_channel`], [`ampersand`], whose cells are near to equilateral triangles, [`triangle_lattice`], whose cells are all the same, and [`scattered`] of random points;
//! * three: [`cuboid`] and [`ball`], cut from lattices, [`extruded`] and [`slope`] from prisms.

mod error;
mod layer;
mod mirror_layer;
mod plane;
mod prism;
mod segments;
mod space;

pub use self::error::GenerationError;
pub use self::layer::{OuterLayer, with_outer_layer};
pub use self::mirror_layer::with_mirrored_layer;
use self::plane::Triangulation;
pub use self::plane::{
    EdgeTarget, Refinement, Scatter, SizeField, ampersand, check_outlines, circle_outline, disk, disk_outline,
    outlines, polygon, rectangle, rectangle_outline, scattered, triangle_lattice, wavy_channel, wavy_channel_outline,
};
pub use self::segments::{cyclic_sizes, segments};
pub use self::space::{ball, cuboid, extruded, slope};
