//! Scores that are evaluated at nodes and interpolated, and targets of which only the score is known.

use std::sync::atomic::{AtomicU64, Ordering};

use parvi::{
    AisOptions, Checkpoint, Monitor, MpmOptions, PaperOptions, Run, SampleError, Samples, ScoreLocation, Silent, Watch,
};
use parvi_targets::{CatalogueTarget, Frame, Gaussian, Ring, ScoreOnly, Target, build};

use crate::robustness::Killer;
use crate::support::{Walled, body_alone, on_threads};

/// Counts what is evaluated.
struct Counted<'a, const D: usize> {
    target: &'a dyn Target<D>,
    scores: AtomicU64,
}

impl<'a, const D: usize> Counted<'a, D> {
    fn new(target: &'a dyn Target<D>) -> Self {
        Self {
            target,
            scores: AtomicU64::new(0),
        }
    }
}

impl<const D: usize> Target<D> for Counted<'_, D> {
    fn log_density(&self, x: &[f64; D]) -> f64 {
        self.target.log_density(x)
    }

    fn score(&self, x: &[f64; D]) -> [f64; D] {
        self.scores.fetch_add(1, Ordering::Relaxed);
        self.target.score(x)
    }
}

fn cached() -> MpmOptions {
    MpmOptions {
        score_location: ScoreLocation::Cached,
        ..MpmOptions::default()
    }
}

fn ring(particles: usize) -> (Ring, Frame<2>, Run) {
    let target = Ring::new(2.0, 0.25).expect("a ring");
    let frame = CatalogueTarget::frame(&target);
    (target, frame, Run::new(particles, 3))
}

fn moments<const D: usize>(positions: &[[f64; D]]) -> ([f64; D], [f64; D]) {
    let count = positions.len() as f64;
    let mean: [f64; D] = std::array::from_fn(|a| positions.iter().map(|x| x[a]).sum::<f64>() / count);
    let deviation = |a: usize| (positions.iter().map(|x| (x[a] - mean[a]).powi(2)).sum::<f64>() / count).sqrt();
    (mean, std::array::from_fn(deviation))
}

#[test]
fn nodes_without_a_score_are_counted() {
    let sample = |target: &dyn Target<2>| {
        cached()
            .sample(target, &Frame::identity(), &Run::new(200, 3), &mut Silent)
            .expect("particles")
    };
    assert!(sample(&Walled).scores_replaced > 0);
    assert_eq!(sample(&Gaussian::<2>::standard()).scores_replaced, 0);
}

#[test]
fn a_posterior_takes_a_node_for_many_particles() {
    let target = build::<3>("wells", &Default::default()).expect("a target");
    let (frame, run) = (target.frame(), Run::new(1500, 3));
    let counted = Counted::new(&*target);
    let samples = cached().sample(&counted, &frame, &run, &mut Silent).expect("particles");
    assert_eq!(samples.score_evaluations, counted.scores.load(Ordering::Relaxed));
    assert!(samples.score_evaluations < 1000, "{}", samples.score_evaluations);
    assert!(samples.score_disagreement.is_some_and(|difference| difference < 1e-3));
    let fresh = body_alone()
        .sample(&*target, &frame, &run, &mut Silent)
        .expect("particles");
    let ((mean, deviation), (expected_mean, expected)) = (moments(&samples.positions), moments(&fresh.positions));
    for axis in 0..3 {
        assert!((mean[axis] - expected_mean[axis]).abs() < 1e-3 * expected[axis]);
        assert!((deviation[axis] / expected[axis] - 1.0).abs() < 2e-3);
    }
}

