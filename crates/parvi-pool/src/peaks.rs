//! Points that are higher than all about them.

use mpm_tensor::Matrix;

use crate::lanes::{Group, LANES, Lanes, packed};

/// Neighbours of a peak that are all lower: where a function rises evenly, all of so many are with probability 2⁻¹².
pub(super) const NEIGHBOURS: usize = 12;

/// Points that are compared with each other at most: the first ones.
const MOST: usize = 4096;

/// The points of which `is_wanted`, with how many of their nearest neighbours are all lower, nearest in coordinates in which `whitener` is applied; those with most
/// first.
///
/// How far the nearest higher point is tells centres of clusters apart: A. Rodriguez, A. Laio, *Clustering by fast search and find of density peaks*, Science 344, 2014.
pub(super) fn by_prominence<const D: usize>(
    points: &[[f64; D]],
    logs: &[f64],
    whitener: &Matrix<D>,
    is_wanted: impl Fn(usize) -> bool,
) -> Vec<(usize, usize)> {
    let count = points.len().min(MOST);
    let white: Vec<[f64; D]> = points[..count].iter().map(|x| whitener.apply(x)).collect();
    let wanted: Vec<usize> = (0..count).filter(|&i| logs[i].is_finite() && is_wanted(i)).collect();
    let groups = packed(&white);
    // What fills the last group up is no neighbour.
    let mut padded = logs[..count].to_vec();
    padded.resize(groups.len() * LANES, f64::NAN);
    let padded = padded.as_chunks().0;
    let lower = mpm_parallel::map(wanted.iter(), &|&index| {
        lower_neighbours(&groups, padded, &white[index], logs[index])
    });
    let mut ranked: Vec<(usize, usize)> = wanted.into_iter().zip(lower).collect();
    ranked.sort_unstable_by_key(|&(index, lower)| (std::cmp::Reverse(lower), index));
    ranked
}

/// How many points are nearer than the nearest higher one, but for the point itself.
fn lower_neighbours<const D: usize>(groups: &[Group<D>], logs: &[Lanes], point: &[f64; D], log: f64) -> usize {
    let squares: Vec<Lanes> = groups
        .iter()
        .map(|group| {
            let mut squares = [0.0; LANES];
            for axis in 0..D {
                for lane in 0..LANES {
                    let apart = group[axis][lane] - point[axis];
                    squares[lane] += apart * apart;
                }
            }
            squares
        })
        .collect();
    let mut reach = [f64::INFINITY; LANES];
    for (squares, logs) in squares.iter().zip(logs) {
        for lane in 0..LANES {
            let nearer = (logs[lane] > log) & (squares[lane] < reach[lane]);
            reach[lane] = if nearer { squares[lane] } else { reach[lane] };
        }
    }
    let reach = reach.into_iter().fold(f64::INFINITY, f64::min);
    let mut nearer = [0.0; LANES];
    for (squares, logs) in squares.iter().zip(logs) {
        for lane in 0..LANES {
            let counts = (squares[lane] < reach) & (logs[lane] <= log);
            nearer[lane] += if counts { 1.0 } else { 0.0 };
        }
    }
    // The point itself is one of them, unless its place is no number or a higher point's.
    (nearer.iter().sum::<f64>() as usize).saturating_sub(1)
}

#[cfg(test)]
mod tests {
    use mpm_tensor::vector;

    use super::*;

    fn peaks<const D: usize>(
        points: &[[f64; D]],
        logs: &[f64],
        whitener: &Matrix<D>,
        is_wanted: impl Fn(usize) -> bool,
    ) -> Vec<usize> {
        let ranked = by_prominence(points, logs, whitener, is_wanted);
        let peaks = ranked.into_iter().take_while(|(_, lower)| *lower >= NEIGHBOURS);
        peaks.map(|(index, _)| index).collect()
    }

    /// A narrow normal law far in the tail of a wide one.
    #[test]
    fn the_flank_of_a_far_piece_is_a_peak() {
        let points: Vec<[f64; 2]> = (0..2000)
            .map(|n| [(f64::from(n) * 0.754_877).fract(), (f64::from(n) * 0.569_840).fract()].map(|u| 40.0 * u - 20.0))
            .collect();
        let log = |x: &[f64; 2]| {
            let narrow = 4.0 - vector::distance_squared(x, &[12.0, 9.0]) / 0.02;
            narrow.max(-0.5 * vector::norm_squared(x))
        };
        let logs: Vec<f64> = points.iter().map(log).collect();
        let found = peaks(&points, &logs, &Matrix::IDENTITY, |_| true);
        assert_eq!(found.len(), 2, "{found:?}");
        for place in [[0.0, 0.0], [12.0, 9.0]] {
            assert!(
                found
                    .iter()
                    .any(|&index| vector::distance(&points[index], &place) < 1.0)
            );
        }
        let far = peaks(&points, &logs, &Matrix::IDENTITY, |index| logs[index] < -20.0);
        assert!(far.len() <= 1, "{far:?}");
    }

    #[test]
    fn places_that_are_no_numbers_or_fall_together_are_no_peaks() {
        let points: Vec<[f64; 1]> = (0..40).map(|n| [f64::from(n / 2)]).collect();
        let logs: Vec<f64> = (0..40).map(f64::from).collect();
        assert_eq!(peaks(&points, &logs, &Matrix::IDENTITY, |index| index < 39), []);
        assert_eq!(peaks(&points, &logs, &(Matrix::IDENTITY * f64::INFINITY), |_| true), []);
    }
}
