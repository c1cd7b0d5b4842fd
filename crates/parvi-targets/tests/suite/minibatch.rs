//! Minibatched scores: unbiased, reproducible, and quieter with a control variate.

use mpm_tensor::vector;
use parvi_targets::{LogisticRegression, MinibatchScore, RegressionData, SumTarget, Target, TargetError};

const ROWS: usize = 2_000;

fn posterior() -> LogisticRegression<3> {
    let data = RegressionData::synthetic(&[0.5, -1.0, 0.3], ROWS, 5).unwrap();
    LogisticRegression::with_prior("synthetic", data, 2.0).unwrap()
}

/// A standard deviation from the mode on every axis, and two.
fn points(posterior: &LogisticRegression<3>) -> [[f64; 3]; 2] {
    let frame = posterior.laplace().frame();
    [frame.to_target(&[1.0, -1.0, 1.0]), frame.to_target(&[-2.0, 0.0, 2.0])]
}

/// The mean of ŝ over `calls`, and the root mean square of |ŝ − s| at each point.
fn mean_and_noise<T: SumTarget<3>>(
    target: &MinibatchScore<T, 3>,
    xs: &[[f64; 3]; 2],
    exact: &[[f64; 3]; 2],
    calls: u64,
) -> ([[f64; 3]; 2], [f64; 2]) {
    let (mut mean, mut squares) = ([[0.0; 3]; 2], [0.0; 2]);
    let mut out = [[0.0; 3]; 2];
    for call in 0..calls {
        target.scores_of_call(call, xs, &mut out);
        for p in 0..2 {
            vector::accumulate(&mut mean[p], 1.0 / calls as f64, &out[p]);
            squares[p] += vector::norm_squared(&vector::subtract(&out[p], &exact[p])) / calls as f64;
        }
    }
    (mean, squares.map(f64::sqrt))
}

#[test]
fn the_sum_is_the_target() {
    let posterior = posterior();
    for x in points(&posterior) {
        let terms = (0..ROWS).map(|row| posterior.term_log_density(row, &x)).sum::<f64>();
        let sum = posterior.prior_log_density(&x) + terms;
        assert!((sum - posterior.log_density(&x)).abs() < 1e-9);
        let mut score = posterior.prior_score(&x);
        for row in 0..ROWS {
            vector::accumulate(&mut score, 1.0, &posterior.term_score(row, &x));
        }
        assert!(vector::distance(&score, &posterior.score(&x)) < 1e-9);
        // The batched sum is the sum of the parts.
        let rows = [3, 10, 77, 1999];
        let mut sums = [[0.0; 3]; 2];
        posterior.sums_of_term_scores(&rows, &[x, x], &mut sums);
        let mut sum = [0.0; 3];
        for row in rows {
            vector::accumulate(&mut sum, 1.0, &posterior.term_score(row, &x));
        }
        assert!(vector::distance(&sums[0], &sum) < 1e-13 && sums[0] == sums[1]);
    }
    assert_eq!(posterior.term_score(ROWS, &[0.0; 3]), [0.0; 3]);
}

#[test]
fn estimates_are_unbiased_and_a_control_variate_quietens_them() {
    let posterior = posterior();
    let xs = points(&posterior);
    let exact = xs.map(|x| posterior.score(&x));
    let mode = *posterior.laplace().mode();
    let plain = MinibatchScore::new(&posterior, 50, 1).unwrap();
    let controlled = MinibatchScore::new(&posterior, 50, 1)
        .unwrap()
        .with_control_variate(mode)
        .unwrap();
    const CALLS: u64 = 4_000;
    let (mean, noise) = mean_and_noise(&plain, &xs, &exact, CALLS);
    let (controlled_mean, controlled_noise) = mean_and_noise(&controlled, &xs, &exact, CALLS);
    for p in 0..2 {
        let error = vector::distance(&mean[p], &exact[p]);
        assert!(
            error < 3.0 * noise[p] / (CALLS as f64).sqrt(),
            "{error}, noise {}",
            noise[p]
        );
        let error = vector::distance(&controlled_mean[p], &exact[p]);
        assert!(error < 3.0 * controlled_noise[p] / (CALLS as f64).sqrt());
        // At one and two standard deviations from the mode: variances smaller by three orders.
        let variance_ratio = (controlled_noise[p] / noise[p]).powi(2);
        assert!(variance_ratio < 5e-3, "{variance_ratio}");
    }
    // At the centre there is no noise.
    let mut at_mode = [[0.0; 3]];
    controlled.scores_of_call(9, &[mode], &mut at_mode);
    assert!(vector::distance(&at_mode[0], &posterior.score(&mode)) < 1e-9);
}

