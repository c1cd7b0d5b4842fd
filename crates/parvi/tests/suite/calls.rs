//! How many points a target is given in a call.

use std::sync::atomic::{AtomicUsize, Ordering};

use parvi::{MpmOptions, Run, SampleError, Samples, ScoreLocation, Silent, SvgdOptions, expectation};
use parvi_targets::{Frame, Target};

/// Points that the target takes in a call.
const POINTS: usize = 3;

/// N(0, I), and the most points that a call has had.
#[derive(Default)]
struct Told(AtomicUsize);

impl Target<2> for Told {
    fn log_density(&self, x: &[f64; 2]) -> f64 {
        -0.5 * (x[0] * x[0] + x[1] * x[1])
    }

    fn score(&self, x: &[f64; 2]) -> [f64; 2] {
        x.map(|c| -c)
    }

    fn points_per_call(&self) -> usize {
        POINTS
    }

    fn scores(&self, xs: &[[f64; 2]], out: &mut [[f64; 2]]) {
        self.0.fetch_max(xs.len(), Ordering::Relaxed);
        xs.iter().zip(out).for_each(|(x, out)| *out = self.score(x));
    }

    fn log_densities(&self, xs: &[[f64; 2]], out: &mut [f64]) {
        self.0.fetch_max(xs.len(), Ordering::Relaxed);
        xs.iter().zip(out).for_each(|(x, out)| *out = self.log_density(x));
    }
}

/// Samples, and asserts that no call had more points than the target takes.
fn sampled(what: &str, sample: impl Fn(&Told) -> Result<Samples<2>, SampleError>) -> Samples<2> {
    let target = Told::default();
    let samples = sample(&target).unwrap();
    assert_eq!(target.0.load(Ordering::Relaxed), POINTS, "{what}");
    samples
}

#[test]
fn no_call_has_more_points_than_the_target_takes() {
    let (frame, run) = (Frame::identity(), Run::new(50, 1));
    let by =
        |what: &str, options: MpmOptions| sampled(what, |target| options.sample(target, &frame, &run, &mut Silent));
    let surveyed = by("a survey", MpmOptions::default());
    let moved = MpmOptions {
        rounds: Some(1),
        ..MpmOptions::default()
    };
    by("a survey and a round", moved);
    let free = MpmOptions {
        survey: false,
        ..MpmOptions::default()
    };
    by("a body", free.clone());
    let cached = MpmOptions {
        score_location: ScoreLocation::Cached,
        ..free
    };
    by("cached scores", cached);
    sampled("svgd", |target| {
        SvgdOptions::default().sample(target, &frame, &run, &mut Silent)
    });
    let target = Told::default();
    assert!(expectation(&target, &surveyed, |x| x[0]).is_some());
    assert_eq!(target.0.load(Ordering::Relaxed), POINTS, "an expectation");
}
