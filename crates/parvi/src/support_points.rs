//! Support points: the few points with the least energy distance to a big sample.

use mpm_tensor::{power_of_two, vector};

use crate::PointSetError;
use crate::point_set_error::check_finite;

/// Terms that are summed side by side; part of the order of summation.
const LANES: usize = 4;

/// What [`support_points`] gives.
#[derive(Clone, Debug, PartialEq)]
pub struct SupportPoints<const D: usize> {
    /// The points, in the order of the start.
    pub positions: Vec<[f64; D]>,
    /// Iterations taken.
    pub iterations: usize,
    /// The largest distance that a point moved in the last iteration, in units of the sample's spread.
    pub displacement: f64,
}

/// Move points from `start` to where their energy distance to the equally weighted `sample` y_1 … y_N,
///
/// ED² = 2/(MN) Σ_im |x_i − y_m| − M⁻² Σ_ij |x_i − x_j| − N⁻² Σ_lm |y_l − y_m|,
///
/// has a local minimum, by the convex–concave procedure: the convex first term is replaced by the quadratic that touches it from above at
/// the present points, the concave second one by its tangent, and the minimum of both together is
///
/// x_i ← (Σ_m 1/|x_i − y_m|)⁻¹ ( Σ_m y_m/|x_i − y_m| + N/M Σ_{j≠i} (x_i − x_j)/|x_i − x_j| ),
///
/// all points at once. No iteration makes ED² larger. Distances below spread / N count as spread / N in the quotients (that is: |r| there is
/// a parabola), so a start on points of the sample is allowed; the spread is the root of the mean squared distance to the sample's mean. Ends after
/// `iterations`, or after one in which no point moved farther than `tolerance` times the spread.
///
/// O(M (M + N) D) per iteration, in parallel; the same bits on any number of threads.
///
/// Source: S. Mak, V. R. Joseph, *Support points*, Ann. Stat. 46, 2018, §4.1, algorithm `sp.ccp`, Eq. (22).
///
/// # Errors
/// [`PointSetError`]: an empty sample or start, numbers that are not finite, a tolerance that is negative or NaN.
pub fn support_points<const D: usize>(
    sample: &[[f64; D]],
    start: &[[f64; D]],
    iterations: usize,
    tolerance: f64,
) -> Result<SupportPoints<D>, PointSetError> {
    check_finite("sample point", sample)?;
    check_start(start)?;
    check_tolerance(tolerance)?;
    // In units of a power of two, which rounds nothing: squares of small coordinates vanish.
    let coordinates = sample.iter().chain(start).flatten();
    let unit = power_of_two(coordinates.fold(0.0, |largest, c| c.abs().max(largest)));
    let in_units = |points: &[[f64; D]]| points.iter().map(|x| x.map(|c| c / unit)).collect::<Vec<_>>();
    let procedure = ConvexConcave::new(&in_units(sample))?;
    let mut positions = in_units(start);
    let (mut taken, mut displacement) = (0, f64::INFINITY);
    while taken < iterations && displacement > tolerance {
        displacement = procedure.iterate(&mut positions);
        taken += 1;
    }
    Ok(SupportPoints {
        positions: positions.iter().map(|x| x.map(|c| c * unit)).collect(),
        iterations: taken,
        displacement,
    })
}

/// The tolerance, if it is one.
pub(crate) fn check_tolerance(tolerance: f64) -> Result<(), PointSetError> {
    if tolerance >= 0.0 && tolerance.is_finite() {
        Ok(())
    } else {
        Err(PointSetError::Tolerance { value: tolerance })
    }
}

/// Whether points can begin there.
fn check_start<const D: usize>(start: &[[f64; D]]) -> Result<(), PointSetError> {
    if start.is_empty() {
        return Err(PointSetError::Empty { field: "the start" });
    }
    check_finite("start", start)
}

/// The convex–concave procedure against one sample.
pub(crate) struct ConvexConcave<const D: usize> {
    /// The sample, `LANES` points at a time: `groups[g][axis][lane]`.
    groups: Vec<[[f64; LANES]; D]>,
    /// The points that do not fill a group.
    rest: Vec<[f64; D]>,
    count: f64,
    spread: f64,
    /// Distances below this count as this.
    least_distance: f64,
}

impl<const D: usize> ConvexConcave<D> {
    /// Prepare a sample.
    pub fn new(sample: &[[f64; D]]) -> Result<Self, PointSetError> {
        if sample.is_empty() {
            return Err(PointSetError::Empty { field: "the sample" });
        }
        check_finite("sample point", sample)?;
        let count = sample.len() as f64;
        let mut mean = [0.0; D];
        for y in sample {
            vector::accumulate(&mut mean, 1.0 / count, y);
        }
        let square: f64 = sample.iter().map(|y| vector::distance_squared(y, &mean)).sum();
        // A sample of equal points has no spread, and every scale will do.
        let spread = Some((square / count).sqrt())
            .filter(|spread| *spread > 0.0)
            .unwrap_or(1.0);
        let (groups, rest) = sample.as_chunks::<LANES>();
        let transposed = |group: &[[f64; D]; LANES]| std::array::from_fn(|axis| group.map(|y| y[axis]));
        Ok(Self {
            groups: groups.iter().map(transposed).collect(),
            rest: rest.to_vec(),
            count,
            spread,
            least_distance: (spread / count).max(f64::MIN_POSITIVE),
        })
    }

