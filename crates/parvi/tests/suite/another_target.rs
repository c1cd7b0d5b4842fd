//! The checkpoint of another target is refused, however alike the two are near the frame.

use parvi::{Checkpoint, MpmOptions, Run, SampleError, Samples, ScoreLocation, Silent};
use parvi_targets::{Frame, LogisticRegression, MinibatchScore, RegressionData, Target};

use crate::robustness::Killer;

/// N(0, I) with edges at ±`edge` along x₀, and a score times `slope` where x₀ > 1.2.
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
        x.map(|c| if x[0] > 1.2 { -self.slope * c } else { -c })
    }
}

fn keeping(directory: &tempfile::TempDir, score_location: ScoreLocation) -> MpmOptions {
    MpmOptions {
        checkpoint: Some(Checkpoint {
            path: directory.path().join("run.checkpoint"),
            every: 8,
        }),
        score_location,
        steps: Some(20),
        ..MpmOptions::default()
    }
}

fn sample(options: &MpmOptions, target: &dyn Target<2>) -> Result<Samples<2>, SampleError> {
    options.sample(target, &Frame::identity(), &Run::new(200, 5), &mut Silent)
}

#[test]
fn a_density_or_a_score_that_differs_far_from_the_frame_is_another_target() {
    let target = Altered { edge: 5.0, slope: 1.0 };
    let refused = |location: ScoreLocation, stop: usize, others: &[(f64, f64)]| {
        let directory = tempfile::tempdir().expect("a directory");
        let options = keeping(&directory, location);
        let (frame, run) = (Frame::identity(), Run::new(200, 5));
        let first = options.sample(&target, &frame, &run, &mut Killer(stop));
        assert_eq!(first.is_err(), stop < 100, "{location:?} {stop}");
        for &(edge, slope) in others {
            let error = sample(&options, &Altered { edge, slope }).expect_err("another target");
            assert!(error.to_string().contains("another run"), "{edge} {slope}: {error}");
        }
        sample(&options, &target).expect("particles");
    };
    for stop in [1, usize::MAX] {
        refused(ScoreLocation::Particles, stop, &[(1.1, 1.0), (5.0, -1.0), (5.0, 1.5)]);
    }
    for stop in [10, usize::MAX] {
        refused(ScoreLocation::Cached, stop, &[(5.0, -1.0), (5.0, 1.5)]);
    }
}

#[test]
fn a_score_that_is_wrong_everywhere_is_known_by_three_points() {
    let directory = tempfile::tempdir().expect("a directory");
    let options = MpmOptions {
        survey: false,
        ..keeping(&directory, ScoreLocation::Particles)
    };
    struct Doubled;
    impl Target<2> for Doubled {
        fn log_density(&self, x: &[f64; 2]) -> f64 {
            -0.5 * (x[0] * x[0] + x[1] * x[1])
        }
        fn score(&self, x: &[f64; 2]) -> [f64; 2] {
            x.map(|c| -2.0 * c)
        }
    }
    sample(&options, &Doubled).expect("particles");
    let refused = sample(&options, &Altered { edge: 5.0, slope: 1.0 });
    assert!(matches!(refused, Err(SampleError::Checkpoint { .. })));
}

/// Scores that another call changes are not compared, whether the target says so or not.
#[test]
fn scores_that_are_estimates_are_no_other_target() {
    struct Unsaid<T>(T);
    impl<T: Target<2>> Target<2> for Unsaid<T> {
        fn log_density(&self, x: &[f64; 2]) -> f64 {
            self.0.log_density(x)
        }
        fn score(&self, x: &[f64; 2]) -> [f64; 2] {
            self.0.score(x)
        }
    }
    let data = RegressionData::synthetic(&[0.5, -1.0], 500, 1).expect("data");
    let posterior = LogisticRegression::<2>::with_prior("synthetic", data, 10.0).expect("a posterior");
    let frame = *posterior.laplace().frame();
    let estimated = || MinibatchScore::new(&posterior, 100, 7).expect("scores");
    for location in [ScoreLocation::Particles, ScoreLocation::Cached] {
        let directory = tempfile::tempdir().expect("a directory");
        let options = keeping(&directory, location);
        let resumes = |target: &dyn Target<2>| {
            let run = Run::new(100, 5);
            // After a round of the survey, or where a body is kept.
            let steps = if location == ScoreLocation::Cached { 10 } else { 1 };
            let stopped = options.sample(target, &frame, &run, &mut Killer(steps));
            assert!(matches!(stopped, Err(SampleError::Interrupted { .. })), "{location:?}");
            let resumed = options.sample(target, &frame, &run, &mut Silent);
            resumed.map(|_| ()).expect("no other target");
            options
                .checkpoint
                .as_ref()
                .expect("a checkpoint")
                .remove()
                .expect("removed");
        };
        resumes(&estimated());
        if location == ScoreLocation::Cached {
            continue;
        }
        // What is estimated unsaid has another identity with every call, but for the first one.
        let target = estimated();
        let first = || {
            target.restart();
            Unsaid(&target)
        };
        let run = Run::new(100, 5);
        assert!(options.sample(&first(), &frame, &run, &mut Killer(1)).is_err());
        options
            .sample(&first(), &frame, &run, &mut Silent)
            .map(|_| ())
            .expect("no other target");
    }
}
