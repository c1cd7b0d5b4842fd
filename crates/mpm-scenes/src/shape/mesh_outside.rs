//! The distance to the boundary of a mesh.

use mpm_mesh::{BoundaryFacet, CellSearch, SimplexMesh};
use mpm_tensor::vector::{accumulate, distance, dot, norm_squared, subtract};

use super::facet_grid::{FacetGrid, Near};
use super::{Bounds, Shape, unit};

/// All that is outside a mesh: d > 0 inside it.
///
/// Farther than `reach` the distance is given as `reach`, which is less than the distance and has its sign.
#[derive(Debug)]
pub(crate) struct MeshOutside<const D: usize> {
    search: CellSearch<D>,
    facets: Vec<Facet<D>>,
    reach: f64,
    grid: FacetGrid<D>,
}

/// A facet of the boundary.
#[derive(Debug)]
struct Facet<const D: usize> {
    corners: [[f64; D]; D],
    /// The mean of the corners, and how far the farthest one is from it.
    centre: [f64; D],
    radius: f64,
    /// Into the mesh.
    inward: [f64; D],
}

/// The nearest point of the boundary, its facet and its distance, and whether it is seen from inside.
struct Nearest<'a, const D: usize> {
    distance: f64,
    point: [f64; D],
    facet: &'a Facet<D>,
    inside: bool,
}

impl<const D: usize> MeshOutside<D> {
    /// Of a mesh; distances are exact up to `reach`.
    pub fn new(mesh: &SimplexMesh<D>, reach: f64) -> Self {
        Self::of(mesh, mesh.boundary().into_iter(), reach)
    }

    /// Of these facets of a mesh's boundary alone; where none is within `reach` the sign says nothing.
    pub fn of(mesh: &SimplexMesh<D>, facets: impl Iterator<Item = BoundaryFacet<D>>, reach: f64) -> Self {
        let facets: Vec<_> = facets
            .map(|facet| {
                let corners = facet.vertices.map(|vertex| mesh.vertices()[vertex as usize]);
                Facet::new(corners, facet.normal.map(|c| -c))
            })
            .collect();
        let corners: Vec<_> = facets.iter().map(|facet| facet.corners).collect();
        let search = CellSearch::new(mesh.clone());
        Self {
            grid: FacetGrid::new(&search, &corners, reach),
            search,
            facets,
            reach,
        }
    }

    /// The nearest point of the boundary, if there is one within reach, or whether x is inside.
    fn nearest(&self, x: &[f64; D]) -> Result<Nearest<'_, D>, bool> {
        let (near, cell) = match self.grid.near(x) {
            Near::None { inside } => return Err(inside),
            Near::Facets(near, cell) => (near.iter(), cell),
        };
        let (mut nearest, mut least) = (None, self.reach);
        for facet in near.map(|&number| &self.facets[number as usize]) {
            if distance(x, &facet.centre) - facet.radius < least {
                let point = facet.nearest_point(x);
                let distance = distance(x, &point);
                if distance < least {
                    (nearest, least) = (Some((point, facet)), distance);
                }
            }
        }
        let is_in_a_cell = || self.search.locate(x, Some(cell)).is_some();
        let Some((point, facet)) = nearest else {
            return Err(is_in_a_cell());
        };
        // Right above or below its nearest facet that facet tells, else the search for its cell.
        let height = dot(&subtract(x, &point), &facet.inward);
        let inside = if height.abs() > (1.0 - 1e-9) * least {
            height > 0.0
        } else {
            is_in_a_cell()
        };
        Ok(Nearest {
            distance: least,
            point,
            facet,
            inside,
        })
    }

    /// [`Shape::distance`] of what has been found.
    fn signed(&self, nearest: &Result<Nearest<'_, D>, bool>) -> f64 {
        match nearest {
            Ok(Nearest {
                distance, inside: true, ..
            }) => *distance,
            Ok(Nearest { distance, .. }) => -distance,
            Err(true) => self.reach,
            Err(false) => -self.reach,
        }
    }
}

impl<const D: usize> Nearest<'_, D> {
    /// [`Shape::normal`] at x.
    fn normal(&self, x: &[f64; D]) -> [f64; D] {
        if self.distance == 0.0 {
            self.facet.inward
        } else if self.inside {
            unit(subtract(x, &self.point))
        } else {
            unit(subtract(&self.point, x))
        }
    }
}

impl<const D: usize> Facet<D> {
    fn new(corners: [[f64; D]; D], inward: [f64; D]) -> Self {
        let centre = std::array::from_fn(|a| corners.iter().map(|x| x[a]).sum::<f64>() / D as f64);
        let radius = corners.iter().map(|x| distance(x, &centre)).fold(0.0, f64::max);
        Self {
            corners,
            inward,
            centre,
            // Against rounding, a little more.
            radius: radius * (1.0 + 1e-9),
        }
    }

