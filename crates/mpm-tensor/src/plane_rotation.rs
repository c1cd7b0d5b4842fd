//! The rotation that makes a symmetric 2 × 2 matrix diagonal, and sweeps of such over all pairs.

use crate::Matrix;

/// Above this |θ| the tangent 1 / 2θ is exact to rounding, and θ² might overflow.
const LARGE_THETA: f64 = 1e9;

/// Sweeps after which the iteration stops in any case; it converges in 2 to 15 sweeps for D ≤ 8.
const MAXIMUM_SWEEPS: usize = 60;

/// Lets `rotate` look at every pair p < q below D, again and again until it rotates none of them.
#[inline]
pub(crate) fn sweep<const D: usize>(mut rotate: impl FnMut(usize, usize) -> bool) {
    for _ in 0..MAXIMUM_SWEEPS {
        let mut rotated = false;
        for p in 0..D {
            for q in p + 1..D {
                rotated |= rotate(p, q);
            }
        }
        if !rotated {
            break;
        }
    }
}

/// The rotation by at most 45° that makes the symmetric matrix [[a, b], [b, c]] diagonal, b ≠ 0.
///
/// Stored for the update p ← p − s (q + τ p), q ← q + s (p − τ q), τ = s / (1 + cos), which loses less to rounding than
/// p cos − q s (Rutishauser, *The Jacobi method for real symmetric matrices*, Numer. Math. 9, 1966).
pub(crate) struct PlaneRotation {
    /// The tangent t of the angle: the smaller root of t² + 2θt − 1 = 0, θ = (c − a) / 2b. The diagonal becomes a − tb, c + tb.
    pub(crate) tangent: f64,
    sine: f64,
    tau: f64,
}

impl PlaneRotation {
    /// From the diagonal entries a and c and the off-diagonal entry b.
    #[inline]
    pub(crate) fn diagonalising(a: f64, b: f64, c: f64) -> Self {
        let theta = (c - a) / (2.0 * b);
        let tangent = if theta.abs() > LARGE_THETA {
            0.5 / theta
        } else {
            (1.0 / (theta.abs() + (theta * theta + 1.0).sqrt())).copysign(theta)
        };
        let cosine = 1.0 / (tangent * tangent + 1.0).sqrt();
        let sine = tangent * cosine;
        Self {
            tangent,
            sine,
            tau: sine / (1.0 + cosine),
        }
    }

    /// The rotated pair (p cos − q sin, p sin + q cos).
    #[inline]
    pub(crate) fn apply(&self, p: f64, q: f64) -> (f64, f64) {
        (p - self.sine * (q + self.tau * p), q + self.sine * (p - self.tau * q))
    }

    /// Rotates the rows p and q of a matrix.
    #[inline]
    pub(crate) fn apply_to_rows<const D: usize>(&self, matrix: &mut Matrix<D>, p: usize, q: usize) {
        for column in 0..D {
            let (first, second) = self.apply(matrix.0[p][column], matrix.0[q][column]);
            matrix.0[p][column] = first;
            matrix.0[q][column] = second;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_off_diagonal_entry_vanishes() {
        for (a, b, c) in [
            (2.0, 1.0, 2.0),
            (1.0, -3.0, 5.0),
            (1.0, 1e-9, 0.0),
            (1e-20, 1e-12, 4.0),
            (0.0, 1.0, 0.0),
        ] {
            let rotation = PlaneRotation::diagonalising(a, b, c);
            let mut matrix = Matrix([[a, b], [b, c]]);
            rotation.apply_to_rows(&mut matrix, 0, 1);
            let mut matrix = matrix.transpose();
            rotation.apply_to_rows(&mut matrix, 0, 1);
            let size = a.abs().max(b.abs()).max(c.abs());
            assert!(
                matrix.0[0][1].abs() <= 4e-16 * size && matrix.0[1][0].abs() <= 4e-16 * size,
                "{matrix:?}"
            );
            assert!((matrix.0[0][0] - (a - rotation.tangent * b)).abs() <= 1e-15 * size);
            assert!((matrix.0[1][1] - (c + rotation.tangent * b)).abs() <= 1e-15 * size);
        }
    }
}
