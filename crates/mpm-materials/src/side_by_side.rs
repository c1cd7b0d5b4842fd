//! Several deformation gradients side by side: one instruction works on all of them.

use mpm_tensor::Matrix;
use wide::f64x4;

/// Matrices in a group.
pub(crate) const LANES: usize = 4;

/// Four matrices, one per lane.
#[derive(Clone, Copy)]
pub(crate) struct Group<const D: usize>(pub(crate) [[f64x4; D]; D]);

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

    /// `value` I.
    #[inline(always)]
    pub fn diagonal(value: f64x4) -> Self {
        let mut group = Self([[f64x4::ZERO; D]; D]);
        for i in 0..D {
            group.0[i][i] = value;
        }
        group
    }

    /// J = det F; NaN unless it is positive and finite. Only for D ≤ 3; NaN beyond.
    #[inline(always)]
    pub fn volume_ratio(&self) -> f64x4 {
        let J = self.determinant();
        let sound = J.simd_gt(f64x4::ZERO) & J.simd_lt(f64x4::splat(f64::INFINITY));
        sound.select(J, f64x4::splat(f64::NAN))
    }

    /// ln J; NaN where the [`volume_ratio`](Self::volume_ratio) is.
    #[inline(always)]
    pub fn log_volume_ratio(&self) -> f64x4 {
        let J = self.volume_ratio();
        J.simd_eq(J).select(J.ln(), J)
    }

    /// As [`Matrix::determinant`], to the last bit.
    #[inline(always)]
    pub fn determinant(&self) -> f64x4 {
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

    /// A − B.
    #[inline(always)]
    pub fn minus(&self, other: &Self) -> Self {
        let mut difference = *self;
        for i in 0..D {
            for j in 0..D {
                difference.0[i][j] -= other.0[i][j];
            }
        }
        difference
    }

    /// (A Bᵀ + B Aᵀ)/2, exactly symmetric.
    #[inline(always)]
    pub fn symmetric_product(&self, other: &Self) -> Self {
        let mut product = Self([[f64x4::ZERO; D]; D]);
        for i in 0..D {
            for j in 0..=i {
                let mut sum = f64x4::ZERO;
                for k in 0..D {
                    sum = self.0[i][k].mul_add(other.0[j][k], sum);
                    sum = other.0[i][k].mul_add(self.0[j][k], sum);
                }
                (product.0[i][j], product.0[j][i]) = (sum * 0.5, sum * 0.5);
            }
        }
        product
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

/// √(`stiffness` / ρ₀) for up to four densities.
#[inline(always)]
pub(crate) fn write_wave_speeds(stiffness: f64x4, densities: &[f64], speeds: &mut [f64]) {
    let mut density = [1.0; LANES];
    density[..densities.len()].copy_from_slice(densities);
    let speed = (stiffness / f64x4::new(density)).sqrt().to_array();
    speeds.copy_from_slice(&speed[..speeds.len()]);
}

#[cfg(test)]
mod tests {
    use mpm_tensor::Matrix;

    use crate::{ElasticModuli, FixedCorotated, Material, NeoHookean};

    #[test]
    fn many_at_once_are_each_of_them_in_any_company() {
        let moduli = ElasticModuli::from_lame(3.0, 2.0).expect("in range");
        in_every_dimension(&FixedCorotated::new(moduli));
        in_every_dimension(&NeoHookean::new(moduli));
    }

    fn in_every_dimension<M>(material: &M)
    where
        M: Material<1> + Material<2> + Material<3> + Material<4>,
    {
        company_does_not_matter::<M, 1>(material);
        company_does_not_matter::<M, 2>(material);
        company_does_not_matter::<M, 3>(material);
        company_does_not_matter::<M, 4>(material);
    }

    /// What is worked out for several deformation gradients at once has the same bits for each of them whatever the others are, and is what is worked out for one.
    fn company_does_not_matter<M: Material<D>, const D: usize>(material: &M) {
        let deform = |k: usize| {
            let entry = |i: usize, j: usize| 0.05 * ((7 * k + 5 * i + 3 * j) % 11) as f64 - 0.2;
            let mut F = Matrix::<D>::from_fn(entry) + Matrix::IDENTITY;
            match k {
                3 => F.0[0] = [0.0; D],
                5 => F.0[0][D - 1] = f64::NAN,
                _ => {}
            }
            F
        };
        let F: Vec<Matrix<D>> = (0..11).map(deform).collect();
        let densities: Vec<f64> = (0..11).map(|k| 1.0 + 0.3 * k as f64).collect();
        for count in 0..=F.len() {
            let (mut stresses, mut speeds) = (vec![Matrix::ZERO; count], vec![0.0; count]);
            material.kirchhoff_stresses(&F[..count], &mut stresses);
            material.wave_speeds(&F[..count], &densities[..count], &mut speeds);
            for k in 0..count {
                let (mut stress, mut speed) = ([Matrix::ZERO], [0.0]);
                material.kirchhoff_stresses(&F[k..=k], &mut stress);
                material.wave_speeds(&F[k..=k], &densities[k..=k], &mut speed);
                let bits = |matrix: &Matrix<D>| matrix.0.map(|row| row.map(f64::to_bits));
                assert_eq!(bits(&stress[0]), bits(&stresses[k]));
                assert_eq!(speed[0].to_bits(), speeds[k].to_bits());
                let expected = material.kirchhoff_stress(&F[k]);
                let expected_speed = material.wave_speed(&F[k], densities[k]);
                assert_eq!(expected_speed.is_finite(), speeds[k].is_finite(), "{:?}", F[k]);
                assert_eq!(expected.trace().is_nan(), stresses[k].trace().is_nan());
                if expected_speed.is_finite() {
                    assert!((expected - stresses[k]).maximum_norm() < 1e-14 * (1.0 + expected.maximum_norm()));
                    assert!((expected_speed - speeds[k]).abs() < 1e-14 * expected_speed);
                }
            }
        }
    }
}