#[test]
fn cells_are_halved_where_fresh_scores_disagree() {
    let (target, frame, run) = ring(2000);
    let coarse = MpmOptions {
        evaluations: Some(0),
        ..cached()
    };
    let coarse = coarse.sample(&target, &frame, &run, &mut Silent).expect("particles");
    let fine = cached().sample(&target, &frame, &run, &mut Silent).expect("particles");
    let disagreement = |samples: &Samples<2>| samples.score_disagreement.expect("a difference");
    assert!(disagreement(&fine) < 0.2 * disagreement(&coarse));
    assert!(fine.score_evaluations > coarse.score_evaluations);
    let (mean, _) = moments(&fine.positions);
    assert!(mean.iter().all(|c| c.abs() < 0.02), "{mean:?}");
}

#[test]
fn a_score_without_a_log_density_moves_a_body_and_no_more() {
    let normal = ScoreOnly(|x: &[f64; 2]| x.map(|c| -c));
    let (frame, run) = (Frame::identity(), Run::new(500, 1));
    let unsurveyed = MpmOptions {
        trace_every: 50,
        ..body_alone()
    };
    let defaults = MpmOptions {
        survey: true,
        ..unsurveyed.clone()
    };
    let expected = unsurveyed.sample(&Gaussian::<2>::standard(), &frame, &run, &mut Silent);
    let samples = defaults.sample(&normal, &frame, &run, &mut Silent).expect("particles");
    assert_eq!(samples.positions, expected.expect("particles").positions);
    assert!(samples.trace.iter().all(|point| point.potential_energy.is_none()));
    assert_eq!(samples.density_evaluations, 0);
    assert!(cached().sample(&normal, &frame, &run, &mut Silent).is_ok());
    let refused = AisOptions::default().sample(&normal, &frame, &run, &mut Silent);
    assert!(matches!(refused, Err(SampleError::ScoreOnly { .. })));
    let watching = PaperOptions {
        watch: Some(Watch {
            monitor: Monitor::LogDensity,
            ..Watch::default()
        }),
        ..PaperOptions::default()
    };
    let refused = watching.sample(&normal, &frame, &run, &mut Silent);
    assert!(matches!(refused, Err(SampleError::ScoreOnly { .. })));
}

#[test]
fn what_has_no_cache_says_so() {
    let run = Run::new(100, 1);
    let paper = PaperOptions {
        score_location: ScoreLocation::Cached,
        ..PaperOptions::default()
    };
    let refused = paper.sample(&Gaussian::<2>::standard(), &Frame::identity(), &run, &mut Silent);
    assert!(matches!(refused, Err(SampleError::NotTaken { .. })));
    let refused = cached().sample(&Gaussian::<6>::standard(), &Frame::identity(), &run, &mut Silent);
    assert!(matches!(
        refused,
        Err(SampleError::InvalidOption {
            field: "dimensions of cached scores",
            ..
        })
    ));
}

#[test]
fn a_stopped_run_goes_on_with_the_nodes_it_knows_to_the_same_bits_on_any_number_of_threads() {
    let (target, frame, run) = ring(300);
    let whole = MpmOptions {
        steps: Some(40),
        ..cached()
    };
    let on =
        |threads: usize| on_threads(threads, || whole.sample(&target, &frame, &run, &mut Silent)).expect("particles");
    let expected = on(1);
    assert_eq!(on(3).positions, expected.positions);
    let directory = tempfile::tempdir().expect("a directory");
    let kept = MpmOptions {
        checkpoint: Some(Checkpoint {
            path: directory.path().join("run.checkpoint"),
            every: 8,
        }),
        ..whole.clone()
    };
    let counted = Counted::new(&target);
    for stop in [30, 40, 7] {
        let stopped = kept.sample(&counted, &frame, &run, &mut Killer(stop));
        assert!(matches!(stopped, Err(SampleError::Interrupted { .. })));
    }
    let resumed = kept.sample(&counted, &frame, &run, &mut Silent).expect("particles");
    assert_eq!(resumed.positions, expected.positions);
    assert_eq!(resumed.score_evaluations, expected.score_evaluations);
    assert_eq!(resumed.score_disagreement, expected.score_disagreement);
}
