//! The rotations of four deformation gradients at once.

use wide::f64x4;

use crate::side_by_side::Group;

/// Steps after which the iteration is left; scaled, it needs at most nine for any matrix that double precision tells from a singular one
/// (Higham 2008, §8.6).
const MOST_STEPS: usize = 20;

/// Once a step changes R by less than this, relative to ‖R‖, the next would change nothing: convergence is quadratic.
const CHANGE: f64 = 1e-8;

impl<const D: usize> Group<D> {
    /// R of F = R U for det F > 0, D ≤ 3; without meaning elsewhere.
    ///
    /// D = 2: the closed form of [`Polar`](mpm_tensor::Polar). D = 3: Newton's iteration R ← (ζ R + ζ⁻¹ R⁻ᵀ)/2 from R = F with
    /// ζ² = ‖R⁻ᵀ‖ / ‖R‖ in the Frobenius norm, quadratic from any F of full rank (Higham, *Functions of Matrices*, 2008, §8.3 and §8.6). A
    /// lane that has converged stays as it is, so that no matrix depends on its company.
    #[inline(always)]
    pub fn rotation(&self) -> Self {
        match D {
            1 => Self::diagonal(f64x4::splat(1.0)),
            2 => self.plane_rotation(),
            _ => self.nearest_rotation(),
        }
    }

    #[inline(always)]
    fn plane_rotation(&self) -> Self {
        let (cosine, sine) = (self.0[0][0] + self.0[1][1], self.0[1][0] - self.0[0][1]);
        let length = cosine.mul_add(cosine, sine * sine).sqrt();
        let mut rotation = Self::diagonal(cosine / length);
        (rotation.0[0][1], rotation.0[1][0]) = (-sine / length, sine / length);
        rotation
    }

    #[inline(always)]
    fn nearest_rotation(&self) -> Self {
        let mut rotation = *self;
        let mut settled = !self.determinant().simd_gt(f64x4::ZERO); // no rotation to look for, NaN too
        for _ in 0..MOST_STEPS {
            if settled.all() {
                break;
            }
            let mut inverse = rotation.cofactors(); // and transposed
            let reciprocal = 1.0 / rotation.determinant();
            for i in 0..D {
                for j in 0..D {
                    inverse.0[i][j] *= reciprocal;
                }
            }
            let size = rotation.squared_norm();
            let ratio = (inverse.squared_norm() / size).sqrt().sqrt(); // ζ
            let (own, other) = (ratio * 0.5, 0.5 / ratio);
            let mut change = f64x4::ZERO;
            for i in 0..D {
                for j in 0..D {
                    let next = rotation.0[i][j].mul_add(own, inverse.0[i][j] * other);
                    let step = next - rotation.0[i][j];
                    change = step.mul_add(step, change);
                    rotation.0[i][j] = settled.select(rotation.0[i][j], next);
                }
            }
            settled |= change.simd_le(size * (CHANGE * CHANGE));
        }
        rotation
    }

    /// J F⁻ᵀ, D = 3.
    #[inline(always)]
    fn cofactors(&self) -> Self {
        let a = &self.0;
        let mut cofactors = *self;
        for i in 0..D {
            let (i1, i2) = ((i + 1) % D, (i + 2) % D);
            for j in 0..D {
                let (j1, j2) = ((j + 1) % D, (j + 2) % D);
                cofactors.0[i][j] = a[i1][j1] * a[i2][j2] - a[i1][j2] * a[i2][j1];
            }
        }
        cofactors
    }

    #[inline(always)]
    fn squared_norm(&self) -> f64x4 {
        let mut sum = f64x4::ZERO;
        for i in 0..D {
            for j in 0..D {
                sum = self.0[i][j].mul_add(self.0[i][j], sum);
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use mpm_tensor::{Matrix, Polar};

    use crate::side_by_side::groups;

    /// R of U diag(σ) Vᵀ-like matrices against the singular value decomposition.
    fn rotations_are_those_of_the_decomposition<const D: usize>(stretches: [f64; D]) {
        for seed in 0..40 {
            let spread = |k: usize| ((seed * 31 + k * 17) % 23) as f64 - 11.0;
            let turned = |offset: usize| {
                let random =
                    Matrix::<D>::from_fn(|i, j| spread(offset + 3 * i + 5 * j) + if i == j { 13.0 } else { 0.0 });
                Polar::new(&random).expect("finite").rotation
            };
            let F = turned(1) * Matrix::diagonal(&stretches) * turned(7).transpose();
            let exact = Polar::new(&F).expect("finite").rotation;
            let mut found = [Matrix::ZERO];
            let Some(group) = groups(&[F]).next() else {
                unreachable!()
            };
            group.rotation().write(&mut found);
            let error = (found[0] - exact).maximum_norm();
            let condition = stretches.iter().fold(0.0, |most: f64, s| most.max(*s))
                / stretches.iter().fold(f64::MAX, |least, s| least.min(*s));
            assert!(error < 4e-16 * (8.0 + condition), "{stretches:?}: {error:e}");
        }
    }

    #[test]
    fn newton_finds_the_rotation_also_of_flat_and_long_bodies() {
        rotations_are_those_of_the_decomposition([1.0, 1.0, 1.0]);
        rotations_are_those_of_the_decomposition([1.3, 0.9, 0.7]);
        rotations_are_those_of_the_decomposition([100.0, 1.0, 0.01]);
        rotations_are_those_of_the_decomposition([1e3, 1e3, 1e-3]);
        rotations_are_those_of_the_decomposition([1e-30, 2e-30, 1e-30]);
        rotations_are_those_of_the_decomposition([2.0, 0.5]);
        rotations_are_those_of_the_decomposition([1e4, 1e-4]);
        rotations_are_those_of_the_decomposition([3.0]);
    }
}
