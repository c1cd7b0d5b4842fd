//! The spectral decomposition of a symmetric matrix.

use crate::Matrix;
use crate::plane_rotation::{PlaneRotation, sweep};
use crate::scaling::reciprocal_scale;

/// The spectral decomposition A = Q diag(λ) Qᵀ of a symmetric matrix, eigenvalues ascending.
///
/// By the cyclic Jacobi method (Golub & Van Loan, *Matrix Computations*, 4th ed., §8.5), which keeps the eigenvectors
/// orthonormal to rounding for clustered and repeated eigenvalues too.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SymmetricEigen<const D: usize> {
    /// The eigenvalues λ_0 ≤ λ_1 ≤ …, in the unit of A.
    pub values: [f64; D],
    /// The orthogonal matrix Q; column k is the eigenvector of `values[k]`.
    pub vectors: Matrix<D>,
}

impl<const D: usize> SymmetricEigen<D> {
    /// Decomposes the symmetric part ½ (A + Aᵀ) of `matrix`; `None` if an entry is not finite.
    pub fn new(matrix: &Matrix<D>) -> Option<Self> {
        let factor = reciprocal_scale(matrix)?;
        let mut a = (*matrix * factor).symmetric_part();
        // Row k is the eigenvector of a[k][k] once the off-diagonal entries have gone.
        let mut vectors = Matrix::<D>::IDENTITY;
        sweep::<D>(|p, q| annihilate(&mut a, &mut vectors, p, q));
        let mut order: [usize; D] = std::array::from_fn(|k| k);
        order.sort_by(|&k, &l| a.0[k][k].total_cmp(&a.0[l][l]));
        Some(Self {
            values: std::array::from_fn(|k| a.0[order[k]][order[k]] / factor),
            vectors: Matrix::from_fn(|i, k| vectors.0[order[k]][i]),
        })
    }

    /// The isotropic matrix function Q diag(f(λ)) Qᵀ, exactly symmetric; the identity function gives A back.
    pub fn map(&self, f: impl Fn(f64) -> f64) -> Matrix<D> {
        let mapped = self.values.map(f);
        let mut sum = Matrix::ZERO;
        for i in 0..D {
            for j in 0..=i {
                let mut entry = 0.0;
                for k in 0..D {
                    entry += mapped[k] * (self.vectors.0[i][k] * self.vectors.0[j][k]);
                }
                sum.0[i][j] = entry;
                sum.0[j][i] = entry;
            }
        }
        sum
    }
}

/// One Jacobi rotation A ← Jᵀ A J in the plane (p, q) that makes A_pq zero; false if A_pq is already negligible.
fn annihilate<const D: usize>(a: &mut Matrix<D>, vectors: &mut Matrix<D>, p: usize, q: usize) -> bool {
    let off_diagonal = a.0[p][q];
    let negligible = f64::EPSILON * a.0[p][p].abs().sqrt() * a.0[q][q].abs().sqrt();
    if off_diagonal.abs() <= negligible.max(f64::MIN_POSITIVE) {
        return false;
    }
    let rotation = PlaneRotation::diagonalising(a.0[p][p], off_diagonal, a.0[q][q]);
    a.0[p][p] -= rotation.tangent * off_diagonal;
    a.0[q][q] += rotation.tangent * off_diagonal;
    a.0[p][q] = 0.0;
    a.0[q][p] = 0.0;
    for r in (0..D).filter(|&r| r != p && r != q) {
        let (first, second) = rotation.apply(a.0[r][p], a.0[r][q]);
        a.0[r][p] = first;
        a.0[p][r] = first;
        a.0[r][q] = second;
        a.0[q][r] = second;
    }
    rotation.apply_to_rows(vectors, p, q);
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eigenvalues_ascend_and_reconstruct() {
        let a = Matrix([[2.0, 1.0], [1.0, 2.0]]);
        let eigen = SymmetricEigen::new(&a).expect("finite entries");
        assert!((eigen.values[0] - 1.0).abs() < 1e-15 && (eigen.values[1] - 3.0).abs() < 1e-15);
        assert!((eigen.map(|value| value) - a).frobenius_norm() < 1e-15);
        let root = eigen.map(f64::sqrt);
        assert!((root * root - a).frobenius_norm() < 2e-15);
    }

    #[test]
    fn non_finite_entries_have_none() {
        assert_eq!(SymmetricEigen::new(&Matrix([[1.0, f64::NAN], [0.0, 1.0]])), None);
        assert_eq!(SymmetricEigen::new(&Matrix([[f64::INFINITY]])), None);
        assert_eq!(
            SymmetricEigen::new(&Matrix::<3>::ZERO).map(|eigen| eigen.values),
            Some([0.0; 3])
        );
    }
}
