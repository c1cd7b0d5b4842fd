//! Runs that go on where an earlier process ended.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

use parvi_pool::{Observer, PoolError, PoolOptions, explore};
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
        let pool = explore(&target, &Frame::identity(), &[], tape, 100, 3, &options, observer);
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
        assert!(length == 0 || asked_again < asked);
    }
    let (all, asked_again) = run(kept.clone(), &mut |_| ControlFlow::Continue(()));
    assert_eq!(all.unwrap().positions, whole.unwrap().positions);
    assert!(asked - asked_again > 300, "{asked} {asked_again}");
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
fn a_dear_density_is_stopped_between_rounds_and_nothing_is_evaluated_twice() {
    let target = Dear(Banana::new(1.0, 0.5).unwrap(), AtomicUsize::new(0));
    let options = PoolOptions {
        effective_size: 1.0,
        evaluations: Some(2_000),
        ..PoolOptions::default()
    };
    let run = |tape: Vec<f64>, observer: &mut Observer<'_>| {
        target.1.store(0, Ordering::Relaxed);
        let pool = explore(&target, &Frame::identity(), &[], tape, 20, 3, &options, observer);
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
        assert_eq!(before + after, asked, "{stop}");
        assert_eq!(resumed.unwrap().weights, whole.weights, "{stop}");
    }
}
