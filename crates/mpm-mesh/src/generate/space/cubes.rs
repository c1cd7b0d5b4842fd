//! The body-centred lattice of a block of cubes.

use mpm_tensor::vector::{distance, scale};

use crate::generate::GenerationError;
use crate::{MeshError, SimplexMesh};

/// The four corners of a face as steps along the two axes that follow its normal, anticlockwise about it.
const FACE: [[usize; 2]; 4] = [[0, 0], [1, 0], [1, 1], [0, 1]];

/// Tetrahedra of a block of cubes, `counts` along the axes, their vertices where `map` puts the points of the unit cube.
///
/// Vertices are the corners and centres of the cubes. Two centres and an edge of the face between them are a cell, with angles
/// of 60° and 90° before mapping; at the boundary a centre and half a face are one, with angles from 45° to 90°. Halves are on either side of the
/// face's shorter diagonal.
pub struct Cubes<M: Fn([f64; 3]) -> [f64; 3]> {
    pub counts: [usize; 3],
    pub map: M,
}

impl<M: Fn([f64; 3]) -> [f64; 3]> Cubes<M> {
    pub fn mesh(&self) -> Result<SimplexMesh<3>, GenerationError> {
        let [nx, ny, nz] = self.counts;
        let total = (nx + 1).saturating_mul(ny + 1).saturating_mul(2 * (nz + 1));
        if total >= u32::MAX as usize {
            let what = "vertices";
            return Err(MeshError::TooLarge { what, count: total }.into());
        }
        let all = |counts: [usize; 3], shift: f64| {
            let [nx, ny, nz] = counts;
            let places = (0..nx).flat_map(move |i| (0..ny).flat_map(move |j| (0..nz).map(move |k| [i, j, k])));
            places.map(move |place| self.position(place.map(|k| k as f64 + shift)))
        };
        let corners = all(self.counts.map(|count| count + 1), 0.0);
        let vertices: Vec<[f64; 3]> = corners.chain(all(self.counts, 0.5)).collect();
        let mut cells = Vec::new();
        for axis in 0..3 {
            let mut faces = self.counts;
            faces[axis] += 1;
            for i in 0..faces[0] {
                for j in 0..faces[1] {
                    for k in 0..faces[2] {
                        self.add_face(axis, [i, j, k], &vertices, &mut cells);
                    }
                }
            }
        }
        Ok(SimplexMesh::new(vertices, cells)?)
    }

    /// The cells about the face across `axis` at the lower end of the cube at `place`.
    fn add_face(&self, axis: usize, place: [usize; 3], vertices: &[[f64; 3]], cells: &mut Vec<u32>) {
        let corners = FACE.map(|steps| {
            let mut corner = place;
            corner[(axis + 1) % 3] += steps[0];
            corner[(axis + 2) % 3] += steps[1];
            number(corner, self.counts.map(|count| count + 1))
        });
        let below = (place[axis] > 0).then(|| {
            let mut cube = place;
            cube[axis] -= 1;
            self.centre(cube)
        });
        let above = (place[axis] < self.counts[axis]).then(|| self.centre(place));
        if let (Some(below), Some(above)) = (below, above) {
            cells.extend((0..4).flat_map(|k| [below, above, corners[k], corners[(k + 1) % 4]]));
            return;
        }
        let [a, b, c, d] = corners;
        let length = |p: u32, q: u32| distance(&vertices[p as usize], &vertices[q as usize]);
        let halves = if length(a, c) <= length(b, d) {
            [[a, b, c], [a, c, d]]
        } else {
            [[a, b, d], [b, c, d]]
        };
        for [p, q, r] in halves {
            cells.extend(below.map(|centre| [centre, p, q, r]).into_iter().flatten());
            cells.extend(above.map(|centre| [centre, p, r, q]).into_iter().flatten());
        }
    }

    fn position(&self, place: [f64; 3]) -> [f64; 3] {
        (self.map)(std::array::from_fn(|axis| place[axis] / self.counts[axis] as f64))
    }

    /// Number of a centre, after those of all corners.
    fn centre(&self, cube: [usize; 3]) -> u32 {
        let corners: usize = self.counts.iter().map(|count| count + 1).product();
        corners as u32 + number(cube, self.counts)
    }
}

/// Number of a place, the last axis fastest.
fn number(place: [usize; 3], counts: [usize; 3]) -> u32 {
    place
        .iter()
        .zip(counts)
        .fold(0, |number, (place, count)| number * count + place) as u32
}

/// Cubes of about the given edge along extents.
pub fn counts(extents: [f64; 3], length: f64) -> Result<[usize; 3], GenerationError> {
    GenerationError::check_positive("length", length)?;
    let counts = scale(&extents, 1.0 / length).map(|count| count.round().max(1.0));
    GenerationError::check_count(length, 12.0 * counts.iter().product::<f64>())?;
    Ok(counts.map(|count| count as usize))
}
