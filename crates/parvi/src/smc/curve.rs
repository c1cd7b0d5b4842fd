//! Systematic resampling along a Hilbert curve.

use parvi_targets::Frame;

/// `count` indices by systematic resampling in the order of a Hilbert curve through the points, in coordinates that whiten them and a logistic map to the unit cube: index i appears
/// ⌊count w_i⌋ or ⌈count w_i⌉ times. `weights` sum to one, `offset` is in [0, 1).
///
/// Points that follow each other on the curve are neighbours, so that every region gets its share up to one (Gerber, Chopin, Whiteley 2019).
pub(super) fn resampled<const D: usize>(points: &[[f64; D]], weights: &[f64], count: usize, offset: f64) -> Vec<usize> {
    let frame = Frame::of_points(points, Some(weights)).unwrap_or_else(|_| Frame::identity());
    let key = |point: &[f64; D]| key(&frame.to_reference(point).map(|c| 1.0 / (1.0 + (-c).exp())));
    let keys: Vec<u128> = points.iter().map(key).collect();
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by_key(|&i| (keys[i], i));
    let mut chosen = Vec::with_capacity(count);
    let (mut place, mut below) = (0, 0.0);
    for seat in 0..count {
        let level = (seat as f64 + offset) / count as f64;
        while place + 1 < order.len() && below + weights[order[place]] <= level {
            below += weights[order[place]];
            place += 1;
        }
        chosen.push(order[place]);
    }
    chosen
}

/// Where a point of the unit cube is on the Hilbert curve.
fn key<const D: usize>(point: &[f64; D]) -> u128 {
    let bits = (u128::BITS / D.max(1) as u32).clamp(1, 16);
    let cells = f64::from(1u32 << bits);
    place(point.map(|c| (c * cells).clamp(0.0, cells - 1.0) as u32), bits)
}

/// The number of a cell along the Hilbert curve through (2^bits)ᴰ cells: J. Skilling, *Programming the Hilbert curve*, AIP Conf. Proc. 707 (2004), AxestoTranspose.
fn place<const D: usize>(cell: [u32; D], bits: u32) -> u128 {
    let mut x = cell;
    for shift in (1..bits).rev() {
        let (bit, below) = (1u32 << shift, (1u32 << shift) - 1);
        for axis in 0..D {
            if x[axis] & bit == 0 {
                let swapped = (x[0] ^ x[axis]) & below;
                x[0] ^= swapped;
                x[axis] ^= swapped;
            } else {
                x[0] ^= below;
            }
        }
    }
    for axis in 1..D {
        x[axis] ^= x[axis - 1];
    }
    let last = x[D - 1];
    let flipped = (1..bits)
        .filter(|shift| last & (1 << shift) != 0)
        .fold(0u32, |flipped, shift| flipped ^ ((1 << shift) - 1));
    let mut number = 0;
    for shift in (0..bits).rev() {
        for c in &x {
            number = number << 1 | u128::from((c ^ flipped) >> shift & 1);
        }
    }
    number
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_goes_from_neighbour_to_neighbour_through_every_cell() {
        let mut cells: Vec<[u32; 3]> = (0..512).map(|k| [k & 7, k >> 3 & 7, k >> 6]).collect();
        cells.sort_by_key(|&cell| place(cell, 3));
        for (k, pair) in cells.windows(2).enumerate() {
            assert_eq!(place(pair[0], 3), k as u128);
            let apart: u32 = (0..3).map(|a| pair[0][a].abs_diff(pair[1][a])).sum();
            assert_eq!(apart, 1, "{pair:?}");
        }
        assert_eq!(
            (0..8).map(|k| place([k], 3)).collect::<Vec<_>>(),
            (0..8).collect::<Vec<_>>()
        );
    }

    #[test]
    fn every_point_has_its_share_up_to_one() {
        let points: Vec<[f64; 2]> = (0..50)
            .map(|k| [f64::from(k * 7 % 50), f64::from(k * k % 13)])
            .collect();
        let total: f64 = (1..=50).map(f64::from).sum();
        let weights: Vec<f64> = (1..=50).map(|k| f64::from(k) / total).collect();
        let chosen = resampled(&points, &weights, 200, 0.3);
        assert_eq!(chosen.len(), 200);
        for (i, weight) in weights.iter().enumerate() {
            let times = chosen.iter().filter(|&&c| c == i).count() as f64;
            assert!((times - 200.0 * weight).abs() < 1.0, "{i}: {times}");
        }
    }
}
