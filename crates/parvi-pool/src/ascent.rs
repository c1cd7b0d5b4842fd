//! A scout's way uphill: a Newton step, and then what the scores on the way teach of the curvature.

use mpm_tensor::{Matrix, SymmetricEigen, vector};

use crate::density::Density;
use crate::summit::Summit;

/// Step of the differences of scores, in units of the frame or of the distance from its centre.
const DIFFERENCE: f64 = 1e-5;

/// The way ends where a step would raise log p by less than this.
const REST: f64 = 0.02;

/// Widest standard deviation that a curvature may tell of, in units of the frame.
const WIDEST: f64 = 200.0;

/// Evaluations on the way, over D + 2, which a Newton step takes.
const STEPS: usize = 12;

/// Trial lengths of a step at most, and of one that has brought enough already.
const TRIALS: usize = 12;
const TRIALS_FOR_MORE: usize = 6;

/// The next trial is so many times as long where log p still rises steeply, and where it has fallen: twice, and then.
const LONGER: f64 = 3.0;
const SHORTER: f64 = 0.3;
const FAR_SHORTER: f64 = 0.1;

/// Share of the predicted rise that a step has to bring, and share of the slope along it that it may leave.
const SUFFICIENT_RISE: f64 = 1e-4;
const SLOPE_LEFT: f64 = 0.9;

/// The curvature at the beginning is of no use where the first step shows so many times as much.
const MISJUDGED: f64 = 100.0;

/// From `start` uphill by quasi-Newton steps x ← x + t B s, s the score: B is |H|⁻¹ at first, H = −∇² log p from differences of scores, and is then updated by BFGS,
/// one score and a density or two a step, until no step would raise log p. There the curvature is taken anew; the way goes on if it says that there is more.
///
/// Y. Dauphin et al., *Identifying and attacking the saddle point problem*, NIPS 2014, for |H|; J. Nocedal, S. J. Wright, *Numerical Optimization*, 2nd ed., Eqs. 6.17 and 6.20; A. S. Lewis,
/// M. L. Overton, *Nonsmooth optimization via quasi-Newton methods*, Math. Program. 141, 2013: with lengths t that leave no steep slope, kinks are climbed like ridges. `None` where the start
/// has no density or is flat, and where the way meets a place that is known.
pub(super) fn ascend<const D: usize>(
    density: &mut Density<'_, D>,
    start: &[f64; D],
    is_known: impl Fn(&[f64; D], f64) -> bool,
) -> Option<Summit<D>> {
    let log_density = density.log_densities(&[*start])[0];
    if !log_density.is_finite() {
        return None;
    }
    let until = density.evaluations() + (STEPS * (D + 2)) as u64;
    let mut place = Place {
        point: *start,
        log_density,
        score: [0.0; D],
    };
    // Before anything is known of the curvature.
    let mut metric = Matrix::IDENTITY * (WIDEST * WIDEST);
    let mut summit = None;
    loop {
        let length = DIFFERENCE * vector::maximum_norm(&place.point).max(1.0);
        let (score, curvature) = local(density, &place.point, &Matrix::IDENTITY, length);
        place.score = score;
        if let Some(here) = Summit::new(place.point, place.log_density, &curvature, WIDEST) {
            (metric, summit) = (here.covariance, Some(here));
        } else if curvature != Matrix::ZERO {
            return summit;
        }
        let mut moved = false;
        while density.evaluations() < until {
            let Some(next) = place.next(density, &metric) else {
                break;
            };
            if is_known(&next.point, next.log_density) {
                return None;
            }
            metric = taught(metric, &place, &next, !moved);
            (place, moved) = (next, true);
        }
        if !moved {
            return summit;
        }
        // Where the density is flat but for kinks, what the way has taught stands for the curvature.
        let learned = SymmetricEigen::new(&metric).map(|eigen| eigen.map(f64::recip));
        summit = learned.and_then(|learned| Summit::new(place.point, place.log_density, &learned, WIDEST));
    }
}

/// A place on the way.
struct Place<const D: usize> {
    point: [f64; D],
    log_density: f64,
    score: [f64; D],
}

impl<const D: usize> Place<D> {
    /// Where a step of this metric leads; `None` where none would raise log p by enough.
    fn next(&self, density: &mut Density<'_, D>, metric: &Matrix<D>) -> Option<Self> {
        let step = metric.apply(&self.score);
        // As far as to the centre of the frame, or by its width: farther on there are other pieces.
        let longest = vector::norm(&self.point).max(1.0);
        let step = vector::scale(&step, (longest / vector::norm(&step).max(f64::MIN_POSITIVE)).min(1.0));
        let rise = vector::dot(&step, &self.score);
        if rise.is_nan() || rise < 2.0 * REST {
            return None;
        }
        let (mut least, mut most, mut length) = (0.0, f64::INFINITY, 1.0);
        let mut reached = None;
        for trial in 1..=TRIALS {
            let point = vector::add_scaled(&self.point, length, &step);
            let log_density = density.log_densities(&[point])[0];
            if log_density >= self.log_density + SUFFICIENT_RISE * length * rise {
                let score = density.scores(&[point])[0];
                let slope = vector::dot(&score, &step);
                reached = Some(Self {
                    point,
                    log_density,
                    score,
                });
                if slope <= SLOPE_LEFT * rise {
                    break;
                }
                least = length;
            } else {
                most = length;
            }
            if reached.is_some() && trial >= TRIALS_FOR_MORE {
                break;
            }
            length = match (least > 0.0, most.is_finite()) {
                (_, false) => LONGER * length,
                (true, true) => 0.5 * (least + most),
                (false, true) if trial <= 2 => SHORTER * length,
                (false, true) => FAR_SHORTER * length,
            };
        }
        reached
    }
}

