//! Sample points and weights that sum as all points do.

use mpm_dense::DenseMatrix;
use mpm_scenes::Kinematics;
use mpm_tensor::vector;

use super::design::UNFORESEEN;
use super::samples::{ON_EACH_REGION, groups};
use super::scaled_reading::ScaledReading;
use super::{KnownPoints, OnlineError, Reading};
use crate::least_squares::NonNegative;

/// Points of each group that are looked at, at most: storage and work grow with the square of their number.
const MOST_CANDIDATES: usize = 2048;

/// Readings whose rows are multiplied at a time.
const AT_A_TIME: usize = 16;

/// At most `count` sample points with weights ω_p, ascending: an empirical cubature (J. A. Hernández, M. A. Caicedo, A. Ferrer 2017, doi 10.1016/j.cma.2016.10.022) of the sums that make v̂.
///
/// A [`Reading`] has the velocities v_p of all N points that readings know after a step from the state s, and J_p = ∂g/∂x̂(X_p, x̂). With e_p = v_p − J_p v̂, v̂ that of all points together, Σ_p J_pᵀ e_p = 0. Sample points with weights
/// make the same v̂ where Σ_{p ∈ 𝒫} ω_p J_pᵀ e_p = 0, too. The weights are those that make
///
/// Σ_s |Σ_p ω_p J_pᵀ e_p|² / e² + β |Σ_p ω_p J_pᵀ J_p − N I|² + σ² Σ_p ω_p² |J_p|²
///
/// small, ω_p ≥ 0, coordinates being scaled so that Σ_p J_pᵀ J_p = N I over all points and e² being the mean square of the components of e_p in the state: far from the training, where errors are large, the sums have to
/// be as good as near it, no better. σ = 0.3 is the part of e_p that readings do not foretell, as in [`choose_greedily`](super::choose_greedily); β = D r / count is the square of what a few points with the same
/// weights would get wrong. Points come one after another, the one with the steepest descent first, and leave when their weight is no longer positive (Lawson & Hanson 1974, chapter 23). They are fewer than `count`
/// where no further one lowers the sum.
///
/// 𝒫 has five points or more of each kinematic region, as with [`SampleChoice::Drawn`](super::SampleChoice::Drawn); those without use have the weight 0.
/// Points that readings do not know are only among them where a region has too few others.
///
/// # Errors
/// [`OnlineError::TooFewSamples`], [`OnlineError::TooManySamples`], [`OnlineError::Readings`].
pub fn choose_cubature<const D: usize>(
    readings: &[Reading<D>],
    coordinates: usize,
    kinematics: &Kinematics<D>,
    known: &KnownPoints,
    count: usize,
) -> Result<Vec<(u32, f64)>, OnlineError> {
    let groups = groups(kinematics, known.points_of_body(), coordinates, count)?;
    let mut candidates: Vec<u32> = groups.iter().flat_map(|(members, _)| thinned(known, members)).collect();
    candidates.sort_unstable();
    candidates.dedup();
    let scaled = ScaledReading::all(coordinates, known.numbers().len(), readings)?;
    let mut problem = problem(&scaled, coordinates, known, &candidates, count);
    // Points leave, too; the sum falls every time, and an end is set only against rounding.
    for _ in 0..10 * count {
        let chosen = numbers(&problem, &candidates);
        let full = chosen.len() + unused(kinematics, known, &chosen).len() >= count;
        if full || !problem.raise_one() {
            break;
        }
    }
    let positive = problem.positive.iter();
    let mut weighted: Vec<_> = positive.map(|&k| (candidates[k], problem.weights[k])).collect();
    let unused = unused(kinematics, known, &numbers(&problem, &candidates));
    weighted.extend(unused.into_iter().map(|point| (point, 0.0)));
    weighted.sort_unstable_by_key(|(point, _)| *point);
    Ok(weighted)
}

/// The points with positive weights.
fn numbers(problem: &NonNegative, candidates: &[u32]) -> Vec<u32> {
    problem.positive.iter().map(|&k| candidates[k]).collect()
}

/// At most `MOST_CANDIDATES` of these points, evenly spaced in the list of those that readings know.
fn thinned(known: &KnownPoints, members: &[u32]) -> Vec<u32> {
    let members: Vec<u32> = members
        .iter()
        .copied()
        .filter(|&point| known.place(point).is_some())
        .collect();
    let count = members.len().min(MOST_CANDIDATES);
    (0..count).map(|k| members[k * members.len() / count]).collect()
}

/// Points of kinematic regions that must be in 𝒫, too, beside the chosen ones: known ones first.
fn unused<const D: usize>(kinematics: &Kinematics<D>, known: &KnownPoints, chosen: &[u32]) -> Vec<u32> {
    let (mut others, mut sorted) = (Vec::new(), chosen.to_vec());
    sorted.sort_unstable();
    for region in kinematics.regions() {
        let members = region.members.iter().map(|&p| p as u32);
        let (found, mut free): (Vec<u32>, Vec<u32>) = members.partition(|p| sorted.binary_search(p).is_ok());
        free.sort_by_key(|point| known.place(*point).is_none());
        let needed = region.members.len().min(ON_EACH_REGION);
        others.extend(free.into_iter().take(needed.saturating_sub(found.len())));
    }
    others
}

