//! Targets whose density is zero on half of the line, outside of a box or everywhere.

use std::sync::atomic::{AtomicU64, Ordering};

use parvi::{AisOptions, MpmOptions, NonFiniteScores, Run, SampleError, Samples, Silent, SmcOptions};
use parvi_targets::{Frame, Target};

/// The gamma density t^(k−1) e^(−t) where t > 0, and elsewhere zero, with a score of one's own.
struct HalfLine {
    shape: f64,
    outside: f64,
    scores: AtomicU64,
}

impl HalfLine {
    fn new(shape: f64, outside: f64) -> Self {
        let scores = AtomicU64::new(0);
        Self { shape, outside, scores }
    }
}

impl Target<1> for HalfLine {
    fn log_density(&self, &[t]: &[f64; 1]) -> f64 {
        if t > 0.0 {
            (self.shape - 1.0) * t.ln() - t
        } else {
            f64::NEG_INFINITY
        }
    }

    fn score(&self, &[t]: &[f64; 1]) -> [f64; 1] {
        self.scores.fetch_add(1, Ordering::Relaxed);
        [if t > 0.0 {
            (self.shape - 1.0) / t - 1.0
        } else {
            self.outside
        }]
    }
}

fn frame() -> Frame<1> {
    Frame::from_scales([1.0], [1.0]).expect("a frame")
}

fn sample(target: &HalfLine, seed: u64, non_finite_scores: NonFiniteScores) -> Result<Samples<1>, SampleError> {
    let options = MpmOptions {
        non_finite_scores,
        // A pool as good as this one is not polished unless that is asked for.
        rounds: Some(1),
        ..MpmOptions::default()
    };
    options.sample(target, &frame(), &Run::new(1000, seed), &mut Silent)
}

#[test]
fn a_polish_that_leaves_the_support_is_not_taken() {
    // ∫ p = Γ(k): 1 and √π.
    let half = 0.5 * std::f64::consts::PI.ln();
    for (shape, outside, log_evidence) in [(1.0, f64::NAN, 0.0), (0.5, f64::INFINITY, half)] {
        for seed in 0..5 {
            let target = HalfLine::new(shape, outside);
            let samples = sample(&target, seed, NonFiniteScores::PullBack).expect("the condensed particles");
            assert!(samples.positions.iter().all(|x| x[0] > 0.0), "{shape} {seed}");
            assert_eq!(samples.scores_replaced, 0);
            let mean = samples.positions.iter().map(|x| x[0]).sum::<f64>() / 1000.0;
            assert!((mean / shape - 1.0).abs() < 0.02, "{shape} {seed}: {mean}");
            let error = samples.log_evidence.expect("a survey") - log_evidence;
            assert!(error.abs() < 0.02, "{shape} {seed}: {error}");
            assert!((1..=4).contains(&samples.steps), "{}", samples.steps);
            assert_eq!(samples.score_evaluations, target.scores.into_inner());
        }
    }
}

#[test]
fn a_polish_that_leaves_the_support_is_reported_where_that_is_asked_for() {
    let error = sample(&HalfLine::new(1.0, f64::NAN), 0, NonFiniteScores::Report).expect_err("scores of no support");
    assert!(matches!(error, SampleError::ScoreNotFinite { .. }), "{error}");
}

/// The same log density everywhere, and a score that is none.
struct Everywhere(f64);

impl Target<1> for Everywhere {
    fn log_density(&self, _: &[f64; 1]) -> f64 {
        self.0
    }

    fn score(&self, _: &[f64; 1]) -> [f64; 1] {
        [f64::NAN]
    }
}

#[test]
fn a_density_that_is_zero_at_all_points_is_said_to_be() {
    let run = Run::new(100, 1);
    let message = |value, method: &str| {
        let (target, frame) = (&Everywhere(value), &frame());
        let samples = match method {
            "mpm" => MpmOptions::default().sample(target, frame, &run, &mut Silent),
            "ais" => AisOptions::default().sample(target, frame, &run, &mut Silent),
            _ => SmcOptions::default().sample(target, frame, &run, &mut Silent),
        };
        samples.map(|_| ()).expect_err(method).to_string()
    };
    for method in ["mpm", "ais", "smc"] {
        let nowhere = message(f64::NEG_INFINITY, method);
        let points = nowhere.strip_prefix("log p was -inf at all ").expect(&nowhere);
        let count = points
            .split_once(" points; the frame is to say where")
            .and_then(|(count, _)| count.parse::<u64>().ok());
        assert!(count.is_some_and(|count| count > 100), "{nowhere}");
        let undefined = message(f64::NAN, method);
        assert!(
            undefined.starts_with("log p was -inf at 0, NaN or +inf at "),
            "{undefined}"
        );
    }
}

/// The unit cube, with a score of zero inside and outside.
pub struct UnitCube;

impl<const D: usize> Target<D> for UnitCube {
    fn log_density(&self, x: &[f64; D]) -> f64 {
        if x.iter().all(|x| (0.0..=1.0).contains(x)) {
            0.0
        } else {
            f64::NEG_INFINITY
        }
    }

    fn score(&self, _: &[f64; D]) -> [f64; D] {
        [0.0; D]
    }
}

#[test]
fn no_particle_is_outside_of_a_box() {
    let weighted = MpmOptions {
        weighted: true,
        ..MpmOptions::default()
    };
    let frame = Frame::from_scales([0.65; 4], [0.43; 4]).expect("a frame");
    for seed in 0..4 {
        let run = Run::new(500, seed);
        let check = |method: &str, samples: Result<Samples<4>, SampleError>| {
            let samples = samples.expect(method);
            let outside = samples.positions.iter().filter(|x| UnitCube.log_density(x) < 0.0);
            assert_eq!(outside.count(), 0, "{method}, seed {seed}, {} steps", samples.steps);
        };
        check(
            "ais",
            AisOptions::default().sample(&UnitCube, &frame, &run, &mut Silent),
        );
        check(
            "mpm",
            MpmOptions::default().sample(&UnitCube, &frame, &run, &mut Silent),
        );
        check("weighted", weighted.sample(&UnitCube, &frame, &run, &mut Silent));
    }
}
