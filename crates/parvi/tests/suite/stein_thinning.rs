//! Stein thinning against a naive oracle, against random thinning, and as a method.

use mpm_tensor::vector;
use parvi::{
    Method, NutsOptions, PointSetError, Run, SampleError, SampleSource, Silent, SteinThinningOptions,
    independent_draws, sample, stein_thinning,
};
use parvi_metrics::{Cloud, InverseMultiquadric, kernel_stein_discrepancy};
use parvi_targets::{Gaussian, Target};

use crate::support::{moments, on_threads};

/// Exact draws of a Gaussian with correlation 0.7, stretched, with scores.
fn correlated<const D: usize>(count: usize, stretch: f64) -> (Vec<[f64; D]>, Vec<[f64; D]>) {
    let target = Gaussian::<D>::autoregressive(0.7).expect("a correlation below one");
    let draws = independent_draws(&target, &Run::new(count, 11))
        .expect("draws")
        .positions;
    let draws: Vec<[f64; D]> = draws.iter().map(|x| vector::scale(x, stretch)).collect();
    let scores = draws.iter().map(|x| target.score(x)).collect();
    (draws, scores)
}

/// The greedy choice from the formulas, every sum anew: O(n M²).
fn naive<const D: usize>(positions: &[[f64; D]], scores: &[[f64; D]], count: usize) -> Vec<usize> {
    let moments = moments(positions);
    let sd: [f64; D] = std::array::from_fn(|a| moments.covariance.0[a][a].sqrt());
    let mut correlation = moments.covariance;
    for a in 0..D {
        for b in 0..D {
            correlation.0[a][b] /= sd[a] * sd[b];
        }
    }
    let inverse = correlation.inverse().expect("a regular matrix").0;
    let apply = |v: &[f64; D]| -> [f64; D] { std::array::from_fn(|a| vector::dot(&inverse[a], v)) };
    let kernel = |i: usize, j: usize| {
        let apart: [f64; D] = std::array::from_fn(|a| (positions[i][a] - positions[j][a]) / sd[a]);
        let scaled = |k: usize| -> [f64; D] { std::array::from_fn(|a| scores[k][a] * sd[a]) };
        let weighted = apply(&apart);
        let q = 1.0 + vector::dot(&apart, &weighted);
        let trace: f64 = (0..D).map(|a| inverse[a][a]).sum();
        let mixed = vector::dot(&vector::subtract(&scaled(i), &scaled(j)), &weighted);
        -3.0 * vector::norm_squared(&weighted) / q.powf(2.5)
            + (trace + mixed) / q.powf(1.5)
            + vector::dot(&scaled(i), &scaled(j)) / q.sqrt()
    };
    let mut chosen: Vec<usize> = Vec::new();
    for _ in 0..count {
        let objective = |i: usize| 0.5 * kernel(i, i) + chosen.iter().map(|&j| kernel(i, j)).sum::<f64>();
        let best = (0..positions.len()).min_by(|&i, &j| objective(i).total_cmp(&objective(j)));
        chosen.push(best.expect("a draw"));
    }
    chosen
}

/// The squared discrepancy of some of the draws, in the metrics' own kernel.
fn discrepancy(positions: &[[f64; 2]], scores: &[[f64; 2]], indices: &[usize]) -> f64 {
    let points: Vec<_> = indices.iter().map(|&i| positions[i]).collect();
    let scores: Vec<_> = indices.iter().map(|&i| scores[i]).collect();
    let cloud = Cloud::new(&points).expect("finite");
    kernel_stein_discrepancy(&cloud, &scores, &InverseMultiquadric::default())
        .expect("a discrepancy")
        .squared
}

#[test]
fn the_choice_is_the_naive_one() {
    let (positions, scores) = correlated::<2>(300, 1.0);
    let chosen = stein_thinning(&positions, &scores, 40).expect("a choice");
    assert_eq!(chosen, naive(&positions, &scores, 40));
    let (positions, scores) = correlated::<3>(200, 1.4);
    let chosen = stein_thinning(&positions, &scores, 25).expect("a choice");
    assert_eq!(chosen, naive(&positions, &scores, 25));
}

#[test]
fn the_choice_does_not_depend_on_units() {
    let (positions, scores) = correlated::<3>(500, 1.0);
    // Powers of two, so that scaling rounds nothing.
    let units = [1024.0, 0.125, 1.0];
    let stretched: Vec<[f64; 3]> = positions
        .iter()
        .map(|x| std::array::from_fn(|a| x[a] * units[a]))
        .collect();
    let shrunk: Vec<[f64; 3]> = scores
        .iter()
        .map(|s| std::array::from_fn(|a| s[a] / units[a]))
        .collect();
    assert_eq!(
        stein_thinning(&positions, &scores, 60).expect("a choice"),
        stein_thinning(&stretched, &shrunk, 60).expect("a choice")
    );
}