/// Every term is drawn with the same frequency b/n, within sampling error.
#[test]
fn terms_are_drawn_evenly_and_without_replacement() {
    let posterior = posterior();
    let target = MinibatchScore::new(&posterior, 200, 11).unwrap();
    let mut counts = vec![0_u32; ROWS];
    const CALLS: u64 = 2_000;
    for call in 0..CALLS {
        let terms = target.terms_of_call(call);
        assert!(terms.len() == 200 && terms.windows(2).all(|pair| pair[0] < pair[1]));
        for term in terms {
            counts[term] += 1;
        }
    }
    // χ² of 2,000 counts of mean 200 and variance 200 · 0.9: mean n, variance 2n.
    let chi_square: f64 = counts
        .iter()
        .map(|&count| (f64::from(count) - 200.0).powi(2) / 180.0)
        .sum();
    let n = ROWS as f64;
    assert!((chi_square - n).abs() < 4.5 * (2.0 * n).sqrt(), "{chi_square}");
}

#[test]
fn the_seed_and_the_number_of_the_call_fix_the_bits() {
    let posterior = posterior();
    let xs: Vec<[f64; 3]> = (0..300).map(|p| [0.01 * p as f64, -0.5, 0.2]).collect();
    let run = |seed: u64, threads: usize| {
        let target = MinibatchScore::new(&posterior, 64, seed).unwrap();
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let calls = pool.install(|| {
            let call = |_| {
                let mut out = vec![[0.0; 3]; xs.len()];
                target.scores(&xs, &mut out);
                out
            };
            (0..3).map(call).collect::<Vec<_>>()
        });
        assert_eq!(target.calls(), 3);
        target.restart();
        let mut again = vec![[0.0; 3]; 2];
        target.scores(&xs[5..7], &mut again);
        // The same minibatch, whatever the batch of points.
        assert_eq!(again, calls[0][5..7]);
        calls
    };
    let calls = run(7, 1);
    assert_eq!(calls, run(7, 2));
    assert_ne!(calls[0], calls[1]);
    assert_ne!(calls, run(8, 1));
}

#[test]
fn all_terms_give_the_exact_score() {
    let posterior = posterior();
    let target = MinibatchScore::new(&posterior, ROWS, 0).unwrap();
    for x in points(&posterior) {
        assert!(vector::distance(&target.score(&x), &posterior.score(&x)) < 1e-9);
        assert_eq!(target.log_density(&x), posterior.log_density(&x));
    }
}

/// The sums that the trait gives without help.
#[test]
fn own_sums_need_no_batches() {
    struct Means(Vec<f64>);
    impl SumTarget<1> for Means {
        fn terms(&self) -> usize {
            self.0.len()
        }
        fn prior_log_density(&self, x: &[f64; 1]) -> f64 {
            -0.5 * x[0] * x[0]
        }
        fn prior_score(&self, x: &[f64; 1]) -> [f64; 1] {
            [-x[0]]
        }
        fn term_log_density(&self, term: usize, x: &[f64; 1]) -> f64 {
            -0.5 * (self.0[term] - x[0]).powi(2)
        }
        fn term_score(&self, term: usize, x: &[f64; 1]) -> [f64; 1] {
            [self.0[term] - x[0]]
        }
    }
    let means = Means(vec![1.0, 2.0, 6.0]);
    let target = MinibatchScore::new(means, 1, 0)
        .unwrap()
        .with_control_variate([2.0])
        .unwrap();
    // Gaussian terms have the same slope, so the control variate leaves no noise anywhere: −x + Σ (d − x).
    for x in [-1.0, 0.0, 5.0] {
        assert!((target.score(&[x])[0] - (9.0 - 4.0 * x)).abs() < 1e-12);
    }
    let mut densities = [0.0];
    target.log_densities(&[[2.0]], &mut densities);
    assert_eq!(densities[0], -2.0 - 0.5 - 8.0);
}

#[test]
fn bad_sizes_and_centres_are_refused() {
    let posterior = posterior();
    for batch in [0, ROWS + 1] {
        let error = MinibatchScore::new(&posterior, batch, 0).unwrap_err();
        assert!(matches!(error, TargetError::OutOfRange { .. }), "{error}");
    }
    let target = MinibatchScore::new(&posterior, 10, 0).unwrap();
    let error = target.with_control_variate([f64::NAN, 0.0, 0.0]).unwrap_err();
    assert!(matches!(error, TargetError::NotFinite { .. }), "{error}");
}
