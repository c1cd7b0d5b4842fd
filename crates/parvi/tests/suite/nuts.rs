//! The No-U-Turn sampler as a method: moments, determinism, counts and errors.

use std::cell::Cell;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU64, Ordering};

use parvi::{
    Method, NutsOptions, Observer, Progress, Run, SampleError, SampleSource, Samples, Silent, SteinThinningOptions,
    sample,
};
use parvi_targets::{Banana, CatalogueTarget, Frame, Funnel, Gaussian, Target};

use crate::support::{StopAfter, assert_correlated, on_threads};

fn nuts<const D: usize>(target: &dyn CatalogueTarget<D>, options: NutsOptions, run: &Run) -> Samples<D> {
    sample(target, &Method::Nuts(options), run, &mut Silent).expect("samples")
}

fn options(warm_up: usize, chains: usize) -> NutsOptions {
    NutsOptions {
        warm_up,
        chains,
        ..NutsOptions::default()
    }
}

#[test]
fn the_moments_of_a_gaussian() {
    let target = Gaussian::<2>::autoregressive(0.8).expect("a correlation below one");
    let stein = SteinThinningOptions {
        pool: SampleSource::Nuts(NutsOptions::default()),
        pool_size: Some(8000),
    };
    let thinned = NutsOptions {
        thinning: 3,
        ..NutsOptions::default()
    };
    let methods = [
        (Method::Nuts(NutsOptions::default()), 4000, 0.1),
        (Method::Nuts(thinned), 4000, 0.1),
        (Method::SteinThinning(stein), 200, 0.15),
    ];
    for (method, particles, tolerance) in methods {
        let samples = sample(&target, &method, &Run::new(particles, 4), &mut Silent).expect("samples");
        assert_eq!(samples.positions.len(), particles);
        assert_correlated(&samples.positions, 0.8, tolerance, &method);
    }
}

#[test]
fn same_seed_same_bits_on_any_number_of_threads() {
    let options = options(100, 5);
    let draw = |threads: usize, seed: u64| {
        on_threads(threads, || {
            nuts(&Banana::default(), options.clone(), &Run::new(203, seed))
        })
    };
    let samples = draw(1, 3);
    assert_eq!(samples.positions.len(), 203);
    for threads in [1, 2, 4] {
        let again = draw(threads, 3);
        assert_eq!(samples.positions, again.positions);
        assert_eq!(samples.score_evaluations, again.score_evaluations);
        assert_eq!(samples.divergences, again.divergences);
    }
    assert_ne!(samples.positions, draw(1, 4).positions);
}

/// N(0, I) that counts its scores.
struct Counted(AtomicU64);

impl Target<2> for Counted {
    fn log_density(&self, x: &[f64; 2]) -> f64 {
        -0.5 * (x[0] * x[0] + x[1] * x[1])
    }

    fn score(&self, x: &[f64; 2]) -> [f64; 2] {
        self.0.fetch_add(1, Ordering::Relaxed);
        x.map(|c| -c)
    }
}

#[test]
fn every_gradient_is_counted() {
    let target = Counted(AtomicU64::new(0));
    for (warm_up, chains, thinning) in [(50, 2, 1), (0, 1, 2), (10, 3, 4)] {
        target.0.store(0, Ordering::Relaxed);
        let options = NutsOptions {
            thinning,
            ..options(warm_up, chains)
        };
        let samples = options
            .sample(&target, &Frame::identity(), &Run::new(31, 8), &mut Silent)
            .expect("samples");
        assert_eq!(samples.positions.len(), 31);
        assert_eq!(samples.steps, chains * warm_up + 31 * thinning);
        assert_eq!(samples.score_evaluations, target.0.load(Ordering::Relaxed));
        assert!(samples.score_evaluations >= samples.steps as u64);
    }
}

#[test]
fn no_more_chains_than_draws() {
    let samples = nuts(&Gaussian::<2>::standard(), options(20, 100), &Run::new(3, 1));
    assert_eq!(samples.positions.len(), 3);
    assert_eq!(samples.steps, 3 * 20 + 3);
}

