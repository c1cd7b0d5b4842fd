//! Tempered sequential Monte Carlo.

use parvi::{Method, Run, SampleError, Samples, Silent, SmcOptions, Start, sample};
use parvi_targets::{Banana, CatalogueTarget, Frame, Gaussian, GaussianMixture, Target};

use crate::support::on_threads;

fn sampled<const D: usize>(target: &dyn CatalogueTarget<D>, particles: usize, seed: u64) -> Samples<D> {
    let method = Method::Smc(SmcOptions::default());
    sample(target, &method, &Run::new(particles, seed), &mut Silent).expect("particles")
}

#[test]
fn evidence_is_within_its_error() {
    fn check<const D: usize>(target: &dyn CatalogueTarget<D>, largest_error: f64) {
        let exact = target.log_evidence().expect("a known evidence");
        let mut far = 0;
        for seed in 0..8 {
            let samples = sampled(target, 500, seed);
            let found = samples.log_evidence.expect("evidence");
            let error = samples.log_evidence_error.expect("an error");
            assert!(error > 0.0 && error < largest_error, "{}: {error}", target.name());
            // Seven degrees of freedom: beyond 3 in 2 % of the runs, beyond 8 in 1e-4.
            assert!(
                (found - exact).abs() < 8.0 * error,
                "{}: {found} ± {error}",
                target.name()
            );
            far += usize::from((found - exact).abs() > 3.0 * error);
        }
        assert!(far <= 1, "{}: {far} of 8 beyond three errors", target.name());
    }
    check(&Gaussian::<1>::standard(), 0.1);
    check(&Gaussian::<5>::standard(), 0.2);
    check(&Banana::new(1.0, 0.5).expect("a banana"), 0.2);
    check(&GaussianMixture::<2>::three_far().expect("a mixture"), 0.3);
}

#[test]
fn modes_far_apart_keep_their_masses() {
    let target = GaussianMixture::<2>::three_far().expect("a mixture");
    let modes = target.modes();
    for seed in 0..3 {
        let samples = sampled(&target, 2000, seed);
        let nearest = |x: &[f64; 2]| {
            let apart = |k: &usize| (x[0] - modes[*k].centre[0]).hypot(x[1] - modes[*k].centre[1]);
            (0..modes.len())
                .min_by(|a, b| apart(a).total_cmp(&apart(b)))
                .expect("modes")
        };
        for (k, mode) in modes.iter().enumerate() {
            let found = samples.positions.iter().filter(|x| nearest(x) == k).count() as f64 / 2000.0;
            assert!((found - mode.mass).abs() < 0.05, "mode {k}: {found} for {}", mode.mass);
        }
    }
}

/// N(0, I) on the half plane x₀ ≥ −1, with −∞, NaN, +∞ and scores that are none beyond.
struct Broken;

impl Target<2> for Broken {
    fn log_density(&self, x: &[f64; 2]) -> f64 {
        match x[0] {
            c if c < -3.0 => f64::INFINITY,
            c if c < -2.0 => f64::NAN,
            c if c < -1.0 => f64::NEG_INFINITY,
            _ => -0.5 * (x[0] * x[0] + x[1] * x[1]),
        }
    }

    fn score(&self, x: &[f64; 2]) -> [f64; 2] {
        if x[1].abs() > 1.0 {
            [f64::NAN; 2]
        } else {
            [-x[0], -x[1]]
        }
    }
}

#[test]
fn log_densities_and_scores_that_are_no_numbers_are_survived() {
    let options = SmcOptions::default();
    let samples = options.sample(&Broken, &Frame::identity(), &Run::new(1000, 1), &mut Silent);
    let samples = samples.expect("particles");
    assert!(samples.positions.iter().all(|x| x[0] >= -1.0));
    // 2π Φ(1).
    let exact = (std::f64::consts::TAU * 0.841_344_746).ln();
    let found = samples.log_evidence.expect("evidence");
    assert!((found - exact).abs() < 0.1, "{found} for {exact}");
}

/// N(0, I/q).
struct Precision(f64);

impl Target<2> for Precision {
    fn log_density(&self, x: &[f64; 2]) -> f64 {
        -0.5 * self.0 * (x[0] * x[0] + x[1] * x[1])
    }

    fn score(&self, x: &[f64; 2]) -> [f64; 2] {
        [-x[0] * self.0, -x[1] * self.0]
    }
}

#[test]
fn what_is_nowhere_finite_is_an_error_and_what_is_huge_is_not() {
    let options = SmcOptions::default();
    let run = Run::new(100, 1);
    let nowhere = options.sample(&Precision(f64::NAN), &Frame::identity(), &run, &mut Silent);
    assert!(matches!(nowhere, Err(SampleError::Pool(_))), "{nowhere:?}");
    let samples = options.sample(&Precision(1e100), &Frame::identity(), &run, &mut Silent);
    assert!(samples.is_ok_and(|samples| samples.positions.as_flattened().iter().all(|c| c.abs() < 1e-40)));
}

#[test]
fn bad_options_are_errors_that_name_them() {
    let target = Gaussian::<2>::standard();
    let refused = |options: SmcOptions, start: Start| {
        let mut run = Run::new(100, 1);
        run.start = start;
        let sampled = options.sample(&target, &Frame::identity(), &run, &mut Silent);
        sampled.expect_err("refused").to_string()
    };
    let default = SmcOptions::default();
    let wrong = [
        (
            SmcOptions {
                pool_size: Some(99),
                ..default
            },
            "pool size",
        ),
        (
            SmcOptions {
                populations: 1,
                ..default
            },
            "populations",
        ),
        (
            SmcOptions {
                chain_length: 1,
                ..default
            },
            "chain length",
        ),
        (
            SmcOptions {
                chain_length: usize::MAX,
                ..default
            },
            "chain length",
        ),
    ];
    for (options, name) in wrong {
        let error = refused(options, Start::default());
        assert!(error.contains(name), "{error}");
    }
    let start = Start {
        standard_deviation: 0.0,
        ..Start::default()
    };
    assert!(refused(default, start).contains("start standard deviation"));
}

#[test]
fn same_seed_same_bits_on_any_number_of_threads() {
    let target = Banana::new(1.0, 0.5).expect("a banana");
    let on = |threads: usize, seed: u64| {
        let samples = on_threads(threads, || sampled(&target, 200, seed));
        (samples.positions, samples.log_evidence.map(f64::to_bits))
    };
    let one = on(1, 3);
    assert!(one == on(2, 3) && one == on(3, 3));
    assert!(one != on(1, 4));
}