/// Half the sum, for these points, as ½ ωᵀ Q ω − qᵀ ω.
fn problem<const D: usize>(
    readings: &[ScaledReading<D>],
    r: usize,
    known: &KnownPoints,
    candidates: &[u32],
    count: usize,
) -> NonNegative {
    let points = known.numbers().len();
    let places: Vec<usize> = candidates.iter().filter_map(|&point| known.place(point)).collect();
    let balance = (D * r) as f64 / count as f64;
    let products = r * (r + 1) / 2;
    let mut matrix = DenseMatrix::zeros(candidates.len(), candidates.len());
    let mut squares = vec![0.0; candidates.len()];
    for part in readings.chunks(AT_A_TIME) {
        let mut rows = DenseMatrix::zeros(part.len() * (r + products), candidates.len());
        for (first, reading) in part
            .iter()
            .enumerate()
            .map(|(s, reading)| (s * (r + products), reading))
        {
            for (k, &point) in places.iter().enumerate() {
                let columns = &reading.columns[point * r..(point + 1) * r];
                let mut row = first + r;
                for (i, column) in columns.iter().enumerate() {
                    rows[(first + i, k)] = vector::dot(column, &reading.errors[point]) / reading.mean_square.sqrt();
                    squares[k] += vector::norm_squared(column);
                    for (j, other) in columns.iter().enumerate().take(i + 1) {
                        let twice = if i == j { 1.0 } else { 2.0 };
                        rows[(row, k)] = (twice * balance).sqrt() * vector::dot(column, other);
                        row += 1;
                    }
                }
            }
        }
        // On one thread: sums in another order would be other bits, and perhaps other points.
        matrix.add_square_of(&rows);
    }
    let right = squares.iter().map(|square| balance * points as f64 * square).collect();
    for (k, square) in squares.iter().enumerate() {
        matrix[(k, k)] += UNFORESEEN * UNFORESEEN * square;
    }
    NonNegative::new(matrix, right)
}

#[cfg(test)]
mod tests {
    use super::super::scaled_reading::tests::reading;
    use super::*;

    const POINTS: usize = 60;

    /// The sum of the description, as it stands there.
    fn sum(readings: &[Reading<2>], weighted: &[(u32, f64)], count: usize) -> f64 {
        let scaled = ScaledReading::all(3, POINTS, readings).expect("of these points");
        let (beta, sigma_squared) = (6.0 / count as f64, 0.09);
        let mut sum = 0.0;
        for state in &scaled {
            let column = |p: u32, k: usize| &state.columns[3 * p as usize + k];
            for i in 0..3 {
                let force = weighted
                    .iter()
                    .map(|&(p, w)| w * vector::dot(column(p, i), &state.errors[p as usize]));
                sum += force.sum::<f64>().powi(2) / state.mean_square;
                for j in 0..3 {
                    let product: f64 = weighted
                        .iter()
                        .map(|&(p, w)| w * vector::dot(column(p, i), column(p, j)))
                        .sum();
                    sum += beta * (product - if i == j { POINTS as f64 } else { 0.0 }).powi(2);
                }
                let squares = weighted
                    .iter()
                    .map(|&(p, w)| w * w * vector::norm_squared(column(p, i)));
                sum += sigma_squared * squares.sum::<f64>();
            }
        }
        sum
    }

    #[test]
    fn the_weights_make_the_sum_least() {
        let readings = [
            reading(POINTS, 3, 0.37),
            reading(POINTS, 3, 0.61),
            reading(POINTS, 3, 0.83),
        ];
        let chosen =
            choose_cubature(&readings, 3, &Kinematics::default(), &KnownPoints::all(POINTS), 20).expect("enough");
        assert!(
            chosen.len() <= 20 && chosen.windows(2).all(|pair| pair[0].0 < pair[1].0),
            "{chosen:?}"
        );
        let least = sum(&readings, &chosen, 20);
        for k in 0..chosen.len() {
            for factor in [0.99, 1.01] {
                let mut other = chosen.clone();
                other[k].1 *= factor;
                assert!(sum(&readings, &other, 20) > least, "{k}: {factor}");
            }
        }
        let alike: Vec<_> = (0..20).map(|k| (3 * k, 3.0)).collect();
        assert!(
            least < 0.2 * sum(&readings, &alike, 20),
            "{least} of {}",
            sum(&readings, &alike, 20)
        );
    }

    #[test]
    fn more_points_are_better_and_all_of_them_count_one_each() {
        let readings = [reading(POINTS, 3, 0.37), reading(POINTS, 3, 0.61)];
        let of = |count| {
            let chosen = choose_cubature(&readings, 3, &Kinematics::default(), &KnownPoints::all(POINTS), count)
                .expect("enough");
            (sum(&readings, &chosen, 20), chosen)
        };
        let sums = [5, 10, 20, 40].map(|count| of(count).0);
        assert!(sums.windows(2).all(|pair| pair[1] < pair[0]), "{sums:?}");
        let all = of(POINTS).1;
        let mean = all.iter().map(|(_, weight)| weight).sum::<f64>() / POINTS as f64;
        assert!(all.len() > 45 && (mean - 1.0).abs() < 0.1, "{} {mean}", all.len());
    }

    #[test]
    fn readings_of_another_body_or_none_are_refused() {
        let all = KnownPoints::all(POINTS);
        let of = |readings: &[Reading<2>], count| choose_cubature(readings, 3, &Kinematics::default(), &all, count);
        assert!(matches!(of(&[], 20), Err(OnlineError::Readings { readings: 0, .. })));
        let another = of(&[reading(40, 3, 0.4)], 20);
        assert!(matches!(
            another,
            Err(OnlineError::Readings {
                readings: 1,
                points: POINTS
            })
        ));
        assert!(matches!(of(&[], 1), Err(OnlineError::TooFewSamples { .. })));
    }
}
