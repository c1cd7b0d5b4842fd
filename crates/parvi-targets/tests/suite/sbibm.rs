//! Posteriors of the benchmark of simulation-based inference against its reference draws, quadrature and differences.

use std::f64::consts::PI;

use parvi_targets::{
    BoxPosterior, CatalogueTarget, ExactDraws, Gaussian, NestedNormals, SimpleLikelihood, Simulator, Target,
    TargetError, TwoMoons, WeightedDraws, coordinate_names,
};
use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;

use crate::conformance::promises::conforming_but_for_the_gradient;

/// For every posterior: mean and standard deviation of 10,000 draws per parameter, absolute values of what is symmetric.
const REFERENCE: &str = include_str!("../../data/sbibm/reference_moments.csv");

fn check<S: Simulator<D>, const D: usize>(
    posterior: Result<BoxPosterior<S, D>, TargetError>,
    along: fn(&[f64; D]) -> [f64; D],
) {
    let posterior = posterior.unwrap();
    conforming(&posterior);
    moments_are_those_of_the_draws(&posterior, &draws(&posterior, 100_000), along);
}

fn conforming<S: Simulator<D>, const D: usize>(posterior: &BoxPosterior<S, D>) {
    conforming_but_for_the_gradient(posterior);
    score_is_the_gradient(posterior);
}

fn draws<S: Simulator<D>, const D: usize>(posterior: &BoxPosterior<S, D>, count: usize) -> Vec<[f64; D]> {
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    (0..count).map(|_| posterior.draw(&mut rng)).collect()
}

/// Differences of fourth order at draws and beyond them, away from jumps and kinks.
fn score_is_the_gradient<S: Simulator<D>, const D: usize>(posterior: &BoxPosterior<S, D>) {
    let (mut rng, step) = (ChaCha8Rng::seed_from_u64(1), 1e-5);
    let mut compared = 0;
    for index in 0..300 {
        let y = posterior.draw(&mut rng).map(|y| y * [1.0, 1.1, 1.7][index % 3]);
        let score = posterior.score(&y);
        for axis in 0..D {
            let at = |multiple: f64| {
                let mut moved = y;
                moved[axis] += multiple * step;
                posterior.log_density(&moved)
            };
            let values = [-2.0, -1.0, 1.0, 2.0].map(at);
            let slope = (8.0 * (values[2] - values[1]) - (values[3] - values[0])) / (12.0 * step);
            let jumps = values.windows(2).any(|pair| (pair[1] - pair[0]).abs() > 10.0);
            let tolerance = 1e-6 * (100.0 + slope.abs()) + 1e-9 * values[1].abs();
            assert!(
                jumps || (slope - score[axis]).abs() < tolerance,
                "{} at {y:?}: {slope}, {score:?}",
                posterior.name()
            );
            compared += usize::from(!jumps);
        }
    }
    assert!(compared > 290 * D);
}

/// Means and standard deviations within four and a half standard errors of 10,000 draws beside 100,000, which are 0.01 and at most a few percent.
fn moments_are_those_of_the_draws<S: Simulator<D>, const D: usize>(
    posterior: &BoxPosterior<S, D>,
    draws: &[[f64; D]],
    along: fn(&[f64; D]) -> [f64; D],
) {
    let draws: Vec<[f64; D]> = draws.iter().map(|y| along(&posterior.in_box(y))).collect();
    let cells = REFERENCE.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let known: Vec<[f64; 2]> = cells
        .filter(|cells| cells[0] == posterior.name())
        .map(|cells| [2, 3].map(|column| cells[column].parse().unwrap()))
        .collect();
    assert_eq!(known.len(), D);
    for (k, [mean, deviation]) in known.into_iter().enumerate() {
        let expectation = |of: &dyn Fn(f64) -> f64| draws.iter().map(|x| of(x[k])).sum::<f64>() / draws.len() as f64;
        let found = expectation(&|x| x);
        let variance = expectation(&|x| (x - found).powi(2));
        let kurtosis = expectation(&|x| (x - found).powi(4)) / (variance * variance);
        let (shift, ratio) = ((found - mean) / deviation, variance.sqrt() / deviation);
        let deviation_error = (0.25 * (kurtosis - 1.0) * 1.1e-4).sqrt();
        assert!(
            shift.abs() < 4.5 * 1.1e-4_f64.sqrt(),
            "{} {k}: {shift}",
            posterior.name()
        );
        assert!(
            (ratio - 1.0).abs() < 4.5 * deviation_error,
            "{} {k}: {ratio}",
            posterior.name()
        );
    }
}

#[test]
fn two_moons() {
    for number in 1..=3 {
        // Along and across the crescents, of which there are two.
        check(TwoMoons::posterior(number), |x| [(x[0] + x[1]).abs(), x[1] - x[0]]);
    }
}

