//! Support points: their energy distance falls, ends far below that of independent draws, and they are a method.

use mpm_tensor::Matrix;
use parvi::{
    Method, PointSetError, Run, SampleError, Silent, SupportPointsOptions, independent_draws, sample, sample_in,
    support_points,
};
use parvi_metrics::{Cloud, GaussianEnergy, energy_distance_squared};
use parvi_targets::{Banana, CatalogueTarget, Frame, Gaussian};

use crate::support::{StopAfter, moments, on_threads};

fn draws<const D: usize>(count: usize, seed: u64) -> Vec<[f64; D]> {
    let target = Gaussian::<D>::standard();
    independent_draws(&target, &Run::new(count, seed))
        .expect("draws")
        .positions
}

fn energy<const D: usize>(points: &[[f64; D]], sample: &[[f64; D]]) -> f64 {
    let (points, sample) = (Cloud::new(points).expect("finite"), Cloud::new(sample).expect("finite"));
    energy_distance_squared(&points, &sample).expect("ED²")
}

/// From `start` the energy distance to the sample falls in every iteration, at last below `share` of its beginning.
fn assert_falling<const D: usize>(sample: &[[f64; D]], start: &[[f64; D]], share: f64) {
    let first = energy(start, sample);
    let (mut points, mut last) = (start.to_vec(), first);
    for iteration in 1..=60 {
        points = support_points(sample, &points, 1, 0.0).expect("points").positions;
        let next = energy(&points, sample);
        // Up to the rounding of sums of order one.
        assert!(next <= last + 1e-14, "D = {D}, iteration {iteration}: {last} to {next}");
        last = next;
    }
    assert!(last < share * first, "D = {D}: {first} to {last}");
}

#[test]
fn the_energy_distance_never_rises() {
    assert_falling::<1>(&draws(2000, 1), &draws(40, 2), 0.05);
    assert_falling::<2>(&draws(2000, 1), &draws(40, 2), 0.15);
    assert_falling::<4>(&draws(1500, 1), &draws(30, 2), 0.3);
    // From points of the sample itself.
    let sample = draws::<2>(2001, 3);
    assert_falling(&sample, &sample[..40], 0.15);
}

#[test]
fn support_points_are_far_better_than_independent_draws() {
    let method = Method::SupportPoints(SupportPointsOptions::default());
    let run = Run::new(100, 7);
    let squared = |method: &Method| {
        let samples = sample(&Gaussian::<2>::standard(), method, &run, &mut Silent).expect("samples");
        let energy = GaussianEnergy::<2>::standard().expect("a Gaussian");
        energy
            .squared(&Cloud::new(&samples.positions).expect("finite"))
            .expect("ED²")
    };
    // Independent draws: 1.772 / 100 on average.
    let reached = squared(&method);
    assert!(reached < 0.15 * 1.772 / 100.0, "{reached}");
    assert!(reached < 0.3 * squared(&Method::Iid));
}

#[test]
fn the_method_is_the_function_in_the_frame_s_units() {
    let target = Gaussian::<2>::autoregressive(0.9).expect("a correlation below one");
    let samples = sample(
        &target,
        &Method::SupportPoints(SupportPointsOptions::default()),
        &Run::new(200, 3),
        &mut Silent,
    )
    .expect("samples");
    assert_eq!(samples.score_evaluations, 0);
    assert!(samples.steps > 5);
    let moments = moments(&samples.positions);
    for a in 0..2 {
        assert!(moments.mean[a].abs() < 0.03, "{:?}", moments.mean);
        assert!(
            (moments.covariance.0[a][a] - 1.0).abs() < 0.06,
            "{:?}",
            moments.covariance
        );
    }
    assert!(
        (moments.covariance.0[0][1] - 0.9).abs() < 0.06,
        "{:?}",
        moments.covariance
    );
}

