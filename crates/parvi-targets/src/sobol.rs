//! Sobol' points: a digital sequence in base 2, plain or with Owen's nested uniform scrambling.

use crate::TargetError;
use crate::direction_numbers::{DIRECTION_NUMBERS, SOBOL_MAXIMUM_DIMENSION};
use crate::error::within;

/// Levels of the binary tree whose 63 nodes have their bits from one hash.
const LEVELS_PER_HASH: u32 = 6;

/// Levels that are scrambled node by node: with fewer than 2³² points no two share a deeper node.
const NESTED_LEVELS: u32 = 36;

/// Sobol' points in the unit cube, any of the first 2³² in any order.
///
/// Coordinate s of point n is the exclusive-or of the direction numbers of the set bits of n (direction numbers of
/// S. Joe, F. Y. Kuo, *SIAM J. Sci. Comput.* 30 (2008) 2635–2654). Coordinates have 52 bits and are moved by 2⁻⁵³ to
/// the middle of their interval, so they lie strictly inside (0, 1): the plain sequence starts 2⁻⁵³, ½ + 2⁻⁵³, ….
///
/// Scrambled (A. B. Owen, *MCQMC in Scientific Computing*, 1995, 299–317): each bit is flipped by a random bit
/// that belongs to the bits above it, here a hash of seed, coordinate and those bits. Every point is then uniform on
/// the cube, any 2ᵐ aligned points keep their equidistribution, and independent seeds give independent estimates of the
/// error. One hash has the bits of a node and of its descendants over six levels; those below the 36th level belong to one point each and come from a single one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SobolSequence {
    /// Per coordinate: the direction numbers, and the key of the scrambling.
    axes: Vec<([u64; 32], Option<u64>)>,
}

impl SobolSequence {
    /// The plain sequence.
    ///
    /// # Errors
    /// [`TargetError::OutOfRange`] unless 1 ≤ `dimension` ≤ [`SOBOL_MAXIMUM_DIMENSION`].
    pub fn plain(dimension: usize) -> Result<Self, TargetError> {
        let is_allowed = (1..=SOBOL_MAXIMUM_DIMENSION).contains(&dimension);
        within(
            "the dimension of the Sobol' sequence",
            dimension as f64,
            is_allowed,
            "1 to 21",
        )?;
        Ok(Self {
            axes: (0..dimension).map(|axis| (directions(axis), None)).collect(),
        })
    }

    /// The sequence scrambled with a seed.
    ///
    /// # Errors
    /// As [`plain`](Self::plain).
    pub fn scrambled(dimension: usize, seed: u64) -> Result<Self, TargetError> {
        let mut sequence = Self::plain(dimension)?;
        let mut key = mixed(seed);
        for (_, scrambling) in &mut sequence.axes {
            key = mixed(key);
            *scrambling = Some(key);
        }
        Ok(sequence)
    }

    /// The number of coordinates.
    pub fn dimension(&self) -> usize {
        self.axes.len()
    }

    /// Writes point `index` into the first [`dimension`](Self::dimension) entries of `point` (fewer if it is shorter).
    pub fn write(&self, index: u32, point: &mut [f64]) {
        for ((directions, key), coordinate) in self.axes.iter().zip(point) {
            let mut bits = 0;
            let mut rest = index;
            while rest != 0 {
                bits ^= directions[rest.trailing_zeros() as usize];
                rest &= rest - 1;
            }
            if let Some(key) = key {
                bits = scrambled_bits(bits, *key);
            }
            *coordinate = ((bits >> 12) as f64 + 0.5) * 0.5_f64.powi(52);
        }
    }

    /// Point `index`.
    pub fn point(&self, index: u32) -> Vec<f64> {
        let mut point = vec![0.0; self.dimension()];
        self.write(index, &mut point);
        point
    }
}

/// The direction numbers v_k of a coordinate as fractions of 2⁶⁴: van der Corput for the first, else by the recurrence
/// m_k = 2a₁m_{k−1} ⊕ … ⊕ 2^(s−1)a_{s−1}m_{k−s+1} ⊕ 2^s m_{k−s} ⊕ m_{k−s} of its primitive polynomial.
fn directions(axis: usize) -> [u64; 32] {
    if axis == 0 {
        return std::array::from_fn(|k| 1 << (63 - k));
    }
    let (coefficients, initial) = DIRECTION_NUMBERS[axis - 1];
    let degree = initial.len();
    let mut v = [0_u64; 32];
    for k in 0..32 {
        v[k] = if k < degree {
            u64::from(initial[k]) << (63 - k)
        } else {
            let mut next = v[k - degree] ^ (v[k - degree] >> degree);
            for j in 1..degree {
                if coefficients >> (degree - 1 - j) & 1 == 1 {
                    next ^= v[k - j];
                }
            }
            next
        };
    }
    v
}

/// Owen's scrambling of the fraction `bits` / 2⁶⁴.
fn scrambled_bits(bits: u64, key: u64) -> u64 {
    // Of a node: which bits stand above it, and how many.
    let hash = |level: u32| {
        let above = if level == 0 { 0 } else { bits >> (64 - level) };
        mixed(key ^ (above | 1 << level).wrapping_mul(0x9E37_79B9_7F4A_7C15))
    };
    let mut flips = hash(NESTED_LEVELS) >> NESTED_LEVELS;
    for top in (0..NESTED_LEVELS).step_by(LEVELS_PER_HASH as usize) {
        let nodes = hash(top);
        let path = bits >> (64 - LEVELS_PER_HASH - top);
        for level in 0..LEVELS_PER_HASH {
            // The root is the first node, the children of the n-th are the 2n-th and the one after it.
            let node = 1 << level | (path >> (LEVELS_PER_HASH - level)) & ((1 << level) - 1);
            flips |= (nodes >> node & 1) << (63 - top - level);
        }
    }
    bits ^ flips
}

