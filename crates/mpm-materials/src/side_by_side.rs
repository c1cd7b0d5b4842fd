//! Several deformation gradients side by side: one instruction works on all of them.

use mpm_tensor::Matrix;
use wide::f64x4;

/// Matrices in a group.
pub(crate) const LANES: usize = 4;

/// Four matrices, one per lane.
#[derive(Clone, Copy)]
pub(crate) struct Group<const D: usize>([[f64x4; D]; D]);

/// The groups of `matrices`. What is missing of the last group is its last matrix: a matrix has the same results in any company.
#[inline(always)]
pub(crate) fn groups<const D: usize>(matrices: &[Matrix<D>]) -> impl Iterator<Item = Group<D>> {
    matrices
        .chunks(LANES)
        .map(|chunk| match <&[Matrix<D>; LANES]>::try_from(chunk) {
            Ok(full) => Group::of(full),
            Err(_) => Group::of(&std::array::from_fn(|lane| chunk[lane.min(chunk.len() - 1)])),
        })
}

#[allow(non_snake_case)]
impl<const D: usize> Group<D> {
    #[inline(always)]
    fn of([a, b, c, d]: &[Matrix<D>; LANES]) -> Self {
        let mut group = Self([[f64x4::ZERO; D]; D]);
        for i in 0..D {
            for j in 0..D {
                group.0[i][j] = f64x4::new([a.0[i][j], b.0[i][j], c.0[i][j], d.0[i][j]]);
            }
        }
        group
    }

    /// To up to four matrices.
    #[inline(always)]
    pub fn write(&self, matrices: &mut [Matrix<D>]) {
        for i in 0..D {
            for j in 0..D {
                let entries = self.0[i][j].to_array();
                for (matrix, entry) in matrices.iter_mut().zip(entries) {
                    matrix.0[i][j] = entry;
                }
            }
        }
    }

    /// ln J, J = det F; NaN unless J is positive and finite. Only for D ≤ 3; NaN beyond.
    #[inline(always)]
    pub fn log_volume_ratio(&self) -> f64x4 {
        let J = self.determinant();
        let sound = J.simd_gt(f64x4::ZERO) & J.simd_lt(f64x4::splat(f64::INFINITY));
        sound.select(J.ln(), f64x4::splat(f64::NAN))
    }

    /// As [`Matrix::determinant`], to the last bit.
    #[inline(always)]
    fn determinant(&self) -> f64x4 {
        let a = &self.0;
        match D {
            1 => a[0][0],
            2 => a[0][0] * a[1][1] - a[0][1] * a[1][0],
            3 => {
                a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1])
                    + a[0][1] * (a[1][2] * a[2][0] - a[1][0] * a[2][2])
                    + a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0])
            }
            _ => f64x4::splat(f64::NAN),
        }
    }

    /// b = F Fᵀ, exactly symmetric.
    #[inline(always)]
    pub fn left_cauchy_green(&self) -> Self {
        let mut b = Self([[f64x4::ZERO; D]; D]);
        for i in 0..D {
            for j in 0..=i {
                let mut sum = self.0[i][0] * self.0[j][0];
                for k in 1..D {
                    sum = self.0[i][k].mul_add(self.0[j][k], sum);
                }
                (b.0[i][j], b.0[j][i]) = (sum, sum);
            }
        }
        b
    }

    /// `factor` A + `shift` I.
    #[inline(always)]
    pub fn scaled_and_shifted(mut self, factor: f64, shift: f64x4) -> Self {
        for i in 0..D {
            for j in 0..D {
                self.0[i][j] *= factor;
            }
            self.0[i][i] += shift;
        }
        self
    }

    /// The largest sum of absolute entries over the rows; without meaning where an entry is NaN.
    #[inline(always)]
    pub fn largest_row_sum(&self) -> f64x4 {
        let mut largest = f64x4::ZERO;
        for i in 0..D {
            let mut sum = f64x4::ZERO;
            for j in 0..D {
                sum += self.0[i][j].abs();
            }
            largest = largest.fast_max(sum);
        }
        largest
    }
}
