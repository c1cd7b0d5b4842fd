//! Where a point is in its simplex: sorting up to eight fractions without a branch.

use crate::lanes::{LANES, Lanes};

/// Largest number of axes: one takes three bits.
pub const AXES: usize = 8;

/// A point of a Kuhn simplex: its fractions f in descending order, and the axes that they belong to.
///
/// Entry k is 1 + f_π(k+1) with the axis π(k+1) in the last three of its bits: f is known to 2⁻⁴⁹. All entries are multiples
/// of 2⁻⁵² in [1, 2), so that their differences, the weights, are exact, and the sum of the weights is exactly one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SimplexPoint<const D: usize>([f64; D]);

/// The bits that carry an axis.
const AXIS: u64 = AXES as u64 - 1;

/// The largest number below two that has no axis in its bits.
const TOP: f64 = 2.0 - (AXES as f64) * f64::EPSILON;

impl<const D: usize> Default for SimplexPoint<D> {
    fn default() -> Self {
        let [point, ..] = Self::sorted(&[Lanes::ZERO; D]);
        point
    }
}

impl<const D: usize> SimplexPoint<D> {
    /// Points with the given fractions, in [0, 1], side by side: `fractions[axis]`.
    #[inline(always)]
    pub fn sorted(fractions: &[Lanes; D]) -> [Self; LANES] {
        let network = const {
            assert!(D >= 1 && D <= AXES, "a simplex lattice has 1 to 8 dimensions");
            comparators::<D>()
        };
        let without_axis = Lanes::splat(f64::from_bits(!AXIS));
        let mut keys: [Lanes; D] = std::array::from_fn(|a| {
            let axis = Lanes::splat(f64::from_bits(a as u64));
            ((fractions[a] + 1.0).fast_min(Lanes::splat(TOP)) & without_axis) | axis
        });
        for comparator in 0..network.1 {
            let (i, j) = (network.0[comparator].0 as usize, network.0[comparator].1 as usize);
            (keys[i], keys[j]) = (keys[i].fast_max(keys[j]), keys[i].fast_min(keys[j]));
        }
        let keys = keys.map(Lanes::to_array);
        std::array::from_fn(|l| Self(std::array::from_fn(|k| keys[k][l])))
    }

    /// The axis π(k+1) along which vertex k + 1 follows vertex k.
    ///
    /// # Panics
    ///
    /// Where k is not below D, as an index of an array does.
    #[inline(always)]
    pub fn axis(&self, k: usize) -> usize {
        (self.0[k].to_bits() & AXIS) as usize
    }

    /// 1 + f_π(k+1).
    ///
    /// # Panics
    ///
    /// Where k is not below D, as an index of an array does.
    #[inline(always)]
    pub fn level(&self, k: usize) -> f64 {
        self.0[k]
    }
}

/// Batcher's odd–even merge sort: comparators (i, j), i < j, that sort D numbers, and how many there are.
const fn comparators<const D: usize>() -> ([(u8, u8); 19], usize) {
    let mut list = [(0, 0); 19];
    let (mut count, mut p) = (0, 1);
    while p < AXES {
        let mut k = p;
        while k >= 1 {
            let mut j = k % p;
            while j + k < AXES {
                let mut i = 0;
                while i < k {
                    let (low, high) = (i + j, i + j + k);
                    if high < D && low / (2 * p) == high / (2 * p) {
                        list[count] = (low as u8, high as u8);
                        count += 1;
                    }
                    i += 1;
                }
                j += 2 * k;
            }
            k /= 2;
        }
        p *= 2;
    }
    (list, count)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By the zero–one principle a network that sorts all sequences of zeros and ones sorts everything.
    fn sorts_zeros_and_ones<const D: usize>() {
        for pattern in 0..1u32 << D {
            let fractions: [f64; D] = std::array::from_fn(|a| f64::from((pattern >> a) & 1));
            let [point, ..] = SimplexPoint::sorted(&fractions.map(Lanes::splat));
            let mut seen = 0u32;
            let mut last = 2.0;
            for k in 0..D {
                let (axis, level) = (point.axis(k), point.level(k));
                seen |= 1 << axis;
                assert!((level - 1.0 - fractions[axis]).abs() < 4e-15, "{pattern:b}: {point:?}");
                assert!((1.0..last).contains(&level), "{pattern:b}: {point:?}");
                last = level;
            }
            assert_eq!(seen, (1 << D) - 1, "{pattern:b}: not a permutation");
        }
    }

    #[test]
    fn networks_sort() {
        mpm_tensor::in_dimensions!(sorts_zeros_and_ones(), 1, 2, 3, 4, 5, 6, 7, 8);
        assert_eq!(comparators::<8>().1, 19);
    }
}
