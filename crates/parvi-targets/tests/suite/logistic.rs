//! Logistic regression: the batched form against the definition, its reproducibility, and the Laplace approximation.

use parvi_targets::{CatalogueTarget, LogisticRegression, RegressionData, Target, TargetError, wells};

use crate::support::{assert_hessian, log_prior};

/// Coefficients of moderate size, different for every particle and axis.
fn particles<const D: usize>(count: usize) -> Vec<[f64; D]> {
    (0..count)
        .map(|p| std::array::from_fn(|k| ((p * D + k + 1) as f64 * 0.618_033_988_75).fract() * 4.0 - 2.0))
        .collect()
}

fn regression<const D: usize>(rows: usize) -> LogisticRegression<D> {
    let coefficients: [f64; D] = std::array::from_fn(|k| 0.5 - 0.3 * k as f64);
    let data = RegressionData::synthetic(&coefficients, rows, 9).unwrap();
    LogisticRegression::with_prior("synthetic", data, 10.0).unwrap()
}

fn scores<const D: usize>(target: &LogisticRegression<D>, xs: &[[f64; D]]) -> Vec<[f64; D]> {
    let mut out = vec![[f64::NAN; D]; xs.len()];
    target.scores(xs, &mut out);
    out
}

fn log_densities<const D: usize>(target: &LogisticRegression<D>, xs: &[[f64; D]]) -> Vec<f64> {
    let mut out = vec![f64::NAN; xs.len()];
    target.log_densities(xs, &mut out);
    out
}

/// The same bits for a particle at every place of every batch.
fn does_not_depend_on_the_batch<const D: usize>() {
    for rows in [1, 7, 64, 129, 300] {
        let target = regression::<D>(rows);
        let xs = particles::<D>(201);
        let (all, densities) = (scores(&target, &xs), log_densities(&target, &xs));
        let reversed: Vec<[f64; D]> = xs.iter().rev().copied().collect();
        assert!(scores(&target, &reversed).iter().rev().eq(all.iter()));
        assert!(log_densities(&target, &reversed).iter().rev().eq(densities.iter()));
        // Every batch is filled up to 64.
        for (size, count) in [(1, 9), (5, 29), (63, 201), (64, 201), (65, 201), (130, 201)] {
            let batches = || xs[..count].chunks(size);
            let parts: Vec<[f64; D]> = batches().flat_map(|part| scores(&target, part)).collect();
            assert_eq!(parts, all[..count], "D = {D}, {rows} rows, batches of {size}");
            let parts: Vec<f64> = batches().flat_map(|part| log_densities(&target, part)).collect();
            assert_eq!(parts, densities[..count], "D = {D}, {rows} rows, batches of {size}");
        }
        // One particle at each of the 64 places of a group, among others.
        for place in 0..64 {
            let mut batch = particles::<D>(64);
            batch[place] = xs[200];
            assert_eq!(
                scores(&target, &batch)[place],
                all[200],
                "D = {D}, {rows} rows, place {place}"
            );
            assert_eq!(log_densities(&target, &batch)[place], densities[200]);
        }
    }
}

#[test]
fn a_particle_has_the_same_bits_in_every_batch() {
    crate::in_dimensions!(does_not_depend_on_the_batch(), 1, 2, 3, 4, 5, 6, 7, 8);
}

#[test]
fn the_number_of_threads_does_not_change_a_bit() {
    let target = LogisticRegression::<5>::with_prior("wells", wells(5, None).unwrap(), 10.0).unwrap();
    let xs = particles::<5>(700);
    let with_threads = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| (scores(&target, &xs), log_densities(&target, &xs)))
    };
    let one = with_threads(1);
    assert_eq!(one, with_threads(2));
    assert_eq!(one, with_threads(5));
}

/// Batch and single point against the textbook formula, written with the responses as they are.
#[test]
fn agrees_with_the_definition() {
    let target = regression::<4>(333);
    let data = target.data().clone();
    let xs = particles::<4>(70);
    let (scores, densities) = (scores(&target, &xs), log_densities(&target, &xs));
    for (p, beta) in xs.iter().enumerate() {
        let mut score = beta.map(|b| -b / 100.0);
        let mut density = log_prior(beta, 10.0);
        for (row, &response) in data.responses().iter().enumerate() {
            let x = data.covariates(row).unwrap();
            let logit: f64 = x.iter().zip(beta).map(|(x, b)| x * b).sum();
            let y = f64::from(u8::from(response));
            density += y * logit - (1.0 + logit.exp()).ln();
            for k in 0..4 {
                score[k] += (y - 1.0 / (1.0 + (-logit).exp())) * x[k];
            }
        }
        assert!((densities[p] - density).abs() < 1e-11);
        assert!((target.log_density(beta) - density).abs() < 1e-11);
        for k in 0..4 {
            assert!((scores[p][k] - score[k]).abs() < 1e-11);
            assert!((target.score(beta)[k] - score[k]).abs() < 1e-11);
        }
    }
}