/// The finaliser of SplitMix64 (G. L. Steele, D. Lea, C. H. Flood, OOPSLA 2014), of a value one step further on.
fn mixed(value: u64) -> u64 {
    let mut z = value.wrapping_add(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn starts_with_the_published_points() {
        // The first eight points of the three-dimensional sequence, in natural order.
        let expected = [
            [0.0, 0.0, 0.0],
            [0.5, 0.5, 0.5],
            [0.25, 0.75, 0.75],
            [0.75, 0.25, 0.25],
            [0.125, 0.625, 0.375],
            [0.625, 0.125, 0.875],
            [0.375, 0.375, 0.625],
            [0.875, 0.875, 0.125],
        ];
        let sequence = SobolSequence::plain(3).unwrap();
        for (index, expected) in (0..).zip(expected) {
            for (found, expected) in sequence.point(index).iter().zip(expected) {
                assert!(
                    (found - expected).abs() < 1e-15,
                    "point {index}: {found} for {expected}"
                );
            }
        }
    }

    #[test]
    fn every_coordinate_hits_every_interval_once() {
        let dimension = SOBOL_MAXIMUM_DIMENSION;
        for sequence in [
            SobolSequence::plain(dimension).unwrap(),
            SobolSequence::scrambled(dimension, 7).unwrap(),
        ] {
            for m in [3, 8, 12] {
                let count = 1_usize << m;
                // An aligned block away from the start as well.
                for start in [0, 5 * count] {
                    let mut hits = vec![vec![false; count]; dimension];
                    for index in start..start + count {
                        for (axis, u) in sequence.point(index as u32).into_iter().enumerate() {
                            assert!(0.0 < u && u < 1.0);
                            hits[axis][(u * count as f64) as usize] = true;
                        }
                    }
                    assert!(hits.iter().flatten().all(|&hit| hit));
                }
            }
        }
    }

    #[test]
    fn the_first_two_coordinates_form_a_net() {
        // A (0, m, 2)-net: one point in every box of area 2^−m, whatever its shape; scrambling keeps that.
        let m = 10;
        for sequence in [
            SobolSequence::plain(2).unwrap(),
            SobolSequence::scrambled(2, 3).unwrap(),
        ] {
            for split in 0..=m {
                let (columns, rows) = (1_usize << split, 1_usize << (m - split));
                let mut hits = vec![false; 1 << m];
                for index in 0..1 << m {
                    let point = sequence.point(index);
                    let (i, j) = ((point[0] * columns as f64) as usize, (point[1] * rows as f64) as usize);
                    hits[i * rows + j] = true;
                }
                assert!(hits.iter().all(|&hit| hit), "split {split}");
            }
        }
    }

    #[test]
    fn integrates_far_better_than_independent_points() {
        // ∏ (1 + (u_j − ½)) over six coordinates: integral 1, variance (1 + 1/12)⁶ − 1.
        let count = 1 << 14;
        let independent = (((1.0_f64 + 1.0 / 12.0).powi(6) - 1.0) / f64::from(count)).sqrt();
        let seeds = 32;
        let square: f64 = (0..seeds)
            .map(|seed| {
                let sequence = SobolSequence::scrambled(6, seed).unwrap();
                let sum: f64 = (0..count)
                    .map(|index| sequence.point(index).iter().map(|u| 0.5 + u).product::<f64>())
                    .sum();
                (sum / f64::from(count) - 1.0).powi(2)
            })
            .sum();
        let error = (square / seeds as f64).sqrt();
        assert!(error < 0.01 * independent, "{error:e} against {independent:e}");
    }

    #[test]
    fn scramblings_are_uniform_and_differ() {
        // A single point over many seeds is uniform: mean ½, variance 1/12.
        let seeds = 20_000;
        let values: Vec<f64> = (0..seeds)
            .map(|seed| SobolSequence::scrambled(3, seed).unwrap().point(1)[2])
            .collect();
        let mean = values.iter().sum::<f64>() / seeds as f64;
        let variance = values.iter().map(|u| (u - mean) * (u - mean)).sum::<f64>() / seeds as f64;
        assert!((mean - 0.5).abs() < 4.0 / (12.0 * seeds as f64).sqrt());
        assert!((variance - 1.0 / 12.0).abs() < 0.003);
        assert_ne!(
            SobolSequence::scrambled(3, 1).unwrap().point(9),
            SobolSequence::scrambled(3, 2).unwrap().point(9)
        );
        assert_eq!(
            SobolSequence::scrambled(3, 1).unwrap().point(9),
            SobolSequence::scrambled(3, 1).unwrap().point(9)
        );
    }

    #[test]
    fn scrambled_fractions_share_as_many_bits_as_they_did_and_are_independent_below() {
        let seeds = 2000;
        for shared in 0..NESTED_LEVELS {
            let (one, other) = (0x9D3C_5A17_E248_B06F_u64, 0x9D3C_5A17_E248_B06F ^ (1 << (63 - shared)));
            let next_differs = |seed: u64| {
                let [one, other] = [one, other].map(|bits| scrambled_bits(bits, mixed(seed)));
                assert_eq!((one ^ other).leading_zeros(), shared);
                (one ^ other) >> (62 - shared) & 1 == 1
            };
            let count = (0..seeds).filter(|&seed| next_differs(seed)).count();
            assert!(count.abs_diff(1000) < 100, "{shared}: {count} of {seeds}");
        }
    }

    #[test]
    fn refuses_other_dimensions() {
        assert!(SobolSequence::plain(0).is_err());
        assert!(SobolSequence::scrambled(SOBOL_MAXIMUM_DIMENSION + 1, 0).is_err());
    }
}