#[test]
fn the_discrepancy_is_far_below_that_of_every_kth_draw() {
    let (positions, scores) = correlated::<2>(4000, 1.0);
    let chosen = discrepancy(
        &positions,
        &scores,
        &stein_thinning(&positions, &scores, 50).expect("a choice"),
    );
    for offset in 0..20 {
        let every_80th: Vec<usize> = (offset..4000).step_by(80).collect();
        assert!(every_80th.len() == 50);
        let random = discrepancy(&positions, &scores, &every_80th);
        assert!(chosen < 0.25 * random, "offset {offset}: {chosen} of {random}");
    }
}

#[test]
fn draws_that_are_too_wide_are_put_right() {
    let (positions, scores) = correlated::<2>(5000, 1.5);
    let chosen = stein_thinning(&positions, &scores, 200).expect("a choice");
    let points: Vec<_> = chosen.iter().map(|&i| positions[i]).collect();
    let moments = moments(&points);
    for a in 0..2 {
        // The draws have variance 2.25.
        assert!(
            (moments.covariance.0[a][a] - 1.0).abs() < 0.15,
            "{:?}",
            moments.covariance
        );
        assert!(moments.mean[a].abs() < 0.05, "{:?}", moments.mean);
    }
}

#[test]
fn any_number_of_threads_chooses_the_same() {
    let target = Gaussian::<2>::autoregressive(0.5).expect("a correlation below one");
    let method = Method::SteinThinning(SteinThinningOptions::default());
    let choose = |threads: usize| {
        on_threads(threads, || sample(&target, &method, &Run::new(100, 5), &mut Silent)).expect("samples")
    };
    let samples = choose(1);
    assert_eq!(samples.positions, choose(3).positions);
    assert_eq!(samples.positions.len(), 100);
    assert_eq!(samples.score_evaluations, 5000);
    let moments = moments(&samples.positions);
    assert!(vector::maximum_norm(&moments.mean) < 0.05, "{:?}", moments.mean);
    assert!(
        (moments.covariance.0[0][1] - 0.5).abs() < 0.15,
        "{:?}",
        moments.covariance
    );
}

#[test]
fn bad_input_is_named() {
    let points = [[0.0, 1.0], [1.0, 3.0], [2.0, 0.0]];
    let empty = stein_thinning::<2>(&[], &[], 1).expect_err("no draws");
    assert_eq!(empty, PointSetError::Empty { field: "the sample" });
    let uneven = stein_thinning(&points, &points[..2], 1).expect_err("a score is missing");
    assert_eq!(uneven.to_string(), "the number of scores is 2, that of positions 3");
    let not_finite = stein_thinning(&points, &[[0.0; 2], [f64::NAN, 0.0], [0.0; 2]], 1).expect_err("a NaN");
    assert_eq!(not_finite.to_string(), "score 1 is [NaN, 0.0]: too large or not finite");
    let line = [[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]];
    let singular = stein_thinning(&line, &line, 1).expect_err("points on a line");
    assert!(matches!(singular, PointSetError::Covariance(_)), "{singular}");
    let flat = [[0.0, 5.0], [1.0, 5.0], [2.0, 5.0]];
    let singular = stein_thinning(&flat, &flat, 1).expect_err("points on a line");
    assert!(matches!(singular, PointSetError::Covariance(_)), "{singular}");
    assert_eq!(
        stein_thinning(&points, &points, 0).expect("nothing to choose"),
        [0usize; 0]
    );
}

#[test]
fn a_pool_must_hold_the_particles() {
    let target = Gaussian::<2>::standard();
    let method = Method::SteinThinning(SteinThinningOptions {
        pool_size: Some(99),
        ..SteinThinningOptions::default()
    });
    let error = sample(&target, &method, &Run::new(100, 5), &mut Silent).expect_err("too small a pool");
    assert!(
        matches!(error, SampleError::InvalidOption { field: "pool size", .. }),
        "{error}"
    );
}

#[test]
fn without_the_feature_the_no_u_turn_sampler_says_how_to_get_it() {
    let target = Gaussian::<2>::standard();
    let pool = SteinThinningOptions {
        pool: SampleSource::Nuts(NutsOptions::default()),
        pool_size: Some(100),
    };
    for method in [Method::Nuts(NutsOptions::default()), Method::SteinThinning(pool)] {
        let result = sample(&target, &method, &Run::new(20, 5), &mut Silent);
        if cfg!(feature = "nuts") {
            assert_eq!(result.expect("samples").positions.len(), 20);
        } else {
            let message = result.expect_err("another build").to_string();
            assert!(
                message.contains("built without nuts: rebuild with --features nuts"),
                "{message}"
            );
        }
    }
}
