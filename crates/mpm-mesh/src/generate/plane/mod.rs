//! Triangles that are near to equilateral, in domains bounded by polygons.

mod ampersand;
mod delaunay;
mod lattice;
mod outline;
mod point_tree;
mod relax;
mod scattered;
mod shapes;
mod size_field;
mod triangle_lattice;

pub use self::ampersand::ampersand;
pub(super) use self::delaunay::Triangulation;
pub(super) use self::outline::{encloses, squared_distance_to_segment};
pub use self::scattered::{Scatter, scattered};
pub use self::shapes::{
    circle_outline, disk, disk_outline, polygon, rectangle, rectangle_outline, wavy_channel, wavy_channel_outline,
};
pub use self::size_field::{Refinement, SizeField};
pub use self::triangle_lattice::triangle_lattice;

use self::outline::Outline;
use super::GenerationError;
use crate::{MeshError, SimplexMesh};

/// How long edges should be, and along which direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EdgeTarget {
    /// The target length h.
    pub length: f64,
    /// Angle in radians from the x-axis to a direction of edges inside the domain.
    pub angle: f64,
}

/// Whether closed polygons neither cross nor touch themselves or each other, as [`outlines`] and [`scattered`] ask for.
///
/// # Errors
/// [`GenerationError::TooFewCorners`], [`GenerationError::InvalidCorner`], [`GenerationError::CrossingOutlines`].
pub fn check_outlines(outlines: &[Vec<[f64; 2]>]) -> Result<(), GenerationError> {
    let outline = Outline::undivided(outlines)?;
    Triangulation::new(&outline.points, &outline.edges).map(drop)
}

/// A mesh of the domain between closed polygons: a point is inside if it lies within an odd number of them. Each may go round
/// either way; none may cross or touch itself or another.
///
/// Edges of the polygons are divided into equal parts, of at most 1.2 h and more than 0.6 h where the edge is as long; inside
/// there are the points of the lattice of equilateral triangles of edge h with one point at the first corner, as long as they keep 0.6 h from
/// the boundary; constrained Delaunay triangulation joins them. Rounds of relaxation follow: points move to the mean of
/// their neighbours, edges that stay longer than 1.35 h get a point in the middle, one end of edges shorter than 0.6 h is dropped, and the
/// triangulation is made anew. All of this is ours. Delaunay refinement, the common way, stops at angles of 20° to 30°.
///
/// Corners of the polygons are kept, so an edge shorter than h or a narrow angle there shows in the cells around.
///
/// # Errors
/// [`GenerationError`], if the outlines bound no domain or the target is not positive.
pub fn outlines(outlines: &[Vec<[f64; 2]>], target: &EdgeTarget) -> Result<SimplexMesh<2>, GenerationError> {
    GenerationError::check_positive("length", target.length)?;
    GenerationError::check_angle(target.angle)?;
    let outline = Outline::new(outlines, target.length)?;
    if outline.points.is_empty() {
        return Err(MeshError::Empty { what: "vertices" }.into());
    }
    // Two triangles per vertex, of which each has √3 / 2 h² for itself.
    GenerationError::check_count(
        target.length,
        2.0 * outline.box_area() / (0.75f64.sqrt() * target.length.powi(2)),
    )?;
    let mut points = outline.points.clone();
    points.extend(lattice::points_inside(&outline, target));
    let cells = relax::relax(&mut points, &outline, target.length)?;
    Ok(SimplexMesh::from_used(&points, cells.as_flattened())?)
}
