//! Weighted points and their pull on another one, in single precision, as many of them at a time as the machine has lanes for.

use pulp::{Simd, WithSimd};

/// The length of rows of points is a multiple of what any machine takes at a time.
const TOGETHER: usize = 16;

/// Points with weights.
///
/// Single precision: a sum over n points is right to 1e-6 √n of its size, and what a particle feels of another one is 1/M of it.
pub(crate) struct Cloud<const D: usize> {
    axes: [Vec<f32>; D],
    weights: Vec<f32>,
    /// Square of a length below which distances hardly count as smaller.
    softening: f32,
}

/// Σ₊ c/|y − x|, Σ c (y − x)/|y − x| and Σ c |y − x|.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pull<const D: usize> {
    pub inverse: f64,
    pub direction: [f64; D],
    pub distance: f64,
}

impl<const D: usize> Cloud<D> {
    /// Of points with the weights `weight`; `softening` > 0.
    pub fn new(points: &[[f64; D]], weight: impl Fn(usize) -> f64, softening: f32) -> Self {
        let row = |of: &dyn Fn(usize) -> f64| {
            let mut row: Vec<f32> = (0..points.len()).map(|index| of(index) as f32).collect();
            row.resize(points.len().next_multiple_of(TOGETHER), 0.0);
            row
        };
        Self {
            axes: std::array::from_fn(|axis| row(&|index| points[index][axis])),
            weights: row(&weight),
            softening,
        }
    }

    /// The pull on x. The order of summation, and with it the last bits, is the machine's.
    pub fn pull(&self, x: &[f64; D]) -> Pull<D> {
        pulp::Arch::new().dispatch(At { cloud: self, x })
    }
}

/// The pull of a cloud at a place.
struct At<'a, const D: usize> {
    cloud: &'a Cloud<D>,
    x: &'a [f64; D],
}

impl<const D: usize> WithSimd for At<'_, D> {
    type Output = Pull<D>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Pull<D> {
        let weights = S::as_simd_f32s(&self.cloud.weights).0;
        let count = weights.len();
        let axes: [&[S::f32s]; D] = std::array::from_fn(|axis| &S::as_simd_f32s(&self.cloud.axes[axis]).0[..count]);
        let x: [S::f32s; D] = std::array::from_fn(|axis| simd.splat_f32s(self.x[axis] as f32));
        let (zero, softening) = (simd.splat_f32s(0.0), simd.splat_f32s(self.cloud.softening));
        let (mut inverses, mut directions, mut distances) = (zero, [zero; D], zero);
        for index in 0..count {
            let mut square = softening;
            let mut apart = [zero; D];
            for axis in 0..D {
                apart[axis] = simd.sub_f32s(axes[axis][index], x[axis]);
                square = simd.mul_add_e_f32s(apart[axis], apart[axis], square);
            }
            let inverse = simd.mul_f32s(weights[index], inverse_root(simd, square));
            inverses = simd.add_f32s(inverses, simd.max_f32s(inverse, zero));
            distances = simd.mul_add_e_f32s(inverse, square, distances);
            for axis in 0..D {
                directions[axis] = simd.mul_add_e_f32s(inverse, apart[axis], directions[axis]);
            }
        }
        let total = |lanes: S::f32s| f64::from(simd.reduce_sum_f32s(lanes));
        Pull {
            inverse: total(inverses),
            direction: std::array::from_fn(|axis| total(directions[axis])),
            distance: total(distances),
        }
    }
}

/// 1/√x of normal positive numbers to 5e-6 of it: a guess from the bits, and two of Newton's steps.
///
/// C. Lomont, *Fast inverse square root*, 2003. A root and a division take longer.
#[inline(always)]
fn inverse_root<S: Simd>(simd: S, x: S::f32s) -> S::f32s {
    let halved = simd.wrapping_dyn_shr_u32s(simd.transmute_u32s_f32s(x), simd.splat_u32s(1));
    let guess = simd.transmute_f32s_u32s(simd.sub_u32s(simd.splat_u32s(0x5f37_5a86), halved));
    let minus_half = simd.mul_f32s(x, simd.splat_f32s(-0.5));
    let newton = |y: S::f32s| {
        let excess = simd.mul_add_e_f32s(simd.mul_f32s(minus_half, y), y, simd.splat_f32s(1.5));
        simd.mul_f32s(y, excess)
    };
    newton(newton(guess))
}

#[cfg(test)]
mod tests {
    use mpm_tensor::vector;

    use super::*;

    #[test]
    fn a_pull_is_the_sum_over_all_points_of_any_number() {
        let at = |n: usize| [0.7, 1.9, 2.3].map(|rate: f64| (rate * n as f64 + 0.3).sin());
        let weight = |n: usize| (1.3 * n as f64).cos();
        for count in [0, 1, 15, 16, 100] {
            let points: Vec<[f64; 3]> = (0..count).map(at).collect();
            let x = [0.1, 1.2, -0.3];
            let found = Cloud::new(&points, weight, 1e-12).pull(&x);
            let mut wanted = Pull {
                inverse: 0.0,
                direction: [0.0; 3],
                distance: 0.0,
            };
            for (n, y) in points.iter().enumerate() {
                let apart = vector::subtract(y, &x);
                let distance = vector::norm(&apart);
                wanted.inverse += (weight(n) / distance).max(0.0);
                wanted.distance += weight(n) * distance;
                vector::accumulate(&mut wanted.direction, weight(n) / distance, &apart);
            }
            let tolerance = 1e-5 * (1.0 + count as f64);
            assert!(
                (found.inverse - wanted.inverse).abs() < tolerance,
                "{found:?} {wanted:?}"
            );
            assert!(
                (found.distance - wanted.distance).abs() < tolerance,
                "{found:?} {wanted:?}"
            );
            let off = vector::distance(&found.direction, &wanted.direction);
            assert!(off < tolerance, "{found:?} {wanted:?}");
        }
    }

    #[test]
    fn a_point_does_not_pull_itself() {
        let points = [[0.5, 0.5], [1.0, 0.5]];
        let pull = Cloud::new(&points, |_| 0.5, f32::MIN_POSITIVE).pull(&points[0]);
        assert!((pull.distance - 0.25).abs() < 1e-5 && (pull.direction[0] - 0.5).abs() < 1e-5);
    }
}
