//! Runs that go on where an earlier process ended.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

use parvi_pool::{Beginning, Observer, PoolError, PoolOptions, explore};
use parvi_targets::{Banana, Frame, Target};

#[test]
fn a_run_goes_on_from_its_tape_to_the_same_bits() {
    /// A target that counts what it is asked.
    struct Counted(Banana, AtomicUsize);
    impl Target<2> for Counted {
        fn log_density(&self, x: &[f64; 2]) -> f64 {
            self.1.fetch_add(1, Ordering::Relaxed);
            self.0.log_density(x)
        }
        fn score(&self, x: &[f64; 2]) -> [f64; 2] {
            self.1.fetch_add(1, Ordering::Relaxed);
            self.0.score(x)
        }
    }
    let target = Counted(Banana::new(1.0, 0.5).unwrap(), AtomicUsize::new(0));
    let run = |tape: Vec<f64>, observer: &mut Observer<'_>| {
        target.1.store(0, Ordering::Relaxed);
        let options = PoolOptions::default();
        let frame = Frame::identity();
        let beginning = Beginning::in_frame(&frame).with_seed(3).with_tape(tape);
        let pool = explore(&target, beginning, 100, &options, observer);
        (pool, target.1.load(Ordering::Relaxed))
    };
    let (whole, asked) = run(Vec::new(), &mut |_| ControlFlow::Continue(()));
    let mut kept = Vec::new();
    let (killed, _) = run(Vec::new(), &mut |report| {
        kept = report.tape.to_vec();
        if report.round.is_some() {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    });
    assert_eq!(killed.err(), Some(PoolError::Interrupted { round: 1 }));
    // A process may also die in the middle of writing.
    for length in [kept.len(), kept.len() - 1, 31, 0] {
        let (resumed, asked_again) = run(kept[..length].to_vec(), &mut |_| ControlFlow::Continue(()));
        let (whole, resumed) = (whole.as_ref().unwrap(), resumed.unwrap());
        assert_eq!(whole.weights, resumed.weights);
        assert_eq!(whole.verdict, resumed.verdict);
        // Of a short tape every point is evaluated again.
        assert!(asked_again <= asked, "{length}: {asked_again} {asked}");
    }
    let (all, asked_again) = run(kept.clone(), &mut |_| ControlFlow::Continue(()));
    assert_eq!(all.unwrap().positions, whole.unwrap().positions);
    assert!(asked - asked_again > 250, "{asked} {asked_again}");
}

/// Log densities that take a while each.
struct Dear(Banana, AtomicUsize);

impl Target<2> for Dear {
    fn log_density(&self, x: &[f64; 2]) -> f64 {
        std::thread::sleep(std::time::Duration::from_micros(300));
        self.1.fetch_add(1, Ordering::Relaxed);
        self.0.log_density(x)
    }
    fn score(&self, x: &[f64; 2]) -> [f64; 2] {
        self.0.score(x)
    }
    fn points_per_call(&self) -> usize {
        1
    }
}

#[test]
fn a_dear_density_is_stopped_between_rounds_and_hardly_anything_is_evaluated_twice() {
    let target = Dear(Banana::new(1.0, 0.5).unwrap(), AtomicUsize::new(0));
    let options = PoolOptions {
        effective_size: 1.0,
        evaluations: Some(2_000),
        ..PoolOptions::default()
    };
    let run = |tape: Vec<f64>, observer: &mut Observer<'_>| {
        target.1.store(0, Ordering::Relaxed);
        let frame = Frame::identity();
        let beginning = Beginning::in_frame(&frame).with_seed(3).with_tape(tape);
        let pool = explore(&target, beginning, 20, &options, observer);
        (pool, target.1.load(Ordering::Relaxed))
    };
    let (whole, asked) = run(Vec::new(), &mut |_| ControlFlow::Continue(()));
    let whole = whole.unwrap();
    for stop in [1, asked as u64 / 2] {
        let mut kept = Vec::new();
        let mut told = 0;
        let (stopped, before) = run(Vec::new(), &mut |report| {
            assert!(report.evaluations <= report.limit && told <= report.evaluations);
            (kept, told) = (report.tape.to_vec(), report.evaluations);
            if report.evaluations >= stop {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        });
        assert!(matches!(stopped, Err(PoolError::Interrupted { .. })), "{stop}");
        let (resumed, after) = run(kept, &mut |_| ControlFlow::Continue(()));
        // Some of what was on the tape, to know whose it is.
        assert!((asked..=asked + 32).contains(&(before + after)), "{stop}");
        assert_eq!(resumed.unwrap().weights, whole.weights, "{stop}");
    }
}

/// N(0, I) with edges at ±`edge` along x₀, and a score times `slope` where x₀ > 1.
struct Altered {
    edge: f64,
    slope: f64,
}

impl Target<2> for Altered {
    fn log_density(&self, x: &[f64; 2]) -> f64 {
        if x[0].abs() < self.edge {
            -0.5 * (x[0] * x[0] + x[1] * x[1])
        } else {
            f64::NEG_INFINITY
        }
    }
    fn score(&self, x: &[f64; 2]) -> [f64; 2] {
        x.map(|c| if x[0] > 1.0 { -self.slope * c } else { -c })
    }
}

#[test]
fn a_tape_of_another_target_is_refused() {
    let run = |edge, slope, tape: Vec<f64>, stop: usize| {
        let (mut kept, target) = (Vec::new(), Altered { edge, slope });
        let options = PoolOptions::default();
        let frame = Frame::identity();
        let found = explore(
            &target,
            Beginning::in_frame(&frame).with_seed(3).with_tape(tape),
            100,
            &options,
            &mut |report| {
                kept = report.tape.to_vec();
                match report.round {
                    Some(round) if round.number == stop => ControlFlow::Break(()),
                    _ => ControlFlow::Continue(()),
                }
            },
        );
        (found.map(|pool| pool.weights), kept)
    };
    // Of a run that was stopped, and nearly all of one that was not.
    for stop in [1, usize::MAX] {
        let (_, tape) = run(5.0, 1.0, Vec::new(), stop);
        assert!(run(5.0, 1.0, tape.clone(), usize::MAX).0.is_ok());
        for (edge, slope) in [(1.1, 1.0), (5.0, -1.0), (5.0, 1.0 + 1e-15)] {
            let (refused, _) = run(edge, slope, tape.clone(), usize::MAX);
            assert_eq!(refused, Err(PoolError::AnotherTape), "{edge} {slope}");
        }
    }
}
