//! The deformation gradient after a step.

use mpm_tensor::Matrix;

use crate::lanes::Lanes;

/// (I + Δt L) F with the velocity gradient L. In three dimensions by rows, one row in lanes: the compiler leaves most of a product of 3 × 3 matrices to
/// single numbers and shuffles.
#[allow(non_snake_case)]
#[inline(always)]
pub fn deformed<const D: usize>(F: &Matrix<D>, velocity_gradient: &Matrix<D>, time_step: f64) -> Matrix<D> {
    if D != 3 {
        return (Matrix::IDENTITY + *velocity_gradient * time_step) * *F;
    }
    let row = |i: usize| Lanes::new([F.0[i][0], F.0[i][1], F.0[i][2], 0.0]);
    let rows = [row(0), row(1), row(2)];
    let mut moved = Matrix::ZERO;
    for i in 0..3 {
        let mut rate = Lanes::ZERO;
        for j in 0..3 {
            rate = rows[j].mul_add(Lanes::splat(velocity_gradient.0[i][j]), rate);
        }
        let sum = rate.mul_add(Lanes::splat(time_step), rows[i]).to_array();
        moved.0[i].copy_from_slice(&sum[..D]);
    }
    moved
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[allow(non_snake_case)]
    fn it_is_the_product() {
        fn check<const D: usize>() {
            let F = Matrix::<D>::from_fn(|i, j| 0.7 + i as f64 - 0.3 * (j * j) as f64);
            let L = Matrix::<D>::from_fn(|i, j| 0.2 * j as f64 - 1.1 * i as f64 + 0.4);
            let expected = (Matrix::IDENTITY + L * 0.3) * F;
            assert!((deformed(&F, &L, 0.3) - expected).maximum_norm() < 1e-14);
        }
        mpm_tensor::in_dimensions!(check(), 1, 2, 3, 4);
    }
}
