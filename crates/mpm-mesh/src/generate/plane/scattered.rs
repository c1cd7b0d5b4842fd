//! Delaunay meshes of random points: no lattice shows through.

use std::f64::consts::TAU;

use mpm_tensor::vector::add_scaled;

use super::delaunay::Triangulation;
use super::lattice::NearSegments;
use super::outline::{Outline, Rows};
use super::point_tree::PointTree;
use super::relax::smooth;
use super::size_field::SizeField;
use crate::generate::GenerationError;
use crate::{MeshError, SimplexMesh};

/// No two points inside are closer than this share of h. With it the mean edge is h to a few percent.
const DISTANCE: f64 = 0.71;

/// Points keep this share of h from the boundary, so that none is in the circle over an edge of it.
const FROM_BOUNDARY: f64 = 0.6;

/// Candidates around a point before it is left.
const CANDIDATES: usize = 30;

/// How random points are strewn and smoothed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scatter {
    /// Rounds in which points move to the mean of their neighbours and are triangulated anew: the more, the nearer cells come to equilateral ones.
    pub sweeps: usize,
    /// The direction in radians from which those of new points are counted.
    pub angle: f64,
}

/// The Delaunay mesh of random points in the domain between closed polygons, as [`outlines`](super::outlines) has them, with edges of the lengths of a
/// size field on average.
///
/// Edges of the polygons are divided into parts of the same ∫ ds / h. Points inside come one by one at random distances of
/// 1 to 2 times 0.71 h and directions around those that there are (Poisson disks, Bridson 2007, doi 10.1145/1278780.1278807), none closer than that to
/// another and than 0.6 h to the boundary, until none fits; `random` gives numbers in [0, 1). Constrained Delaunay triangulation joins
/// them. On the domains of the tests edges are 0.4 to 1.75 h long, within 6 % of h on average, and no angle is below 22°.
///
/// # Errors
/// [`GenerationError`], if the outlines bound no domain, the angle is not finite or a random number is outside [0, 1); [`GenerationError::TooFine`] also where the
/// least length is below 1e-8 of an edge of the polygons. The time to divide an edge is in proportion to their ratio.
pub fn scattered(
    outlines: &[Vec<[f64; 2]>],
    size: &SizeField,
    scatter: Scatter,
    random: &mut dyn FnMut() -> f64,
) -> Result<SimplexMesh<2>, GenerationError> {
    GenerationError::check_angle(scatter.angle)?;
    let corners = Outline::undivided(outlines)?;
    if corners.points.is_empty() {
        return Err(MeshError::Empty { what: "vertices" }.into());
    }
    // Two triangles per vertex, of which each has √3 / 2 h² for itself: too many are refused before edges are divided into as fine parts.
    let cells = 2.0 / 0.75f64.sqrt() * size.squares_in(corners.bounds());
    GenerationError::check_count(size.least(), cells)?;
    let outline = Outline::graded(outlines, size)?;
    let mut points = outline.points.clone();
    strew(&mut points, &outline, size, scatter.angle, random)?;
    for _ in 0..scatter.sweeps {
        smooth(&mut points, &outline, |x| size.at(x))?;
    }
    let cells = Triangulation::new(&points, &outline.edges)?.inside;
    Ok(SimplexMesh::from_used(&points, cells.as_flattened())?)
}

/// Appends points inside the outline to those of it.
fn strew(
    points: &mut Vec<[f64; 2]>,
    outline: &Outline,
    size: &SizeField,
    angle: f64,
    random: &mut dyn FnMut() -> f64,
) -> Result<(), GenerationError> {
    let mut draw = || GenerationError::check_random(random());
    let segments: Vec<_> = outline.segments().collect();
    let (near, rows) = (
        NearSegments::new(&segments, size.base()),
        Rows::new(&segments, size.least()),
    );
    let mut tree = PointTree::new(outline.bounds());
    let mut open: Vec<u32> = (0..points.len() as u32).collect();
    open.iter().for_each(|&number| tree.insert(number, points));
    while !open.is_empty() {
        let place = ((draw()? * open.len() as f64) as usize).min(open.len() - 1);
        let centre = points[open[place] as usize];
        let reach = DISTANCE * size.at(&centre);
        let mut candidate = None;
        for _ in 0..CANDIDATES {
            let (sine, cosine) = (angle + TAU * draw()?).sin_cos();
            let point = add_scaled(&centre, reach * (1.0 + draw()?), &[cosine, sine]);
            let here = size.at(&point);
            let free = rows.encloses(&point)
                && !near.is_near(&point, FROM_BOUNDARY * here)
                && !tree.any_within(&point, DISTANCE * here, points);
            if free {
                candidate = Some(point);
                break;
            }
        }
        match candidate {
            None => {
                open.swap_remove(place);
            }
            Some(point) => {
                let number = points.len() as u32;
                points.push(point);
                tree.insert(number, points);
                open.push(number);
            }
        }
    }
    Ok(())
}
