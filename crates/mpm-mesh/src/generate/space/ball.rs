//! A ball cut from an icosahedron.

use std::collections::HashMap;

use mpm_tensor::vector::{accumulate, distance, norm, scale};

use crate::SimplexMesh;
use crate::generate::GenerationError;
use crate::mesh::signed_volume;

/// Vertices of the icosahedron are 0 … 11; this is its centre.
const CENTRE: usize = 12;

/// A mesh of a ball: the 20 tetrahedra between the faces of an icosahedron and its centre, each divided into n³ like a
/// tetrahedron cut by four families of n planes, octahedra among the pieces into four about their shortest diagonal, and mapped by
/// p ↦ r(p) p / |p|, so that layers of equal share r become spheres; n is the integer nearest to radius / `length`.
///
/// Ours. The icosahedron is nearly round, and the regular tetrahedron nearly fits into it twenty times, so little is
/// bent; a cube mapped to the ball has flat angles along its twelve edges. The boundary is a polyhedron with vertices on the
/// sphere.
///
/// # Errors
/// [`GenerationError::InvalidParameter`] unless radius and length are positive; [`GenerationError::TooFine`].
pub fn ball(centre: [f64; 3], radius: f64, length: f64) -> Result<SimplexMesh<3>, GenerationError> {
    GenerationError::check_positive("radius", radius)?;
    GenerationError::check_positive("length", length)?;
    let parts = (radius / length).round().max(1.0);
    GenerationError::check_count(length, 20.0 * parts.powi(3))?;
    let mut division = Division::new(parts as usize);
    for face in faces(&division.corners) {
        division.add([face[0], face[1], face[2], CENTRE]);
    }
    let place = |x: &[f64; 3]| std::array::from_fn(|axis| centre[axis] + radius * x[axis]);
    let vertices = division.vertices.iter().map(place).collect();
    Ok(SimplexMesh::new(vertices, division.cells)?)
}

/// The vertices of a regular icosahedron in the unit sphere: (0, ±1, ±φ) and its cyclic permutations, normalised.
fn icosahedron() -> [[f64; 3]; 12] {
    let golden = 0.5 * (1.0 + 5f64.sqrt());
    let length = 1.0f64.hypot(golden);
    std::array::from_fn(|k| {
        let sign = |bit: usize| if k >> bit & 1 == 0 { 1.0 } else { -1.0 };
        let mut vertex = [0.0; 3];
        vertex[(k / 4 + 1) % 3] = sign(0) / length;
        vertex[(k / 4 + 2) % 3] = sign(1) * golden / length;
        vertex
    })
}

/// The 20 triples of vertices at the mutual distance of neighbours, 1.05.
fn faces(corners: &[[f64; 3]; 12]) -> Vec<[usize; 3]> {
    let near = |a: usize, b: usize| distance(&corners[a], &corners[b]) < 1.1;
    let mut faces = Vec::new();
    for a in 0..12 {
        for b in (a + 1..12).filter(|&b| near(a, b)) {
            faces.extend((b + 1..12).filter(|&c| near(a, c) && near(b, c)).map(|c| [a, b, c]));
        }
    }
    faces
}

/// Tetrahedra between the icosahedron's faces and its centre, divided.
struct Division {
    corners: [[f64; 3]; 12],
    parts: usize,
    /// By the corners that a vertex lies between, in ascending order, and its weights: shared faces share vertices.
    numbers: HashMap<Vec<(usize, usize)>, u32>,
    vertices: Vec<[f64; 3]>,
    cells: Vec<u32>,
}

impl Division {
    fn new(parts: usize) -> Self {
        Self {
            corners: icosahedron(),
            parts,
            numbers: HashMap::new(),
            vertices: Vec::new(),
            cells: Vec::new(),
        }
    }

    /// Divides a tetrahedron. A piece is given by weights of sum n − 1, n − 2 or n − 3, to which its vertices add 1, 2 or 3.
    fn add(&mut self, corners: [usize; 4]) {
        let raise = |mut weights: [usize; 4], at: &[usize]| {
            at.iter().for_each(|&k| weights[k] += 1);
            weights
        };
        for weights in compositions(self.parts - 1) {
            let upright = [0, 1, 2, 3].map(|k| self.vertex(&corners, raise(weights, &[k])));
            self.add_cell(upright);
        }
        for weights in self.parts.checked_sub(2).into_iter().flat_map(compositions) {
            // Vertices of an octahedron by opposite pairs.
            let pairs = [[[0, 1], [2, 3]], [[0, 2], [1, 3]], [[0, 3], [1, 2]]];
            let pairs = pairs.map(|pair| pair.map(|at| self.vertex(&corners, raise(weights, &at))));
            self.add_octahedron(pairs);
        }
        for weights in self.parts.checked_sub(3).into_iter().flat_map(compositions) {
            let others = [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]];
            let inverted = others.map(|at| self.vertex(&corners, raise(weights, &at)));
            self.add_cell(inverted);
        }
    }

    fn vertex(&mut self, corners: &[usize; 4], weights: [usize; 4]) -> u32 {
        let mut key: Vec<(usize, usize)> = corners.iter().copied().zip(weights).filter(|(_, w)| *w > 0).collect();
        key.sort_unstable();
        let next = self.vertices.len() as u32;
        let number = *self.numbers.entry(key).or_insert(next);
        if number == next {
            let mut point = [0.0; 3];
            for (&corner, weight) in corners.iter().zip(weights).filter(|(corner, _)| **corner != CENTRE) {
                accumulate(&mut point, weight as f64, &self.corners[corner]);
            }
            let share = (self.parts - weights[3]) as f64 / self.parts as f64;
            let length = norm(&point).max(f64::MIN_POSITIVE);
            self.vertices.push(scale(&point, share / length));
        }
        number
    }

    /// Four cells about the shortest of the three diagonals, the first of equal ones.
    fn add_octahedron(&mut self, pairs: [[u32; 2]; 3]) {
        let length = |k: usize| {
            let [a, b] = pairs[k].map(|v| &self.vertices[v as usize]);
            distance(a, b)
        };
        // Lengths that differ by rounding alone count as equal.
        let shortest = (1..3).fold(0, |best, k| {
            if length(k) < length(best) * (1.0 - 1e-9) {
                k
            } else {
                best
            }
        });
        let [a, b] = pairs[shortest];
        let ([c, d], [e, f]) = (pairs[(shortest + 1) % 3], pairs[(shortest + 2) % 3]);
        for [p, q] in [[c, e], [e, d], [d, f], [f, c]] {
            self.add_cell([a, b, p, q]);
        }
    }

    /// Adds a cell, turned to be positive: the map may not, but the order of corners does, invert whole tetrahedra.
    fn add_cell(&mut self, mut cell: [u32; 4]) {
        if signed_volume(&self.vertices, &cell) < 0.0 {
            cell.swap(0, 1);
        }
        self.cells.extend(cell);
    }
}

/// All [a, b, c, d] with a + b + c + d = sum.
fn compositions(sum: usize) -> impl Iterator<Item = [usize; 4]> {
    (0..=sum).flat_map(move |a| {
        let rest = sum - a;
        (0..=rest).flat_map(move |b| (0..=rest - b).map(move |c| [a, b, c, rest - b - c]))
    })
}
