//! The point of the mesh that is nearest to one outside.

use mpm_tensor::vector::{distance_squared, dot, subtract};

use super::{CellSearch, Located, NO_CELL, point_at};
use crate::SimplexMesh;

/// The nearest point of a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearestPoint<const D: usize> {
    /// Its cell and its barycentric coordinates there.
    pub located: Located<D>,
    /// Where it is.
    pub position: [f64; D],
    /// How far away.
    pub distance: f64,
}

impl<const D: usize> CellSearch<D> {
    /// The point of `mesh`, for which this search was built, that is nearest to `x`, if it is at most `reach` away; of several cells that have it the
    /// lowest.
    pub fn nearest(&self, mesh: &SimplexMesh<D>, x: &[f64; D], reach: f64) -> Option<NearestPoint<D>> {
        if let Some(located) = self.locate(x, None) {
            let (position, distance) = (*x, 0.0);
            return Some(NearestPoint { located, position, distance });
        }
        if !x.iter().all(|c| c.is_finite()) {
            return None;
        }
        let mut candidates = Vec::new();
        self.buckets.for_each_in(&x.map(|c| c - reach), &x.map(|c| c + reach), |bucket| {
            let at_boundary = |&&cell: &&u32| self.neighbours(cell).any(|neighbour| neighbour.is_none());
            candidates.extend(self.buckets.cells(bucket).iter().filter(at_boundary));
        });
        candidates.sort_unstable();
        candidates.dedup();
        let mut best: Option<NearestPoint<D>> = None;
        for cell in candidates {
            let near = nearest_in_cell(mesh, cell, x);
            if near.distance <= best.map_or(reach, |best| best.distance)
                && best.is_none_or(|best| near.distance < best.distance)
            {
                best = Some(near);
            }
        }
        debug_assert!(best.is_none_or(|best| best.located.cell != NO_CELL));
        best
    }
}

/// The point of a cell that is nearest to `x`: of the nearest points of all its faces' planes that lie in the face, the nearest.
fn nearest_in_cell<const D: usize>(mesh: &SimplexMesh<D>, cell: u32, x: &[f64; D]) -> NearestPoint<D> {
    let vertices = mesh.cell(cell as usize);
    let corner = |n: usize| &mesh.vertices()[vertices[n] as usize];
    let mut best: Option<NearestPoint<D>> = None;
    for face in 1u32..1 << (D + 1) {
        let members: Vec<usize> = (0..=D).filter(|n| face >> n & 1 == 1).collect();
        let edges: Vec<[f64; D]> = members[1..].iter().map(|&n| subtract(corner(n), corner(members[0]))).collect();
        let from = subtract(x, corner(members[0]));
        let Some(shares) = least_squares(&edges, &from) else {
            continue;
        };
        let first = 1.0 - shares.iter().sum::<f64>();
        if first < 0.0 || shares.iter().any(|&share| share < 0.0) {
            continue;
        }
        let mut all = vec![0.0; D + 1];
        for (&n, &share) in members.iter().zip(std::iter::once(&first).chain(&shares)) {
            all[n] = share;
        }
        let barycentric = std::array::from_fn(|a| all[a + 1]);
        let position = point_at(mesh, cell, &barycentric);
        let distance = distance_squared(x, &position).sqrt();
        if best.is_none_or(|best| distance < best.distance) {
            let located = Located { cell, barycentric };
            best = Some(NearestPoint { located, position, distance });
        }
    }
    // Vertices are faces, whose shares are never negative.
    best.unwrap_or_else(|| NearestPoint {
        located: Located { cell, barycentric: [0.0; D] },
        position: *corner(0),
        distance: distance_squared(x, corner(0)).sqrt(),
    })
}

/// c with the least |Σ_k c_k e_k − y|, by Gaussian elimination on eᵀe c = eᵀy; `None` where the edges are dependent.
fn least_squares<const D: usize>(edges: &[[f64; D]], y: &[f64; D]) -> Option<Vec<f64>> {
    let count = edges.len();
    let mut rows: Vec<Vec<f64>> = edges
        .iter()
        .map(|e| edges.iter().chain(std::iter::once(y)).map(|other| dot(e, other)).collect())
        .collect();
    for k in 0..count {
        let pivot = rows[k][k];
        if pivot.is_nan() || pivot <= 0.0 {
            return None;
        }
        for i in 0..count {
            if i != k {
                let factor = rows[i][k] / pivot;
                for j in k..=count {
                    let of_pivot = rows[k][j];
                    rows[i][j] -= factor * of_pivot;
                }
            }
        }
    }
    Some((0..count).map(|k| rows[k][count] / rows[k][k]).collect())
}
