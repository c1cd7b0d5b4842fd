//! What several themes need.

use parvi_targets::{Curvature, Parameters, Target};

/// The default parameters but for a change.
pub fn with(change: impl FnOnce(&mut Parameters)) -> Parameters {
    let mut parameters = Parameters::default();
    change(&mut parameters);
    parameters
}

/// log Π N(β_k; 0, s²).
pub fn log_prior<const D: usize>(beta: &[f64; D], deviation: f64) -> f64 {
    let constant = (deviation * std::f64::consts::TAU.sqrt()).ln();
    beta.iter().map(|b| -0.5 * (b / deviation).powi(2) - constant).sum()
}

/// The negative Hessian at x is the derivative of the score.
pub fn assert_hessian<const D: usize>(target: &(impl Target<D> + Curvature<D>), x: &[f64; D], tolerance: f64) {
    let hessian = target.negative_hessian(x);
    for j in 0..D {
        let step = 1e-5;
        let (mut ahead, mut behind) = (*x, *x);
        ahead[j] += step;
        behind[j] -= step;
        let (ahead, behind) = (target.score(&ahead), target.score(&behind));
        for i in 0..D {
            let slope = -(ahead[i] - behind[i]) / (2.0 * step);
            assert!((hessian.0[i][j] - slope).abs() < tolerance);
        }
    }
}
