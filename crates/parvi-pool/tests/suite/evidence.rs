//! What weights guarantee.

use mpm_tensor::Matrix;
use parvi_targets::{Gaussian, Target};

use crate::common::pool_of;

#[test]
fn the_evidence_of_a_normal_law_is_one() {
    for seed in 0..3 {
        let pool = pool_of(&Gaussian::<2>::standard(), 300, seed).unwrap();
        let verdict = pool.verdict;
        assert!(
            verdict.log_evidence.abs() < 4.0 * verdict.log_evidence_error,
            "{verdict:?}"
        );
        assert!(pool.log_evidence.abs() < 0.02, "{}", pool.log_evidence);
        let square = pool.expectation(|x| x[0] * x[0]);
        assert!((square.value - 1.0).abs() < 5.0 * square.standard_error, "{square:?}");
        assert!(pool.quantile(1, 0.5).abs() < 0.1);
    }
}

/// Kernels are so near to a normal law that most of the error of a thin slab's mass is that of free draws.
#[test]
fn errors_count_free_draws() {
    let exact = 0.079_655_674_554_057_96;
    let squares = (0..16).map(|seed| {
        let pool = pool_of(&Gaussian::<3>::standard(), 300, seed).unwrap();
        let found = pool.expectation(|x| f64::from(((x[0] + x[1] + x[2]) / 3_f64.sqrt()).abs() < 0.1));
        ((found.value - exact) / found.standard_error).powi(2)
    });
    let size = (squares.sum::<f64>() / 16.0).sqrt();
    assert!((0.4..1.4).contains(&size), "{size}");
}

/// Free draws with the same scrambling for every seed left an error that no mean over seeds took away.
#[test]
fn errors_of_seeds_are_independent() {
    let exact = 0.05;
    let errors: Vec<f64> = (0..192)
        .map(|seed| {
            let pool = pool_of(&Gaussian::<3>::standard(), 300, seed).unwrap();
            pool.expectation(|x| f64::from(x[0] > 1.644_853_626_951_472_7)).value - exact
        })
        .collect();
    let mean = errors.iter().sum::<f64>() / 192.0;
    let variance = errors.iter().map(|error| (error - mean).powi(2)).sum::<f64>() / 191.0;
    let deviation = mean / (variance / 192.0).sqrt();
    assert!(deviation.abs() < 2.5, "{deviation}");
}

/// A parameter of exponential law, as its logarithm.
struct LogarithmOfExponential;

impl Target<1> for LogarithmOfExponential {
    fn log_density(&self, y: &[f64; 1]) -> f64 {
        y[0] - y[0].exp()
    }

    fn score(&self, y: &[f64; 1]) -> [f64; 1] {
        [1.0 - y[0].exp()]
    }
}

/// Kernels have longer tails than a target that falls off like e^−e^y, and in these e^y has no expectation.
#[test]
fn functions_that_grow_faster_than_the_kernels_fall_off_have_their_expectation() {
    for (particles, seed) in [(300, 1), (300, 2), (2000, 1), (2000, 2)] {
        let pool = pool_of(&LogarithmOfExponential, particles, seed).unwrap();
        for (power, exact) in [(1, 1.0), (2, 2.0), (3, 6.0)] {
            let found = pool.expectation(|y| y[0].exp().powi(power));
            assert!(
                (found.value / exact - 1.0).abs() < 0.1,
                "{particles} {seed} {power}: {found:?}"
            );
            assert!((found.value - exact).abs() < 4.0 * found.standard_error, "{found:?}");
        }
    }
}

#[test]
fn scales_that_the_frame_does_not_know_are_found() {
    let scales = [1e-2, 0.3, 1e2];
    let covariance = Matrix::from_fn(|i, j| scales[i] * scales[j] * 0.7_f64.powi(i.abs_diff(j) as i32));
    let target = Gaussian::<3>::new([20.0, -3.0, 50.0], covariance).unwrap();
    let pool = pool_of(&target, 300, 1).unwrap();
    assert!(pool.log_evidence.abs() < 0.02, "{}", pool.log_evidence);
    // A tenth of the 8,000 that it may take goes to the search for other pieces.
    let evaluations = pool.density_evaluations + pool.score_evaluations;
    assert!(evaluations < 16 * 300 + 800, "{evaluations}");
    let (_, found) = pool.moments();
    for axis in 0..3 {
        assert!((found.0[axis][axis].sqrt() / scales[axis] - 1.0).abs() < 0.05);
    }
}

#[test]
fn the_same_bits_on_any_number_of_threads() {
    let target = Gaussian::<4>::autoregressive(0.8).unwrap();
    let run = |threads| {
        let workers = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        workers.install(|| {
            let pool = pool_of(&target, 100, 5).unwrap();
            let particles = pool.condense(100);
            (pool.weights, pool.verdict, particles)
        })
    };
    assert!(run(1) == run(2));
}