#[test]
fn divergences_are_counted_and_no_failure() {
    let options = NutsOptions {
        warm_up: 200,
        target_acceptance: 0.5,
        ..NutsOptions::default()
    };
    let samples = nuts(&Funnel::<4>::new(3.0).expect("a width"), options, &Run::new(2000, 2));
    assert!(samples.divergences.expect("a count") > 0);
    assert_eq!(samples.positions.len(), 2000);
}

/// Finite only where x > 0; the score is a number everywhere unless `score` is set.
struct Half {
    score: f64,
}

impl Target<1> for Half {
    fn log_density(&self, x: &[f64; 1]) -> f64 {
        if x[0] > 0.0 { -x[0] } else { f64::NEG_INFINITY }
    }

    fn score(&self, _x: &[f64; 1]) -> [f64; 1] {
        [self.score]
    }
}

#[test]
fn a_start_that_is_not_finite_is_an_error_with_its_place() {
    let options = NutsOptions::default();
    let draw = |score: f64, mean: f64| {
        let frame = Frame::from_scales([mean], [0.1]).expect("a frame");
        options.sample(&Half { score }, &frame, &Run::new(100, 1), &mut Silent)
    };
    match draw(f64::NAN, 5.0) {
        Err(SampleError::ScoreNotFinite { step: 0, position, .. }) => assert!((position[0] - 5.0).abs() < 1.0),
        other => panic!("{other:?}"),
    }
    match draw(-1.0, -5.0) {
        Err(SampleError::StartNotFinite { position, value }) => {
            assert!((position[0] + 5.0).abs() < 1.0);
            assert_eq!(value, f64::NEG_INFINITY);
        }
        other => panic!("{other:?}"),
    }
    // A wall that trajectories run into is a divergence.
    let samples = draw(-1.0, 3.0).expect("samples");
    assert!(samples.positions.iter().all(|x| x[0] > 0.0));
    assert!(samples.divergences.expect("a count") > 0);
}

#[test]
fn options_out_of_range_are_named() {
    let default = NutsOptions::default;
    let options = [
        (NutsOptions { chains: 0, ..default() }, "chains"),
        (
            NutsOptions {
                thinning: 0,
                ..default()
            },
            "thinning",
        ),
        (
            NutsOptions {
                target_acceptance: 1.0,
                ..default()
            },
            "target acceptance",
        ),
        (
            NutsOptions {
                target_acceptance: f64::NAN,
                ..default()
            },
            "target acceptance",
        ),
        (
            NutsOptions {
                thinning: usize::MAX,
                ..default()
            },
            "draws of all chains",
        ),
    ];
    for (options, name) in options {
        let method = Method::Nuts(options);
        match sample(&Gaussian::<2>::standard(), &method, &Run::new(10, 1), &mut Silent) {
            Err(SampleError::InvalidOption { field, .. }) => assert_eq!(field, name),
            other => panic!("{name}: {other:?}"),
        }
    }
}

/// Counts the calls and stops at one of them.
struct StopAt<'a>(usize, &'a Cell<usize>);

impl Observer for StopAt<'_> {
    fn after_step(&mut self, progress: Progress) -> ControlFlow<()> {
        self.1.set(self.1.get() + 1);
        assert_eq!(self.1.get(), progress.step);
        StopAfter(self.0).after_step(progress)
    }
}

#[test]
fn the_observer_sees_every_draw_and_stops() {
    let options = NutsOptions {
        warm_up: 10,
        ..NutsOptions::default()
    };
    let (target, method, calls) = (Gaussian::<2>::standard(), Method::Nuts(options), Cell::new(0));
    sample(&target, &method, &Run::new(100, 1), &mut StopAt(usize::MAX, &calls)).expect("samples");
    assert_eq!(calls.get(), 140);
    calls.set(0);
    let error = sample(&target, &method, &Run::new(100, 1), &mut StopAt(40, &calls)).expect_err("a stop");
    assert_eq!(error, SampleError::Interrupted { step: 40 });
    assert_eq!(calls.get(), 40);
}
