//! A scout's way uphill: quasi-Newton steps to the nearest mode.

use mpm_tensor::{Matrix, vector};

use super::density::{Density, Valued};

/// The way ends where a Newton step would raise log p by less than half of this.
const TOLERANCE: f64 = 1e-2;

/// Share of the predicted rise that a step has to bring (Armijo).
const SUFFICIENT_RISE: f64 = 1e-4;

/// From `start` uphill by BFGS with backtracking, with at most `budget` evaluations. `metric` is a first guess of the
/// covariance; without one the first step has length 1.
///
/// J. Nocedal, S. J. Wright, *Numerical Optimization*, 2nd ed., Alg. 6.1 and Eq. 6.17. Returns the highest point met;
/// `None` if the start itself has no finite value.
pub(super) fn ascend<const D: usize>(
    density: &mut Density<'_, D>,
    start: &[f64; D],
    metric: Option<&Matrix<D>>,
    budget: usize,
) -> Option<Valued<D>> {
    let mut here = density.value(start)?;
    let mut inverse_hessian = match metric {
        Some(metric) => *metric,
        None => Matrix::IDENTITY * (1.0 / vector::norm(&here.score).max(1.0)),
    };
    let mut scaled = metric.is_some();
    let (mut spent, mut trusted) = (1, false);
    while spent < budget {
        let mut direction = inverse_hessian.apply(&here.score);
        let mut slope = vector::dot(&direction, &here.score);
        if slope.is_nan() || slope <= 0.0 {
            direction = here.score;
            slope = vector::norm_squared(&here.score);
            inverse_hessian = Matrix::IDENTITY;
        }
        if slope <= TOLERANCE {
            // The metric may have shrunk on the way through a narrow place: believe it the second time.
            if trusted {
                break;
            }
            trusted = true;
            inverse_hessian *= 100.0;
            continue;
        }
        let mut fraction = 1.0;
        let mut accepted = None;
        while spent < budget {
            spent += 1;
            let trial = vector::add_scaled(&here.point, fraction, &direction);
            accepted = density
                .value(&trial)
                .filter(|there| there.log_density >= here.log_density + SUFFICIENT_RISE * fraction * slope);
            if accepted.is_some() {
                break;
            }
            fraction *= 0.3;
        }
        let Some(there) = accepted else { break };
        trusted &= there.log_density < here.log_density + TOLERANCE;
        let step = vector::subtract(&there.point, &here.point);
        let change = vector::subtract(&here.score, &there.score);
        let curvature = vector::dot(&step, &change);
        if curvature > 0.0 {
            if !scaled {
                inverse_hessian = Matrix::IDENTITY * (curvature / vector::norm_squared(&change));
                scaled = true;
            }
            inverse_hessian = updated(&inverse_hessian, &step, &change, curvature);
        } else {
            // Convex stretch: be bolder.
            inverse_hessian *= 4.0;
        }
        here = there;
    }
    Some(here)
}

/// (I − ρ s yᵀ) H (I − ρ y sᵀ) + ρ s sᵀ, ρ = 1 / sᵀy.
fn updated<const D: usize>(h: &Matrix<D>, s: &[f64; D], y: &[f64; D], curvature: f64) -> Matrix<D> {
    let rho = 1.0 / curvature;
    let left = Matrix::IDENTITY - Matrix::outer(s, y) * rho;
    left * *h * left.transpose() + Matrix::outer(s, s) * rho
}

#[cfg(test)]
mod tests {
    use parvi_targets::{Banana, Frame, Gaussian, Target};

    use super::*;

    #[test]
    fn finds_the_mode_of_a_stretched_gaussian_from_afar() {
        let covariance = Matrix([[1e6, 500.0, 0.0], [500.0, 1.0, 0.0], [0.0, 0.0, 1e-6]]);
        let target = Gaussian::new([1.0, 2.0, 3.0], covariance).unwrap();
        let frame = Frame::identity();
        let mut density = Density::new(&target, &frame);
        let summit = ascend(&mut density, &[10.0, -10.0, 10.0], None, 100).unwrap();
        let highest = target.log_density(&[1.0, 2.0, 3.0]);
        assert!(
            highest - summit.log_density < TOLERANCE,
            "{summit:?} {}",
            density.evaluations
        );
        assert!(density.evaluations <= 100);
    }

    #[test]
    fn climbs_a_bent_ridge_within_its_budget() {
        let target = Banana::new(1.0, 0.5).unwrap();
        let frame = Frame::identity();
        for start in [[5.0, 5.0], [-3.0, 0.0], [0.0, 20.0]] {
            let mut density = Density::new(&target, &frame);
            let summit = ascend(&mut density, &start, None, 60).unwrap();
            assert!(
                summit.log_density > target.log_density(&[0.0, -1.0]) - 1.0,
                "{start:?}: {summit:?}"
            );
            assert!(density.evaluations <= 60);
        }
    }

    #[test]
    fn a_start_without_a_density_is_no_start() {
        let target = Gaussian::<1>::standard();
        let frame = Frame::identity();
        assert!(ascend(&mut Density::new(&target, &frame), &[f64::NAN], None, 10).is_none());
    }
}