/// A balanced column ±1 on an intercept: two independent predictors, whose evidence is the mean of the likelihood over the prior.
#[test]
fn the_integral_of_the_density_is_the_evidence() {
    let rows: Vec<(bool, Vec<f64>)> = (0..12)
        .map(|i| (i % 3 == 0, vec![f64::from(i % 2) * 2.0 - 1.0]))
        .collect();
    let data = RegressionData::new("two groups", &["side"], &rows).unwrap();
    let target = LogisticRegression::<2>::with_prior("two groups", data, 1.5).unwrap();
    let (mut integral, mut mean, mut mass) = (0.0, 0.0, 0.0);
    let step = 0.05;
    let places = (-240..=240).map(|k| f64::from(k) * step);
    for a in places.clone() {
        for b in places.clone() {
            let prior = (-0.5 * (a * a + b * b) / 2.25).exp();
            let likelihood = |(yes, x): &(bool, Vec<f64>)| {
                let margin = if *yes { 1.0 } else { -1.0 } * (a + b * x[0]);
                1.0 / (1.0 + (-margin).exp())
            };
            mean += prior * rows.iter().map(likelihood).product::<f64>();
            mass += prior;
            integral += target.log_density(&[a, b]).exp() * step * step;
        }
    }
    assert!(
        (integral / (mean / mass) - 1.0).abs() < 1e-9,
        "{integral}, {}",
        mean / mass
    );
}

#[test]
fn the_hessian_is_the_derivative_of_the_score() {
    let target = regression::<3>(50);
    assert_hessian(&target, &[0.3, -0.4, 1.1], 1e-8);
}

/// Modes and standard deviations of the wells posteriors (prior sd 10), computed independently in double precision with
/// exactly rounded sums and Gauss elimination; with a flat prior the third model is the one printed in Gelman & Hill,
/// §5.4: 0.002749 − 0.896644 · dist/100 + 0.460775 · arsenic.
#[test]
fn the_laplace_approximation_of_the_wells_posterior() {
    let target = LogisticRegression::<5>::with_prior("wells", wells(5, None).unwrap(), 10.0).unwrap();
    let mode = [
        -0.156_717_437_982_518_7,
        -0.896_012_143_709_667_2,
        0.466_999_582_547_352_35,
        0.169_780_261_757_205_3,
        -0.124_296_682_933_732_8,
    ];
    let deviations = [
        0.099_594_178_872_432_8,
        0.104_568_361_522_041_6,
        0.041_600_669_223_083_4,
        0.038_349_695_641_173_7,
        0.076_963_040_172_355_4,
    ];
    for k in 0..5 {
        assert!((target.laplace().mode()[k] - mode[k]).abs() < 1e-12);
        assert!((target.laplace().covariance().0[k][k].sqrt() / deviations[k] - 1.0).abs() < 1e-11);
    }
    assert!(target.score(target.laplace().mode()).iter().all(|s| s.abs() < 1e-10));

    let flat = LogisticRegression::<3>::with_prior("wells", wells(3, None).unwrap(), f64::INFINITY).unwrap();
    for (found, printed) in flat.laplace().mode().iter().zip([0.002749, -0.896644, 0.460775]) {
        assert!((found - printed).abs() < 1e-6);
    }
}

#[test]
fn the_frame_is_that_of_the_laplace_approximation() {
    let target = regression::<2>(100);
    assert_eq!(&target.frame(), target.laplace().frame());
    assert!(target.moments().is_none() && target.exact_draws().is_none());
}

#[test]
fn synthetic_data_follow_the_seed_and_the_coefficients() {
    let coefficients = [-0.5, 1.0, 0.0, 2.0];
    let data = RegressionData::synthetic(&coefficients, 20_000, 4).unwrap();
    assert_eq!(data, RegressionData::synthetic(&coefficients, 20_000, 4).unwrap());
    assert_ne!(data, RegressionData::synthetic(&coefficients, 20_000, 5).unwrap());
    let target = LogisticRegression::<4>::with_prior("synthetic", data, f64::INFINITY).unwrap();
    for k in 0..4 {
        let deviation = target.laplace().covariance().0[k][k].sqrt();
        assert!((target.laplace().mode()[k] - coefficients[k]).abs() < 4.5 * deviation);
    }
    assert!(matches!(
        RegressionData::synthetic(&[], 3, 0),
        Err(TargetError::Empty { .. })
    ));
    assert!(matches!(
        RegressionData::synthetic(&[1.0], 0, 0),
        Err(TargetError::DataNoRows { .. })
    ));
    assert!(matches!(
        RegressionData::synthetic(&[f64::NAN], 3, 0),
        Err(TargetError::NotFinite { .. })
    ));
}

#[test]
fn the_dimension_and_the_prior_are_checked() {
    let data = || wells(3, None).unwrap();
    let error = LogisticRegression::<2>::with_prior("wells", data(), 10.0).unwrap_err();
    assert!(matches!(
        error,
        TargetError::Length {
            expected: 3,
            found: 2,
            ..
        }
    ));
    for prior in [0.0, -1.0, f64::NAN, f64::NEG_INFINITY] {
        assert!(LogisticRegression::<3>::with_prior("wells", data(), prior).is_err());
    }
}