#[test]
fn nested_normals() {
    for number in 1..=3 {
        check(NestedNormals::posterior(number), |x| *x);
    }
}

/// One crescent in polar coordinates (r, a) about its centre, where θ has the area element r dr da, counted twice.
#[test]
fn crescents_have_their_evidence() {
    let posterior = TwoMoons::posterior(1).unwrap();
    let moons = posterior.simulator();
    let (steps, mut sum) = (400, 0.0);
    for i in 0..steps {
        for j in 0..steps {
            let r = 0.02 + 0.16 * (f64::from(i) + 0.5) / f64::from(steps);
            let a = PI * ((f64::from(j) + 0.5) / f64::from(steps) - 0.5);
            let (along, across) = (r * a.cos() + 0.25 + 0.639_670_6, 0.162_346_57 - r * a.sin());
            let theta = [(along - across) / 2_f64.sqrt(), (along + across) / 2_f64.sqrt()];
            sum += moons.log_density(&theta).exp() * r;
        }
    }
    let mass = 2.0 * sum * 0.16 * PI / f64::from(steps * steps) / 4.0;
    assert!((mass.ln() - posterior.log_evidence().unwrap()).abs() < 1e-6, "{mass}");
}

/// The same draws, of which those of one posterior take three hundred proposals each, for moments and evidence.
#[test]
fn simple_likelihoods() {
    for number in 1..=5 {
        let posterior = SimpleLikelihood::posterior(number).unwrap();
        conforming(&posterior);
        let draws = draws(&posterior, 40_000);
        let along = |x: &[f64; 5]| [x[0], x[1], x[2].abs(), x[3].abs(), x[4]];
        moments_are_those_of_the_draws(&posterior, &draws, along);
        evidence_is_that_of_the_draws(&posterior, draws.iter().map(along).collect());
    }
}

/// Draws, density and evidence together: with q the density of a normal law narrower than the posterior within one of its four equal parts, the mean of
/// q/p over draws, all moved there, is 4/Z (A. E. Gelfand, D. K. Dey, *J. R. Stat. Soc. B* 56 (1994) 501–514).
fn evidence_is_that_of_the_draws(posterior: &BoxPosterior<SimpleLikelihood, 5>, draws: Vec<[f64; 5]>) {
    let points = draws.clone();
    let weights = vec![1.0; points.len()];
    let moments = WeightedDraws { points, weights }.moments();
    let narrow = Gaussian::new(moments.mean, moments.covariance * 0.2).unwrap();
    let evidence = posterior.log_evidence().unwrap();
    let ratio = |y: &[f64; 5]| (narrow.log_density(y) - posterior.log_density(y) + evidence).exp() / 4.0;
    let ratios: Vec<f64> = draws.iter().map(ratio).collect();
    let count = ratios.len() as f64;
    let mean = ratios.iter().sum::<f64>() / count;
    let error = ratios.iter().map(|ratio| (ratio - mean).powi(2)).sum::<f64>().sqrt() / count;
    assert!(
        error < 0.04 && (mean - 1.0).abs() < 4.0 * error,
        "{}: {mean} ± {error}",
        posterior.name()
    );
}

/// The midpoint rule over the box.
#[test]
fn nested_normals_have_their_evidence() {
    for number in 1..=3 {
        let posterior = NestedNormals::posterior(number).unwrap();
        let count = 1000;
        let at = |index: i32| 20.0 * (f64::from(index) + 0.5) / f64::from(count) - 10.0;
        let of_row = |i: i32| {
            let of_point = |j: i32| posterior.simulator().log_density(&[at(i), at(j)]).exp();
            (0..count).map(of_point).sum::<f64>()
        };
        let mean = (0..count).map(of_row).sum::<f64>() / f64::from(count * count);
        let stated = posterior.log_evidence().unwrap();
        assert!(
            (mean.ln() - stated).abs() < 1e-4,
            "{number}: {} for {stated}",
            mean.ln()
        );
    }
}

#[test]
fn other_numbers_are_refused() {
    assert!(TwoMoons::posterior(0).is_err() && TwoMoons::posterior(4).is_err());
    let error = SimpleLikelihood::posterior(6).unwrap_err().to_string();
    assert!(error.starts_with("the number of an observation is 6"), "{error}");
}

#[test]
fn coordinates_are_log_odds_of_parameters() {
    let names = |name| coordinate_names(name, None, &Default::default()).unwrap().unwrap();
    assert_eq!(names("sbibm-two-moons-2"), ["logit θ_{1}", "logit θ_{2}"]);
    assert_eq!(names("sbibm-slcp-1").len(), 5);
}