/// The metric that also knows how the score changed between two places.
fn taught<const D: usize>(mut metric: Matrix<D>, from: &Place<D>, to: &Place<D>, is_first: bool) -> Matrix<D> {
    let moved = vector::subtract(&to.point, &from.point);
    let change = vector::subtract(&from.score, &to.score);
    let along = vector::dot(&moved, &change);
    if along.is_nan() || along <= 0.0 {
        return metric;
    }
    if is_first && vector::dot(&change, &metric.apply(&change)) > MISJUDGED * along {
        metric = Matrix::IDENTITY * (along / vector::norm_squared(&change));
    }
    let turned = metric.apply(&change);
    let twice = Matrix::outer(&turned, &moved) + Matrix::outer(&moved, &turned);
    let more = Matrix::outer(&moved, &moved) * ((along + vector::dot(&change, &turned)) / (along * along));
    metric + more + twice * (-1.0 / along)
}

/// The score, and −∇² log p from differences of scores over `length` along the axes, in the coordinates z of x = `factor` z.
pub(super) fn local<const D: usize>(
    density: &mut Density<'_, D>,
    z: &[f64; D],
    factor: &Matrix<D>,
    length: f64,
) -> ([f64; D], Matrix<D>) {
    let mut places = vec![*z; D + 1];
    for axis in 0..D {
        places[axis + 1][axis] += length;
    }
    let places: Vec<[f64; D]> = places.iter().map(|z| factor.apply(z)).collect();
    let scores = density.scores(&places);
    let scores: Vec<[f64; D]> = scores.iter().map(|score| factor.transpose().apply(score)).collect();
    let curvature = Matrix::from_fn(|row, axis| (scores[0][row] - scores[axis + 1][row]) / length);
    (scores[0], curvature.symmetric_part())
}

#[cfg(test)]
mod tests {
    use parvi_targets::{Banana, Frame, Gaussian, Target};

    use super::*;

    #[test]
    fn a_stretched_gaussian_takes_two_steps() {
        let covariance = Matrix([[1e4, 30.0, 0.0], [30.0, 1.0, 5e-4], [0.0, 5e-4, 1e-4]]);
        let target = Gaussian::new([10.0, 2.0, 3.0], covariance).unwrap();
        let frame = Frame::identity();
        let mut density = Density::of(&target, &frame);
        let summit = ascend(&mut density, &[-10.0, -10.0, 10.0], |_, _| false).unwrap();
        assert!(
            target.log_density(&[10.0, 2.0, 3.0]) - summit.log_density < REST,
            "{summit:?}"
        );
        assert!(density.evaluations() <= 16, "{}", density.evaluations());
        for axis in 0..3 {
            assert!((summit.covariance.0[axis][axis] / covariance.0[axis][axis] - 1.0).abs() < 1e-3);
        }
    }

    #[test]
    fn a_bent_ridge_is_climbed() {
        let target = Banana::new(1.0, 0.5).unwrap();
        let frame = Frame::identity();
        for start in [[5.0, 5.0], [-3.0, 0.0], [0.0, 20.0]] {
            let summit = ascend(&mut Density::of(&target, &frame), &start, |_, _| false).unwrap();
            assert!(
                summit.log_density > target.log_density(&[0.0, -1.0]) - 1.0,
                "{start:?}: {summit:?}"
            );
        }
    }

    /// A product of Laplace laws, rotated: flat but for its kinks, so that no curvature says how far to go.
    #[test]
    fn kinks_are_climbed() {
        struct Kinked;
        const AXES: Matrix<3> = Matrix([[0.6, -0.8, 0.0], [0.48, 0.36, -0.8], [0.64, 0.48, 0.6]]);
        const WIDTHS: [f64; 3] = [0.01, 0.1, 1.0];
        impl Target<3> for Kinked {
            fn log_density(&self, x: &[f64; 3]) -> f64 {
                let y = AXES.apply(x);
                -y.iter().zip(WIDTHS).map(|(y, width)| y.abs() / width).sum::<f64>()
            }
            fn score(&self, x: &[f64; 3]) -> [f64; 3] {
                let y = AXES.apply(x);
                AXES.transpose()
                    .apply(&std::array::from_fn(|a| -y[a].signum() / WIDTHS[a]))
            }
        }
        let frame = Frame::identity();
        let mut arrived = 0;
        for n in 0..40 {
            let start = [0.7, 1.3, 2.9].map(|rate| 9.0 * (rate * f64::from(n) + 0.2).sin());
            let summit = ascend(&mut Density::of(&Kinked, &frame), &start, |_, _| false);
            arrived += u32::from(summit.is_some_and(|summit| summit.log_density > -20.0));
        }
        assert!(arrived >= 36, "{arrived} of 40");
    }

    #[test]
    fn a_start_without_a_density_is_no_start() {
        let target = Gaussian::<1>::standard();
        let frame = Frame::identity();
        assert!(ascend(&mut Density::of(&target, &frame), &[f64::NAN], |_, _| { false }).is_none());
    }

    #[test]
    fn a_way_that_meets_what_is_known_ends_there() {
        let target = Gaussian::<2>::standard();
        let frame = Frame::identity();
        let mut density = Density::of(&target, &frame);
        assert!(ascend(&mut density, &[3.0, 4.0], |_, _| true).is_none());
        let summit = ascend(&mut density, &[3.0, 4.0], |_, _| false).unwrap();
        assert!(summit.log_mass().abs() < 1e-6, "{summit:?}");
        let narrow = summit.no_wider_than(0.5).unwrap();
        assert!((narrow.covariance.0[0][0] - 0.25).abs() < 1e-12 && (narrow.log_mass() - 0.25_f64.ln()).abs() < 1e-6);
    }
}
