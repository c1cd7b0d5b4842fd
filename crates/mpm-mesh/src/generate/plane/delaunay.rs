//! Constrained Delaunay triangulation.

use mpm_tensor::vector::{add_scaled, dot, subtract};
use spade::handles::{FixedFaceHandle, FixedVertexHandle, PossiblyOuterTag};
use spade::{ConstrainedDelaunayTriangulation, InsertionError, Point2, Triangulation as _, validate_coordinate};

use crate::generate::GenerationError;

/// The triangles between points, by the side of the constrained edges they are on.
pub struct Triangulation {
    /// Anticlockwise, the smallest number first, in ascending order: nothing depends on how the library got there.
    pub inside: Vec<[u32; 3]>,
    /// Those within the convex hull of the points that an even number of constrained edges encloses.
    pub outside: Vec<[u32; 3]>,
}

type Cdt = ConstrainedDelaunayTriangulation<Point2<f64>>;

impl Triangulation {
    /// Of points with edges that have to be kept; these form closed polygons.
    pub fn new(points: &[[f64; 2]], edges: &[[usize; 2]]) -> Result<Self, GenerationError> {
        let invalid = |&[x, y]: &[f64; 2]| valid(x).is_err() || valid(y).is_err();
        if let Some(corner) = points.iter().position(invalid) {
            let position = points[corner];
            return Err(GenerationError::InvalidCorner {
                outline: 0,
                corner,
                position,
            });
        }
        let crossing = |position| GenerationError::CrossingOutlines { position };
        let mut conflict = None;
        let vertices = points.iter().map(|&[x, y]| Point2::new(clean(x), clean(y))).collect();
        let cdt = Cdt::try_bulk_load_cdt(vertices, edges.to_vec(), |edge| conflict = Some(edge));
        let cdt = cdt.map_err(|_| crossing(None))?;
        // With points that occur twice the library counts others.
        if cdt.num_vertices() != points.len() {
            return Err(crossing(doubled(points)));
        }
        let missing = || edges.iter().copied().find(|&edge| !is_kept(&cdt, edge));
        if conflict.is_some() || cdt.num_constraints() != edges.len() {
            let met = conflict.or_else(missing);
            return Err(crossing(met.and_then(|edge| meeting(points, edges, edge))));
        }
        Ok(Self::by_side(&cdt))
    }

    /// Crosses edges from the unbounded face on; each constrained one changes the side.
    fn by_side(cdt: &Cdt) -> Self {
        let mut sides: Vec<Option<bool>> = vec![None; cdt.num_all_faces()];
        let outer: FixedFaceHandle<PossiblyOuterTag> = cdt.outer_face().fix();
        sides[outer.index()] = Some(false);
        let hull = cdt.convex_hull();
        let outward = hull.map(|edge| if edge.face().is_outer() { edge } else { edge.rev() });
        let mut open: Vec<_> = outward.map(|edge| (edge.fix(), false)).collect();
        while let Some((edge, inside)) = open.pop() {
            // From the face left of `edge`, which is on the side `inside`, to the one right of it.
            let edge = cdt.directed_edge(edge);
            let across = edge.rev().face();
            if sides[across.fix().index()].is_some() {
                continue;
            }
            let side = inside ^ edge.is_constraint_edge();
            sides[across.fix().index()] = Some(side);
            if let Some(face) = across.as_inner() {
                open.extend(face.adjacent_edges().map(|edge| (edge.fix(), side)));
            }
        }
        let mut triangulation = Self {
            inside: Vec::new(),
            outside: Vec::new(),
        };
        for face in cdt.inner_faces() {
            let mut triangle = face.vertices().map(|vertex| vertex.fix().index() as u32);
            let least = (0..3).min_by_key(|&k| triangle[k]).unwrap_or(0);
            triangle.rotate_left(least);
            match sides[face.fix().index()] {
                Some(true) => triangulation.inside.push(triangle),
                _ => triangulation.outside.push(triangle),
            }
        }
        triangulation.inside.sort_unstable();
        triangulation.outside.sort_unstable();
        triangulation
    }
}

/// Coordinates too small for exact predicates are zero: they are far below the rounding of any other.
fn clean(x: f64) -> f64 {
    if x.abs() < spade::MIN_ALLOWED_VALUE { 0.0 } else { x }
}

fn valid(x: f64) -> Result<(), InsertionError> {
    validate_coordinate(clean(x))
}

/// Whether an edge is one of the triangulation.
fn is_kept(cdt: &Cdt, edge: [usize; 2]) -> bool {
    let [from, to] = edge.map(FixedVertexHandle::from_index);
    cdt.get_edge_from_neighbors(from, to)
        .is_some_and(|edge| edge.is_constraint_edge())
}

/// Where an edge meets a point on its way or crosses another edge: the first such place in the order of these.
fn meeting(points: &[[f64; 2]], edges: &[[usize; 2]], edge: [usize; 2]) -> Option<[f64; 2]> {
    let [a, b] = edge.map(|end| points[end]);
    let along = subtract(&b, &a);
    // The share of the way from a to b, if it is none of the ends.
    let on_the_way = |share: f64| share > 0.0 && share < 1.0;
    let crossed = |&[from, to]: &[usize; 2]| {
        let (c, d) = (points[from], points[to]);
        let (other, between) = (subtract(&d, &c), subtract(&c, &a));
        let turn = cross(&along, &other);
        let (share, of_other) = (cross(&between, &other) / turn, cross(&between, &along) / turn);
        (on_the_way(share) && (0.0..=1.0).contains(&of_other)).then(|| add_scaled(&a, share, &along))
    };
    let touched = |x: &&[f64; 2]| {
        let between = subtract(x, &a);
        cross(&along, &between) == 0.0 && on_the_way(dot(&between, &along) / dot(&along, &along))
    };
    let crossing = edges.iter().find_map(crossed);
    crossing.or_else(|| points.iter().find(touched).copied())
}

fn cross([ax, ay]: &[f64; 2], [bx, by]: &[f64; 2]) -> f64 {
    ax * by - ay * bx
}

/// A point that occurs twice.
fn doubled(points: &[[f64; 2]]) -> Option<[f64; 2]> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    sorted.windows(2).find(|pair| pair[0] == pair[1]).map(|pair| pair[0])
}
