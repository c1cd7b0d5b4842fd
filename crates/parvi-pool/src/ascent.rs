//! A scout's way uphill, by Newton steps with differences of scores.

use mpm_tensor::{Matrix, vector};

use crate::density::Density;
use crate::summit::Summit;

/// Step of the differences of scores, in units of the frame or of the distance from its centre.
const DIFFERENCE: f64 = 1e-5;

/// The way ends where a step would raise log p by less than this.
const REST: f64 = 0.02;

/// Longest step in units of the frame.
const REACH: f64 = 200.0;

/// Steps at most, and trial lengths of a step: 1, 0.3, 0.09, …
const STEPS: usize = 12;
const TRIALS: u32 = 6;

/// Share of the predicted rise that a step has to bring.
const SUFFICIENT_RISE: f64 = 1e-4;

/// From `start` uphill: x ← x + t |H|⁻¹ s with the score s and H = −∇² log p, t the first of 1, 0.3, 0.09, … that raises log p sufficiently.
///
/// Y. Dauphin et al., *Identifying and attacking the saddle point problem*, NIPS 2014, for |H|; J. Nocedal, S. J. Wright, *Numerical Optimization*, 2nd ed., §3.1
/// for the lengths. D + 1 scores and a few densities a step. `None` where the start has no density or no curvature, and where the way meets a place that is known.
pub(super) fn ascend<const D: usize>(
    density: &mut Density<'_, D>,
    start: &[f64; D],
    is_known: impl Fn(&[f64; D], f64) -> bool,
) -> Option<Summit<D>> {
    let mut log_density = density.log_densities(&[*start])[0];
    if !log_density.is_finite() {
        return None;
    }
    let mut point = *start;
    let mut summit = None;
    for _ in 0..STEPS {
        let length = DIFFERENCE * vector::maximum_norm(&point).max(1.0);
        let (score, curvature) = local(density, &point, &Matrix::IDENTITY, length);
        let Some(here) = Summit::new(point, log_density, &curvature, REACH) else {
            break;
        };
        summit = Some(here);
        let step = here.covariance.apply(&score);
        let step = vector::scale(&step, (REACH / vector::norm(&step).max(f64::MIN_POSITIVE)).min(1.0));
        let rise = vector::dot(&step, &score);
        if rise.is_nan() || rise < 2.0 * REST {
            break;
        }
        let reached = (0..TRIALS).find_map(|trial| {
            let length = 0.3_f64.powi(trial as i32);
            let place = vector::add_scaled(&point, length, &step);
            let there = density.log_densities(&[place])[0];
            (there >= log_density + SUFFICIENT_RISE * length * rise).then_some((place, there))
        });
        match reached {
            Some((place, log)) if is_known(&place, log) => return None,
            Some(reached) => (point, log_density) = reached,
            None => break,
        }
    }
    summit
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
