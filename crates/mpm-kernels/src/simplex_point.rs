//! Where a point is in its simplex: sorting up to eight fractions without a branch.

/// Largest number of axes: one takes three bits.
pub const AXES: usize = 8;

/// A point of a Kuhn simplex: its fractions f in descending order, and the axes that they belong to.
///
/// Entry k is 1 + f_π(k+1), with the axis π(k+1) in the last three of its bits. Fractions are rounded down to multiples of
/// 2⁻⁴⁹ before: weights are then exact, and their sum is exactly one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SimplexPoint<const D: usize>(pub(crate) [f64; D]);

/// The bits that carry an axis.
const AXIS: u64 = AXES as u64 - 1;

impl<const D: usize> Default for SimplexPoint<D> {
    fn default() -> Self {
        let [point] = Self::sorted(&[[0.0; 1]; D]);
        point
    }
}

impl<const D: usize> SimplexPoint<D> {
    /// The points with the given fractions, in [0, 1]: L points side by side, `fractions[axis][point]`.
    #[inline(always)]
    pub fn sorted<const L: usize>(fractions: &[[f64; L]; D]) -> [Self; L] {
        let network = const { comparators::<D>() };
        let mut keys = [[0.0; L]; D];
        for a in 0..D {
            for l in 0..L {
                keys[a][l] = f64::from_bits(((fractions[a][l] + 1.0).to_bits() & !AXIS) | a as u64);
            }
        }
        for comparator in 0..network.1 {
            let (i, j) = (network.0[comparator].0 as usize, network.0[comparator].1 as usize);
            let (a, b) = (keys[i], keys[j]);
            for l in 0..L {
                // In lanes either form becomes the machine's maximum and minimum; in few dimensions the second would
                // become a branch that no one can predict, in more the first brings checks for NaN along.
                keys[i][l] = if D <= 2 {
                    a[l].max(b[l])
                } else if a[l] > b[l] {
                    a[l]
                } else {
                    b[l]
                };
                keys[j][l] = if D <= 2 {
                    a[l].min(b[l])
                } else if a[l] < b[l] {
                    a[l]
                } else {
                    b[l]
                };
            }
        }
        std::array::from_fn(|l| Self(std::array::from_fn(|k| keys[k][l])))
    }

    /// The axis π(k+1) along which vertex k + 1 follows vertex k.
    #[inline(always)]
    pub fn axis(&self, k: usize) -> usize {
        (self.0[k].to_bits() & AXIS) as usize
    }

    /// 1 + f_π(k+1).
    #[inline(always)]
    pub fn level(&self, k: usize) -> f64 {
        f64::from_bits(self.0[k].to_bits() & !AXIS)
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
            let fractions: [[f64; 1]; D] = std::array::from_fn(|a| [f64::from((pattern >> a) & 1)]);
            let [point] = SimplexPoint::sorted(&fractions);
            let mut seen = 0u32;
            let mut last = 2.0;
            for k in 0..D {
                let axis = point.axis(k);
                seen |= 1 << axis;
                assert_eq!(point.level(k), 1.0 + fractions[axis][0], "{pattern:b}: {point:?}");
                assert!(point.level(k) <= last, "{pattern:b}: {point:?}");
                last = point.level(k);
            }
            assert_eq!(seen, (1 << D) - 1, "{pattern:b}: not a permutation");
        }
    }

    #[test]
    fn networks_sort() {
        sorts_zeros_and_ones::<1>();
        sorts_zeros_and_ones::<2>();
        sorts_zeros_and_ones::<3>();
        sorts_zeros_and_ones::<4>();
        sorts_zeros_and_ones::<5>();
        sorts_zeros_and_ones::<6>();
        sorts_zeros_and_ones::<7>();
        sorts_zeros_and_ones::<8>();
        assert_eq!(comparators::<8>().1, 19);
    }
}