#[test]
fn a_frame_that_is_given_replaces_that_of_the_target() {
    let target = Gaussian::new([0.0; 2], Matrix::diagonal(&[1.0, 100.0])).expect("a covariance");
    let method = Method::SupportPoints(SupportPointsOptions::default());
    let run = Run::new(20, 3);
    let within = |frame: &Frame<2>| {
        let samples = sample_in(&target, frame, &method, &run, &mut Silent);
        samples.expect("samples").positions
    };
    let samples = sample(&target, &method, &run, &mut Silent).expect("samples");
    assert_eq!(within(&target.frame()), samples.positions);
    assert_ne!(within(&Frame::identity()), samples.positions);
}

#[test]
fn same_bits_on_any_number_of_threads() {
    let options = SupportPointsOptions {
        steps: Some(10),
        ..SupportPointsOptions::default()
    };
    let place = |threads: usize| {
        let method = Method::SupportPoints(options.clone());
        let samples = on_threads(threads, || {
            sample(&Banana::default(), &method, &Run::new(64, 9), &mut Silent)
        });
        samples.expect("samples").positions
    };
    let positions = place(1);
    assert_eq!(positions, place(2));
    assert_eq!(positions, place(5));
}

#[test]
fn iterations_end_at_the_tolerance_or_at_the_limit() {
    let sample = draws::<2>(1000, 1);
    let start = draws::<2>(10, 2);
    let limited = support_points(&sample, &start, 3, 0.0).expect("points");
    assert_eq!(limited.iterations, 3);
    let rested = support_points(&sample, &start, 100_000, 1e-6).expect("points");
    assert!(rested.iterations < 100_000 && rested.displacement <= 1e-6);
    let untouched = support_points(&sample, &start, 0, 0.0).expect("points");
    assert_eq!(untouched.positions, start);
}

#[test]
fn the_unit_of_the_sample_is_that_of_the_points() {
    let (sample, start) = (draws::<2>(500, 1), draws::<2>(10, 2));
    let plain = support_points(&sample, &start, 20, 0.0).expect("points").positions;
    for exponent in [-700, 400] {
        let unit = 2f64.powi(exponent);
        let scaled = |points: &[[f64; 2]]| points.iter().map(|x| x.map(|c| unit * c)).collect::<Vec<_>>();
        let moved = support_points(&scaled(&sample), &scaled(&start), 20, 0.0).expect("points");
        assert_eq!(moved.positions, scaled(&plain), "{exponent}");
    }
}

#[test]
fn bad_input_is_named() {
    let points = [[0.0, 1.0], [1.0, 3.0]];
    let error = support_points::<2>(&[], &points, 1, 0.0).expect_err("no sample");
    assert_eq!(error, PointSetError::Empty { field: "the sample" });
    let error = support_points::<2>(&points, &[], 1, 0.0).expect_err("no points");
    assert_eq!(error, PointSetError::Empty { field: "the start" });
    let error = support_points(&points, &[[f64::INFINITY, 0.0]], 1, 0.0).expect_err("infinity");
    assert_eq!(error.to_string(), "start 0 is [inf, 0.0]: too large or not finite");
    let error = support_points(&points, &points, 1, -1.0).expect_err("a negative tolerance");
    assert_eq!(error, PointSetError::Tolerance { value: -1.0 });
    // A sample of one point only: everything goes there.
    let gathered = support_points(&[[1.0, 2.0]; 3], &[[0.0, 0.0]], 5, 0.0).expect("a point");
    assert!((gathered.positions[0][0] - 1.0).abs() < 1e-12);
}

#[test]
fn the_observer_stops_and_lacking_draws_are_said() {
    let method = Method::SupportPoints(SupportPointsOptions::default());
    let error = sample(&Gaussian::<2>::standard(), &method, &Run::new(50, 1), &mut StopAfter(4)).expect_err("a stop");
    assert_eq!(error, SampleError::Interrupted { step: 4 });
    let target = parvi_targets::build::<2>("wells-small", &Default::default()).expect("a target");
    let error = sample(target.as_ref(), &method, &Run::new(50, 1), &mut Silent).expect_err("no draws");
    assert!(
        error.to_string().contains("`support-points` needs exact draws"),
        "{error}"
    );
}
