//! The distance to the boundary of a mesh.

use std::collections::HashMap;

use mpm_mesh::{CellSearch, SimplexMesh};
use mpm_tensor::vector::{accumulate, distance, dot, norm_squared, subtract};

use super::{Bounds, Shape, unit};

/// All that is outside a mesh: d > 0 inside it.
///
/// Facets of the boundary are listed in the bins of a grid, each in all bins that have a point within `reach` of its box; so one bin holds all facets
/// within `reach` of its points. Farther than that the distance is given as `reach`, which is less than the distance and has its
/// sign. Which side a point is on the search for its cell tells.
#[derive(Debug)]
pub(crate) struct MeshOutside<const D: usize> {
    search: CellSearch<D>,
    facets: Vec<Facet<D>>,
    reach: f64,
    /// Facets near a bin, by its place.
    bins: HashMap<[i64; D], Vec<u32>>,
}

/// A facet of the boundary.
#[derive(Debug)]
struct Facet<const D: usize> {
    corners: [[f64; D]; D],
    /// Into the mesh.
    inward: [f64; D],
}

impl<const D: usize> MeshOutside<D> {
    /// Of a mesh; distances are exact up to `reach`.
    pub fn new(mesh: &SimplexMesh<D>, reach: f64) -> Self {
        let mut bins: HashMap<[i64; D], Vec<u32>> = HashMap::new();
        let mut facets = Vec::new();
        for facet in mesh.boundary() {
            let corners = facet.vertices.map(|vertex| mesh.vertices()[vertex as usize]);
            let bound = |start: f64, choose: fn(f64, f64) -> f64| -> [f64; D] {
                std::array::from_fn(|a| corners.iter().fold(start, |bound, x| choose(bound, x[a])))
            };
            let first = place(&bound(f64::INFINITY, f64::min).map(|c| c - reach), reach);
            let last = place(&bound(f64::NEG_INFINITY, f64::max).map(|c| c + reach), reach);
            let mut bin = first;
            loop {
                bins.entry(bin).or_default().push(facets.len() as u32);
                let Some(axis) = (0..D).rev().find(|&a| bin[a] < last[a]) else {
                    break;
                };
                bin[axis] += 1;
                bin[axis + 1..].copy_from_slice(&first[axis + 1..]);
            }
            facets.push(Facet {
                corners,
                inward: facet.normal.map(|c| -c),
            });
        }
        Self {
            search: CellSearch::new(mesh.clone()),
            facets,
            reach,
            bins,
        }
    }

    /// The nearest point of the boundary and its facet, if there is one within reach.
    fn nearest(&self, x: &[f64; D]) -> Option<(f64, [f64; D], &Facet<D>)> {
        let near = self.bins.get(&place(x, self.reach))?.iter();
        let each = near.filter_map(|&facet| {
            let facet = self.facets.get(facet as usize)?;
            let point = facet.nearest_point(x);
            Some((distance(x, &point), point, facet))
        });
        let nearest = each.min_by(|a, b| a.0.total_cmp(&b.0))?;
        (nearest.0 < self.reach).then_some(nearest)
    }

    fn is_inside(&self, x: &[f64; D]) -> bool {
        self.search.locate(x, None).is_some()
    }
}

/// The bin of width `width` that a point is in.
fn place<const D: usize>(x: &[f64; D], width: f64) -> [i64; D] {
    x.map(|c| (c / width).floor() as i64)
}

impl<const D: usize> Facet<D> {
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
        let distance = self.nearest(x).map_or(self.reach, |(distance, _, _)| distance);
        if self.is_inside(x) { distance } else { -distance }
    }

    fn bounds(&self) -> Bounds<D> {
        Bounds::EVERYWHERE
    }

    fn volume(&self) -> Option<f64> {
        None
    }

    /// From the nearest point of the boundary to x inside the mesh, the other way outside, into the mesh on the boundary itself; zero beyond reach.
    fn normal(&self, x: &[f64; D]) -> [f64; D] {
        match self.nearest(x) {
            None => [0.0; D],
            Some((0.0, _, facet)) => facet.inward,
            Some((_, point, _)) if self.is_inside(x) => unit(subtract(x, &point)),
            Some((_, point, _)) => unit(subtract(&point, x)),
        }
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

        /// All facets, without bins.
        #[test]
        fn bins_miss_no_facet(x in [-1.1..1.1, -1.1..1.1, -1.1..1.1]) {
            let mesh = ball([0.0; 3], 1.0, 0.4).expect("a ball");
            let outside = MeshOutside::new(&mesh, 0.3);
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