    /// The nearest point of a point, a segment or a triangle.
    fn nearest_point(&self, x: &[f64; D]) -> [f64; D] {
        let [a, b, c] = [0, 1, 2].map(|k| &self.corners[k % D]);
        match D {
            1 => *a,
            2 => nearest_on_segment(x, a, b),
            _ => nearest_on_triangle(x, a, b, c),
        }
    }
}

fn nearest_on_segment<const D: usize>(x: &[f64; D], a: &[f64; D], b: &[f64; D]) -> [f64; D] {
    let along = subtract(b, a);
    let share = dot(&subtract(x, a), &along) / norm_squared(&along).max(f64::MIN_POSITIVE);
    let mut point = *a;
    accumulate(&mut point, share.clamp(0.0, 1.0), &along);
    point
}

/// With e = b − a, f = c − a and the least squares a + s e + t f: the point itself where s, t and 1 − s − t are not negative, else the nearest on the
/// three sides.
fn nearest_on_triangle<const D: usize>(x: &[f64; D], a: &[f64; D], b: &[f64; D], c: &[f64; D]) -> [f64; D] {
    let (e, f, y) = (subtract(b, a), subtract(c, a), subtract(x, a));
    let (ee, ef, ff) = (dot(&e, &e), dot(&e, &f), dot(&f, &f));
    let (ey, fy) = (dot(&e, &y), dot(&f, &y));
    let determinant = ee * ff - ef * ef;
    let (s, t) = ((ff * ey - ef * fy) / determinant, (ee * fy - ef * ey) / determinant);
    if s >= 0.0 && t >= 0.0 && s + t <= 1.0 {
        let mut point = *a;
        accumulate(&mut point, s, &e);
        accumulate(&mut point, t, &f);
        return point;
    }
    let sides = [(a, b), (b, c), (c, a)].map(|(p, q)| nearest_on_segment(x, p, q));
    let nearer = |p: [f64; D], q: [f64; D]| if distance(x, &q) < distance(x, &p) { q } else { p };
    nearer(nearer(sides[0], sides[1]), sides[2])
}

impl<const D: usize> Shape<D> for MeshOutside<D> {
    fn distance(&self, x: &[f64; D]) -> f64 {
        self.signed(&self.nearest(x))
    }

    fn closer_than(&self, x: &[f64; D], limit: f64) -> Option<(f64, [f64; D])> {
        let nearest = self.nearest(x);
        let distance = self.signed(&nearest);
        let is_far = distance >= limit;
        (!is_far).then(|| (distance, nearest.map_or([0.0; D], |nearest| nearest.normal(x))))
    }

    fn bounds(&self) -> Bounds<D> {
        Bounds::EVERYWHERE
    }

    /// From the nearest point of the boundary to x inside the mesh, the other way outside, into the mesh on the boundary itself; zero beyond reach.
    fn normal(&self, x: &[f64; D]) -> [f64; D] {
        self.nearest(x).map_or([0.0; D], |nearest| nearest.normal(x))
    }
}

#[cfg(test)]
mod tests {
    use mpm_mesh::generate::{EdgeTarget, ball, rectangle};
    use proptest::prelude::*;

    use super::*;
    use crate::shape::Cuboid;

    proptest! {
        /// Of a rectangle the distance is the negative of the box's, as far as it reaches.
        #[test]
        fn a_rectangle_has_the_distance_of_a_box(x in [-0.5..1.5, -0.5..1.0]) {
            let target = EdgeTarget { length: 0.2, angle: 0.0 };
            let mesh = rectangle([0.0, 0.0], [1.0, 0.5], &target).expect("a rectangle");
            let (outside, inside) = (MeshOutside::new(&mesh, 0.2), Cuboid { lower: [0.0, 0.0], upper: [1.0, 0.5] });
            let expected = (-inside.distance(&x)).clamp(-0.2, 0.2);
            prop_assert!((outside.distance(&x) - expected).abs() < 1e-12);
        }

        /// All facets, without the grid, and the search for the sign.
        #[test]
        fn the_grid_misses_no_facet(x in [-1.1..1.1, -1.1..1.1, -1.1..1.1]) {
            let mesh = ball([0.0; 3], 1.0, 0.4).expect("a ball");
            let outside = MeshOutside::new(&mesh, 0.3);
            prop_assert_eq!(outside.distance(&x) > 0.0, outside.search.locate(&x, None).is_some());
            let all = outside.facets.iter().map(|facet| distance(&x, &facet.nearest_point(&x)));
            let least = all.fold(f64::INFINITY, f64::min).min(0.3);
            prop_assert!((outside.distance(&x).abs() - least).abs() < 1e-12);
            if least < 0.3 && least > 1e-3 {
                let further = std::array::from_fn(|a| x[a] + 1e-4 * outside.normal(&x)[a]);
                prop_assert!(outside.distance(&further) > outside.distance(&x));
            }
        }
    }
}
