//! Families of maps in closed form, for the tests within the crate.

use mpm_tensor::{Matrix, vector};

use super::{Evaluation, Manifold, Wanted};

/// A displacement field of X with its gradient.
type Field<const D: usize> = fn(usize, &[f64; D]) -> ([f64; D], Matrix<D>);

/// g̃(X, x̂) = X + Σ_k (x̂_k + c x̂_k²) u_k(X): linear in the fields u_k, and not in the coordinates unless c = 0.
pub(crate) struct Fields<const D: usize> {
    /// r.
    pub coordinates: usize,
    /// u_k and ∇u_k by k.
    pub field: Field<D>,
    /// c.
    pub curvature: f64,
}

impl<const D: usize> Fields<D> {
    /// Translations: u_k = e_k.
    pub fn translations() -> Self {
        Self {
            coordinates: D,
            field: |k, _| (std::array::from_fn(|a| f64::from(u8::from(a == k))), Matrix::ZERO),
            curvature: 0.0,
        }
    }

    /// All affine maps: translations, then u = X_j e_i, k = D + i D + j.
    pub fn affine() -> Self {
        Self {
            coordinates: D + D * D,
            field: |k, x| {
                if k < D {
                    return (std::array::from_fn(|a| f64::from(u8::from(a == k))), Matrix::ZERO);
                }
                let (i, j) = ((k - D) / D, (k - D) % D);
                let entry = |a: usize, b: usize| f64::from(u8::from(a == i && b == j));
                (std::array::from_fn(|a| entry(a, j) * x[j]), Matrix::from_fn(entry))
            },
            curvature: 0.0,
        }
    }

    /// Bending of the first axis into the second: u_0 = X_0² e_1, u_1 = X_0 X_1 e_0, u_2 = X_0³ e_1, …; nonlinear in the coordinates.
    pub fn bending(coordinates: usize) -> Self {
        Self {
            coordinates,
            field: |k, x| {
                let (i, j, n) = (usize::from(k % 2 == 0), k % 2, k as i32 / 2 + 2 - (k as i32 % 2));
                let mut u = [0.0; D];
                let mut gradient = Matrix::ZERO;
                let other = if j == 1 { x[1] } else { 1.0 };
                u[i] = x[0].powi(n) * other;
                gradient.0[i][0] = f64::from(n) * x[0].powi(n - 1) * other;
                if j == 1 {
                    gradient.0[i][1] = x[0].powi(n);
                }
                (u, gradient)
            },
            curvature: 0.3,
        }
    }
}

impl<const D: usize> Manifold<D> for Fields<D> {
    fn coordinates(&self) -> usize {
        self.coordinates
    }

    fn evaluate(&self, reference: &[[f64; D]], latent: &[f64], wanted: Wanted, out: &mut Evaluation<D>) {
        out.positions.clear();
        out.gradients.clear();
        out.jacobians.clear();
        for x in reference {
            let (mut position, mut gradient) = (*x, Matrix::IDENTITY);
            for (k, y) in latent.iter().enumerate() {
                let (u, grad) = (self.field)(k, x);
                let amplitude = y + self.curvature * y * y;
                vector::accumulate(&mut position, amplitude, &u);
                gradient += grad * amplitude;
                if wanted.jacobians {
                    out.jacobians.push(vector::scale(&u, 1.0 + 2.0 * self.curvature * y));
                }
            }
            out.positions.push(position);
            if wanted.gradients {
                out.gradients.push(gradient);
            }
        }
    }
}
