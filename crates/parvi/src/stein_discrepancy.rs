//! How far particles are from Stein's identity, and how rough a target is where they are.

use mpm_tensor::vector;

use crate::driven::Driven;
use crate::stein_thinning::{Candidate, SteinKernel};

/// A target is rough where E|s|²/D, the mean curvature of −log p by Stein's identity, exceeds this; it is 1 for N(0, I).
const ROUGH: f64 = 3.0;

/// Of more particles than these every second, third, … is taken, since the cost is their square.
const LARGEST_COUNT: usize = 1 << 12;

/// Whether a finer spacing is worth trying for particles with these scores, in coordinates of the frame.
pub(crate) fn is_rough<const D: usize>(scores: &[[f64; D]]) -> bool {
    let square: f64 = scores.iter().map(vector::norm_squared).sum();
    square > ROUGH * (D * scores.len()) as f64
}

/// The squared kernel Stein discrepancy of equally weighted particles in the coordinates in which they moved (V-statistic): the mean of the Stein kernel of the inverse multiquadric,
/// with Γ = I, over all pairs.
///
/// Source: J. Gorham, L. Mackey, *Measuring sample quality with kernels*, ICML 2017, §3–4.
pub(crate) fn squared_stein_discrepancy<const D: usize>(body: &Driven<D>) -> f64 {
    squared_discrepancy(&body.positions, &body.scores)
}

/// [`squared_stein_discrepancy`] of points with their scores.
pub(crate) fn squared_discrepancy<const D: usize>(positions: &[[f64; D]], scores: &[[f64; D]]) -> f64 {
    let kernel = SteinKernel::isotropic::<D>();
    let pairs = positions
        .iter()
        .zip(scores)
        .step_by(positions.len().div_ceil(LARGEST_COUNT));
    let points: Vec<Candidate<D>> = pairs.map(|(x, s)| Candidate::isotropic(x, s)).collect();
    let row = |p: usize| -> f64 {
        let below: f64 = points[..p].iter().map(|other| kernel.value(&points[p], other)).sum();
        2.0 * below + kernel.value(&points[p], &points[p])
    };
    let rows = mpm_parallel::collect(points.len(), 1, &row);
    rows.iter().sum::<f64>() / (points.len() as f64).powi(2)
}

#[cfg(test)]
mod tests {
    use parvi_metrics::{Cloud, InverseMultiquadric, kernel_stein_discrepancy};
    use parvi_targets::{Cross, Gaussian, Ring, Target};

    use super::*;
    use crate::start::quasi_random_normal;

    #[test]
    fn the_discrepancy_is_that_of_the_metrics() {
        let target = Ring::new(2.0, 0.2).unwrap();
        let positions = quasi_random_normal::<2>(200, 3).unwrap();
        let scores: Vec<[f64; 2]> = positions.iter().map(|x| target.score(x)).collect();
        let cloud = Cloud::new(&positions).unwrap();
        let oracle = kernel_stein_discrepancy(&cloud, &scores, &InverseMultiquadric::new(1.0, -0.5).unwrap()).unwrap();
        let found = squared_discrepancy(&positions, &scores);
        assert!(
            (found / oracle.squared - 1.0).abs() < 1e-12,
            "{found} {}",
            oracle.squared
        );
    }

    #[test]
    fn a_gaussian_is_smooth_and_a_cross_is_rough() {
        let positions = quasi_random_normal::<3>(300, 3).unwrap();
        let scores = |target: &dyn Target<3>| -> Vec<[f64; 3]> { positions.iter().map(|x| target.score(x)).collect() };
        assert!(!is_rough(&scores(&Gaussian::standard())));
        assert!(is_rough(&scores(&Cross::new(2.0, 0.2).unwrap())));
    }
}
