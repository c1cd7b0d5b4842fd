//! The point of the mesh that is nearest to one outside.

use mpm_tensor::vector::{accumulate, distance, dot, subtract};

use super::{CellSearch, Located};
use crate::NO_CELL;

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
    /// The point of the mesh that is nearest to `x`, if it is at most `reach` away; of several cells that have it the lowest.
    pub fn nearest(&self, x: &[f64; D], reach: f64) -> Option<NearestPoint<D>> {
        if let Some(located) = self.locate(x, None) {
            let (position, distance) = (*x, 0.0);
            return Some(NearestPoint {
                located,
                position,
                distance,
            });
        }
        if !x.iter().all(|c| c.is_finite()) {
            return None;
        }
        let mut candidates = Vec::new();
        self.buckets
            .for_each_in(&x.map(|c| c - reach), &x.map(|c| c + reach), |bucket| {
                let at_boundary = |&&cell: &&u32| self.mesh.neighbours(cell as usize).contains(&NO_CELL);
                candidates.extend(self.buckets.cells(bucket).iter().filter(at_boundary));
            });
        candidates.sort_unstable();
        candidates.dedup();
        let mut best: Option<NearestPoint<D>> = None;
        for cell in candidates {
            let near = self.nearest_in_cell(cell, x);
            if near.distance <= reach && best.is_none_or(|best| near.distance < best.distance) {
                best = Some(near);
            }
        }
        best
    }

    /// The point of a cell that is nearest to `x`: the nearest of those of its faces. The faces of one vertex always have one.
    pub(crate) fn nearest_in_cell(&self, cell: u32, x: &[f64; D]) -> NearestPoint<D> {
        let vertices = self.mesh.cell(cell as usize);
        let corners: Vec<[f64; D]> = vertices.iter().map(|&v| self.mesh.vertices()[v as usize]).collect();
        let at = |barycentric: [f64; D]| {
            let mut position = corners[0];
            for n in 0..D {
                accumulate(&mut position, barycentric[n], &subtract(&corners[n + 1], &corners[0]));
            }
            NearestPoint {
                located: Located { cell, barycentric },
                position,
                distance: distance(x, &position),
            }
        };
        let mut best = at([0.0; D]);
        for set in 1u32..1 << (D + 1) {
            let face: Vec<usize> = (0..=D).filter(|n| set >> n & 1 == 1).collect();
            if let Some(near) = nearest_in_face(&corners, &face, x).map(at)
                && near.distance < best.distance
            {
                best = near;
            }
        }
        best
    }
}

/// The point of a face, given by the places of its vertices in the cell, that is nearest to `x`; `None` where that of its plane lies beside it.
fn nearest_in_face<const D: usize>(corners: &[[f64; D]], face: &[usize], x: &[f64; D]) -> Option<[f64; D]> {
    let origin = &corners[face[0]];
    let edges: Vec<[f64; D]> = face[1..].iter().map(|&n| subtract(&corners[n], origin)).collect();
    let shares = least_squares(&edges, &subtract(x, origin))?;
    let first = 1.0 - shares.iter().sum::<f64>();
    let mut barycentric = [0.0; D];
    for (&n, &share) in face.iter().zip(std::iter::once(&first).chain(&shares)) {
        if share < 0.0 {
            return None;
        }
        if n > 0 {
            barycentric[n - 1] = share;
        }
    }
    Some(barycentric)
}

/// c with the least |Σ_k c_k e_k − y|, by Gaussian elimination on eᵀe c = eᵀy; `None` where the edges are dependent.
fn least_squares<const D: usize>(edges: &[[f64; D]], y: &[f64; D]) -> Option<Vec<f64>> {
    let count = edges.len();
    let mut rows: Vec<Vec<f64>> = edges
        .iter()
        .map(|e| {
            edges
                .iter()
                .chain(std::iter::once(y))
                .map(|other| dot(e, other))
                .collect()
        })
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
