//! What several themes need.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

use parvi::{MpmOptions, Observer, Progress};
use parvi_metrics::{Cloud, CloudMoments};
use parvi_targets::Target;

/// The body's own way, without a survey that would place it on the target.
pub fn body_alone() -> MpmOptions {
    MpmOptions {
        survey: false,
        ..MpmOptions::default()
    }
}

/// Stops after the step with this number.
pub struct StopAfter(pub usize);

impl Observer for StopAfter {
    fn after_step(&mut self, progress: Progress) -> ControlFlow<()> {
        if progress.step == self.0 {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }
}

/// What the work gives on so many threads.
pub fn on_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    pool.expect("a pool of threads").install(work)
}

/// Mean and covariance.
pub fn moments<const D: usize>(positions: &[[f64; D]]) -> CloudMoments<D> {
    CloudMoments::new(&Cloud::new(positions).expect("finite particles")).expect("moments")
}

/// Whether the moments are those of N(0, (1, r; r, 1)); `what` is said of them where they are not.
pub fn assert_correlated(positions: &[[f64; 2]], correlation: f64, tolerance: f64, what: &dyn std::fmt::Debug) {
    let moments = moments(positions);
    for a in 0..2 {
        assert!(moments.mean[a].abs() < tolerance, "{what:?}: mean {:?}", moments.mean);
        for b in 0..2 {
            let expected = if a == b { 1.0 } else { correlation };
            let error = (moments.covariance.0[a][b] - expected).abs();
            assert!(error < tolerance, "{what:?}: covariance off by {error}");
        }
    }
}

/// N(0, I) whose score is this in one call.
pub struct Hiccup {
    score: f64,
    calls: AtomicUsize,
}

impl Hiccup {
    /// No call yet.
    pub fn of(score: f64) -> Self {
        let calls = AtomicUsize::new(0);
        Self { score, calls }
    }
}

impl Target<2> for Hiccup {
    fn log_density(&self, x: &[f64; 2]) -> f64 {
        -0.5 * (x[0] * x[0] + x[1] * x[1])
    }

    fn score(&self, x: &[f64; 2]) -> [f64; 2] {
        x.map(|c| -c)
    }

    fn scores(&self, xs: &[[f64; 2]], out: &mut [[f64; 2]]) {
        let call = self.calls.fetch_add(1, Ordering::Relaxed);
        for (x, score) in xs.iter().zip(out) {
            *score = if call == 20 { [self.score; 2] } else { self.score(x) };
        }
    }
}

/// N(0, I) whose score is not a number beyond a wall.
pub struct Walled;

impl Target<2> for Walled {
    fn log_density(&self, x: &[f64; 2]) -> f64 {
        -0.5 * (x[0] * x[0] + x[1] * x[1])
    }

    fn score(&self, x: &[f64; 2]) -> [f64; 2] {
        if x[0] > 3.0 { [f64::NAN; 2] } else { [-x[0], -x[1]] }
    }
}
