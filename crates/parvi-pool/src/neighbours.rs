//! Local covariances from the nearest points.

use mpm_tensor::{Matrix, vector};

use crate::lanes::{LANES, packed};
use crate::sample::{Sample, root};

/// Share of a local covariance that its mean variance takes.
const ROUND: f64 = 0.1;

/// For every centre the covariance about it of its nearest points, nearest in coordinates in which the sample's covariance is I, with a tenth of its mean
/// variance mixed in.
pub(super) fn local_covariances<const D: usize>(
    sample: &Sample<D>,
    centres: &[[f64; D]],
    count: usize,
) -> Vec<Matrix<D>> {
    let factor = root(&sample.moments().1);
    let whitener = factor.lower_triangular_inverse().unwrap_or(Matrix::IDENTITY);
    let white: Vec<[f64; D]> = sample.points.iter().map(|x| whitener.apply(x)).collect();
    let groups = packed(&white);
    let local = |centre: &[f64; D]| {
        let centre = whitener.apply(centre);
        let mut nearest = Vec::with_capacity(groups.len() * LANES);
        for (g, group) in groups.iter().enumerate() {
            let mut squares = [0.0; LANES];
            for axis in 0..D {
                for lane in 0..LANES {
                    let apart = group[axis][lane] - centre[axis];
                    squares[lane] += apart * apart;
                }
            }
            nearest.extend(
                squares
                    .iter()
                    .enumerate()
                    .map(|(lane, square)| (*square, g * LANES + lane)),
            );
        }
        nearest.truncate(white.len());
        if count < nearest.len() {
            nearest.select_nth_unstable_by(count, |a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            nearest.truncate(count);
        }
        // In the order of the points, so that sums do not depend on how the selection went.
        nearest.sort_unstable_by_key(|&(_, index)| index);
        let (mut total, mut covariance) = (f64::MIN_POSITIVE, Matrix::<D>::ZERO);
        for &(_, index) in &nearest {
            let apart = vector::subtract(&white[index], &centre);
            let weight = sample.weights[index];
            total += weight;
            for i in 0..D {
                vector::accumulate(&mut covariance.0[i], weight * apart[i], &apart);
            }
        }
        covariance *= 1.0 / total;
        let mean = covariance.trace() / D as f64;
        covariance *= 1.0 - ROUND;
        for i in 0..D {
            covariance.0[i][i] += ROUND * mean + 1e-12;
        }
        (factor * covariance * factor.transpose()).symmetric_part()
    };
    mpm_parallel::map(centres.iter(), &local)
}
