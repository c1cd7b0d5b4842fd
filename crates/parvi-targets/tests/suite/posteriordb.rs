//! Posteriors of posteriordb against its reference draws.

use parvi_targets::{
    Arma, CatalogueTarget, Garch, GaussianProcess, HiddenMarkov, ImportanceSample, LinearModel, LotkaVolterra,
    ModelPosterior, NormalMixture, ReferenceOptions, Target, TargetError, catalogue, coordinate_names,
};

use crate::conformance::promises::conforming;

/// For every posterior: mean and standard deviation of 5,000 nearly independent draws per parameter.
const REFERENCE: &str = include_str!("../../data/posteriordb/reference_moments.csv");

/// Standard error of the mean of 5,000 draws, in standard deviations.
const STANDARD_ERROR: f64 = 0.014;

/// Name, mean and standard deviation of the parameters of a target.
fn reference(target: &str) -> Vec<(&'static str, f64, f64)> {
    let cells = REFERENCE.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let of_target = cells.filter(|cells| cells[0] == target);
    of_target
        .map(|cells| (cells[1], cells[2].parse().unwrap(), cells[3].parse().unwrap()))
        .collect()
}

fn check<T: Target<N>, const N: usize, const D: usize>(posterior: Result<ModelPosterior<T, N, D>, TargetError>) {
    let posterior = posterior.unwrap();
    conforming(&posterior);
    moments_are_those_of_the_draws(&posterior);
    extremes_are_survived(&posterior);
}

/// Means within four standard errors, standard deviations within 4 % (four standard errors of those, 1/√(2·5000)).
fn moments_are_those_of_the_draws<T: Target<N>, const N: usize, const D: usize>(posterior: &ModelPosterior<T, N, D>) {
    let options = ReferenceOptions {
        points: 1 << 15,
        ..ReferenceOptions::default()
    };
    let sample = ImportanceSample::new(posterior, &options).unwrap().into_draws();
    let share = sample.effective_sample_size() / options.points as f64;
    assert!(share > 0.5, "{}: effective share {share}", posterior.name());
    let xs = posterior.constraints().constrain_all(&sample.points);
    let expectation = |of: &dyn Fn(&[f64; N]) -> f64| -> f64 {
        xs.iter().zip(&sample.weights).map(|(x, weight)| weight * of(x)).sum()
    };
    let known = reference(posterior.name());
    assert_eq!(known.len(), D);
    for (k, (parameter, mean, deviation)) in known.into_iter().enumerate() {
        let found = expectation(&|x| x[k]);
        let spread = expectation(&|x| (x[k] - found).powi(2)).sqrt();
        let (shift, ratio) = ((found - mean) / deviation, spread / deviation);
        assert!(
            shift.abs() < 4.0 * STANDARD_ERROR,
            "{} {parameter}: {shift}",
            posterior.name()
        );
        assert!((ratio - 1.0).abs() < 0.04, "{} {parameter}: {ratio}", posterior.name());
    }
}

/// No panic anywhere, and numbers wherever the coordinates are.
fn extremes_are_survived<const D: usize>(target: &dyn CatalogueTarget<D>) {
    let values = [0.0, 1.0, -3.0, 30.0, -1e3, 1e3, 1e100, 1e300, -1e300];
    for index in 0..values.len().pow(4) {
        // The digits of a number that runs through all combinations in an even order.
        let mut digits = index.wrapping_mul(2_654_435_761) >> 3;
        let y: [f64; D] = std::array::from_fn(|_| {
            let digit = digits % values.len();
            digits /= values.len();
            values[digit]
        });
        let all = target.score(&y).into_iter().chain([target.log_density(&y)]);
        for value in all {
            assert!(value.is_finite(), "{} at {y:?}: {value}", target.name());
        }
    }
    for axis in 0..D {
        let mut y = *target.frame().centre();
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            y[axis] = value;
            let density = target.log_density(&y);
            assert!(density.is_nan() || density <= f64::MIN, "{} at {y:?}", target.name());
            target.score(&y);
        }
    }
}

#[test]
fn linear_models() {
    check(LinearModel::kidscore());
    check(LinearModel::mesquite());
    check(LinearModel::blr());
}

#[test]
fn series_in_time() {
    check(Arma::posterior());
    check(Garch::posterior());
    check(HiddenMarkov::posterior());
}

#[test]
fn a_process_a_mixture_and_an_equation() {
    check(GaussianProcess::posterior());
    check(NormalMixture::posterior());
    check(LotkaVolterra::posterior());
}

#[test]
fn coordinates_are_named_after_the_parameters() {
    for name in catalogue()
        .iter()
        .map(|info| info.name)
        .filter(|name| REFERENCE.contains(&format!("\n{name},")))
    {
        let names = coordinate_names(name, None, &Default::default()).unwrap().unwrap();
        let parameters = reference(name);
        assert_eq!(names.len(), parameters.len());
        for (name, (parameter, ..)) in names.iter().zip(parameters) {
            assert!(name.contains(parameter), "{name} for {parameter}");
        }
    }
}