    /// Move all points once; returns the largest distance moved, in units of the spread.
    pub fn iterate(&self, positions: &mut Vec<[f64; D]>) -> f64 {
        let moved = mpm_parallel::collect(positions.len(), 1, &|p| self.moved(&positions[p], positions));
        let distances = positions.iter().zip(&moved).map(|(x, y)| vector::distance(x, y));
        let largest = distances.fold(0.0, f64::max);
        *positions = moved;
        largest / self.spread
    }

    /// x + (Σ_m w_m)⁻¹ ( Σ_m w_m (y_m − x) + N/M Σ_j (x − x_j)/|x − x_j| ), w_m = 1/|x − y_m|.
    fn moved(&self, x: &[f64; D], positions: &[[f64; D]]) -> [f64; D] {
        let (weight, mut pull) = self.attraction(x);
        let push = repulsion(x, positions);
        vector::accumulate(&mut pull, self.count / positions.len() as f64, &push);
        vector::add_scaled(x, 1.0 / weight, &pull)
    }

    /// (Σ_m w_m, Σ_m w_m (y_m − x)).
    fn attraction(&self, x: &[f64; D]) -> (f64, [f64; D]) {
        let (mut weights, mut pulls) = ([0.0; LANES], [[0.0; LANES]; D]);
        for group in &self.groups {
            let (mut squares, mut apart) = ([0.0; LANES], [[0.0; LANES]; D]);
            for axis in 0..D {
                for lane in 0..LANES {
                    apart[axis][lane] = group[axis][lane] - x[axis];
                    squares[lane] += apart[axis][lane] * apart[axis][lane];
                }
            }
            let mut inverse = [0.0; LANES];
            for lane in 0..LANES {
                inverse[lane] = 1.0 / squares[lane].sqrt().max(self.least_distance);
                weights[lane] += inverse[lane];
            }
            for axis in 0..D {
                for lane in 0..LANES {
                    pulls[axis][lane] += inverse[lane] * apart[axis][lane];
                }
            }
        }
        let mut weight: f64 = weights.iter().sum();
        let mut pull = pulls.map(|lanes| lanes.iter().sum());
        for y in &self.rest {
            let apart = vector::subtract(y, x);
            let inverse = 1.0 / vector::norm(&apart).max(self.least_distance);
            weight += inverse;
            vector::accumulate(&mut pull, inverse, &apart);
        }
        (weight, pull)
    }
}

/// Σ_j (x − x_j)/|x − x_j| over the points that are not at x.
fn repulsion<const D: usize>(x: &[f64; D], positions: &[[f64; D]]) -> [f64; D] {
    let mut sum = [0.0; D];
    for other in positions {
        let apart = vector::subtract(x, other);
        let distance = vector::norm(&apart);
        if distance > 0.0 {
            vector::accumulate(&mut sum, 1.0 / distance, &apart);
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_iteration_is_the_paper_s_formula() {
        let sample: Vec<[f64; 3]> = (0..11)
            .map(|m| [1.0, 2.0, 3.0].map(|rate: f64| (rate * f64::from(m) + 0.3).sin()))
            .collect();
        let start = [[0.1, 0.2, 0.3], [-0.5, 0.4, 0.0], [0.9, -0.9, 0.2], [0.1, 0.2, 0.3]];
        let (count, points) = (sample.len() as f64, start.len() as f64);
        let result = support_points(&sample, &start, 1, 0.0).expect("points");
        for (i, x) in start.iter().enumerate() {
            let mut weight = 0.0;
            let mut sum = [0.0; 3];
            for y in &sample {
                let inverse = 1.0 / vector::distance(x, y);
                weight += inverse;
                vector::accumulate(&mut sum, inverse, y);
            }
            for other in start.iter().filter(|other| *other != x) {
                let apart = vector::subtract(x, other);
                vector::accumulate(&mut sum, count / points / vector::norm(&apart), &apart);
            }
            let expected = vector::scale(&sum, 1.0 / weight);
            assert!(vector::distance(&result.positions[i], &expected) < 1e-13, "point {i}");
        }
        assert_eq!(result.iterations, 1);
    }

    #[test]
    fn one_point_goes_to_the_geometric_median() {
        // Of the corners of a triangle that is narrow enough the median is the Fermat point: unit pulls add to zero.
        let sample = [[0.0, 0.0], [1.0, 0.0], [0.4, 0.9]];
        let result = support_points(&sample, &[[5.0, 5.0]], 500, 1e-14).expect("a point");
        let x = result.positions[0];
        let mut pull = [0.0; 2];
        for y in &sample {
            let apart = vector::subtract(y, &x);
            vector::accumulate(&mut pull, 1.0 / vector::norm(&apart), &apart);
        }
        assert!(vector::norm(&pull) < 1e-10, "{pull:?} at {x:?}");
        assert!(result.iterations < 500);
    }
}
