//! Volume and barycentric coordinates of a simplex.

use mpm_tensor::Matrix;
use mpm_tensor::vector::{dot, subtract};

/// The barycentric coordinates λ₀ … λ_D of a cell, affine functions with λ_k(x_j) = δ_kj and Σ_k λ_k = 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame<const D: usize> {
    /// x₀.
    origin: [f64; D],
    /// Rows ∇λ₁ … ∇λ_D: the inverse of the matrix with columns x_k − x₀.
    gradients: Matrix<D>,
}

impl<const D: usize> Frame<D> {
    /// Of a cell that is not flat.
    pub(crate) fn new(vertices: &[[f64; D]], cell: &[u32]) -> Self {
        Self {
            origin: vertices[cell[0] as usize],
            gradients: edges(vertices, cell).inverse().unwrap_or(Matrix::ZERO),
        }
    }

    /// Position of vertex 0 of the cell.
    pub fn origin(&self) -> &[f64; D] {
        &self.origin
    }

    /// ∇λ_k for k = 0 … D: normal to the facet opposite vertex k, inward, of length one over the height above it.
    ///
    /// # Panics
    ///
    /// Where k is above D, as an index of an array does.
    pub fn gradient(&self, k: usize) -> [f64; D] {
        if k > 0 {
            return self.gradients.0[k - 1];
        }
        std::array::from_fn(|a| -(0..D).map(|row| self.gradients.0[row][a]).sum::<f64>())
    }

    /// λ_k(x) for k = 0 … D.
    ///
    /// # Panics
    ///
    /// Where k is above D, as an index of an array does.
    pub fn coordinate(&self, k: usize, x: &[f64; D]) -> f64 {
        let offset = subtract(x, &self.origin);
        if k > 0 {
            return dot(&self.gradients.0[k - 1], &offset);
        }
        1.0 - self.gradients.0.iter().map(|row| dot(row, &offset)).sum::<f64>()
    }

    /// λ_1(x), …, λ_D(x); λ_0(x) is what they leave of one.
    #[inline(always)]
    pub fn coordinates(&self, x: &[f64; D]) -> [f64; D] {
        self.gradients.apply(&subtract(x, &self.origin))
    }

    /// The least of the λ_k(x): not negative inside the cell, zero on its boundary.
    pub fn least_coordinate(&self, x: &[f64; D]) -> f64 {
        let offset = subtract(x, &self.origin);
        let (mut least, mut rest) = (f64::INFINITY, 1.0);
        for row in &self.gradients.0 {
            let coordinate = dot(row, &offset);
            least = least.min(coordinate);
            rest -= coordinate;
        }
        least.min(rest)
    }
}

/// The matrix with columns x_k − x₀, k = 1 … D.
fn edges<const D: usize>(vertices: &[[f64; D]], cell: &[u32]) -> Matrix<D> {
    let position = |k: usize| &vertices[cell[k] as usize];
    Matrix::from_fn(|axis, k| position(k + 1)[axis] - position(0)[axis])
}

/// det(x₁ − x₀, …, x_D − x₀) / D!.
pub(crate) fn signed_volume<const D: usize>(vertices: &[[f64; D]], cell: &[u32]) -> f64 {
    let factorial: usize = (1..=D).product();
    edges(vertices, cell).determinant() / factorial as f64
}
