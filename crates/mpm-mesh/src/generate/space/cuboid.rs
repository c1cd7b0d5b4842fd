//! A box cut from the body-centred lattice.

use super::slices;
use crate::SimplexMesh;
use crate::generate::GenerationError;

/// The four corners of a face as steps along the two axes that follow its normal, anticlockwise about it.
const FACE: [[usize; 2]; 4] = [[0, 0], [1, 0], [1, 1], [0, 1]];

/// A mesh of a box, cut from the body-centred lattice of the cuboids that divide it, nearest to cubes of edge `length`.
///
/// Vertices are the corners and centres of the cubes. Two centres and an edge of the face between them are a cell; at the
/// boundary a centre and half a face are one. This lattice is ours: its tetrahedra are the best that fill space in one shape (angles of 60° and
/// 90°, radius ratio 0.95), where those of Kuhn have 45° and 0.72. Edges have `length`, √3/2 and, on the boundary, √2 of it;
/// angles at the boundary go from 45° to 120°.
///
/// # Errors
/// [`GenerationError::InvalidParameter`] unless `lower` is less than `upper` along every axis and the length positive;
/// [`GenerationError::TooFine`].
pub fn cuboid(lower: [f64; 3], upper: [f64; 3], length: f64) -> Result<SimplexMesh<3>, GenerationError> {
    let mut counts = [0.0; 3];
    for (axis, name) in ["extent along x", "extent along y", "extent along z"]
        .into_iter()
        .enumerate()
    {
        counts[axis] = slices(name, upper[axis] - lower[axis], length)?;
    }
    GenerationError::check_count(length, 12.0 * counts.iter().product::<f64>())?;
    let block = Block {
        counts: counts.map(|count| count as usize),
    };
    let position = |place: [f64; 3]| {
        let share = |axis: usize| place[axis] / counts[axis];
        std::array::from_fn(|axis| lower[axis] * (1.0 - share(axis)) + upper[axis] * share(axis))
    };
    let corners = places(block.counts.map(|count| count + 1)).map(|place| place.map(|k| k as f64));
    let centres = places(block.counts).map(|place| place.map(|k| k as f64 + 0.5));
    let vertices = corners.chain(centres).map(position).collect();
    let mut cells = Vec::new();
    for axis in 0..3 {
        let mut faces = block.counts;
        faces[axis] += 1;
        places(faces).for_each(|place| block.add_face(axis, place, &mut cells));
    }
    Ok(SimplexMesh::new(vertices, cells)?)
}

/// All places below the counts, the last axis fastest.
fn places(counts: [usize; 3]) -> impl Iterator<Item = [usize; 3]> {
    let [nx, ny, nz] = counts;
    (0..nx).flat_map(move |i| (0..ny).flat_map(move |j| (0..nz).map(move |k| [i, j, k])))
}

/// Cubes by their places.
struct Block {
    counts: [usize; 3],
}

impl Block {
    /// The cells about the face across `axis` at the lower end of the cube at `place`.
    fn add_face(&self, axis: usize, place: [usize; 3], cells: &mut Vec<u32>) {
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
        for [p, q, r] in [[a, b, c], [a, c, d]] {
            cells.extend(below.map(|centre| [centre, p, q, r]).into_iter().flatten());
            cells.extend(above.map(|centre| [centre, p, r, q]).into_iter().flatten());
        }
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
