//! Log densities that are not functions of the point.

use std::sync::atomic::{AtomicU64, Ordering};

use parvi::certificate::Doubt;
use parvi::{AisOptions, MpmOptions, Outcome, Run, Samples, Silent};
use parvi_targets::{Frame, Target};

/// N(0, I) with noise in log p, uniform from −size to size, another value at every call.
struct Noisy {
    size: f64,
    calls: AtomicU64,
}

impl Noisy {
    fn of(size: f64) -> Self {
        let calls = AtomicU64::new(0);
        Self { size, calls }
    }
}

impl Target<2> for Noisy {
    fn log_density(&self, x: &[f64; 2]) -> f64 {
        let call = self.calls.fetch_add(1, Ordering::Relaxed);
        // The fractional parts of multiples of the golden section are spread evenly.
        let noise = 2.0 * (call as f64 * 0.618_033_988_749_895).fract() - 1.0;
        -0.5 * (x[0] * x[0] + x[1] * x[1]) + self.size * noise
    }

    fn score(&self, x: &[f64; 2]) -> [f64; 2] {
        x.map(|x| -x)
    }
}

fn doubt(samples: &Samples<2>) -> Option<Doubt> {
    match samples.certificate.as_ref().map(|certificate| &certificate.outcome) {
        Some(Outcome::Stalled(doubt)) => Some(doubt.clone()),
        _ => None,
    }
}

#[test]
fn noise_is_not_called_converged() {
    let frame = Frame::identity();
    for (size, seed) in [(1.0, 1), (1.0, 2), (0.1, 3)] {
        let run = Run::new(200, seed);
        let samples = MpmOptions::default()
            .sample(&Noisy::of(size), &frame, &run, &mut Silent)
            .unwrap();
        let found = doubt(&samples);
        let is_named = matches!(found, Some(Doubt::AnotherValue { of: 4, largest, .. }) if largest > 1e-3 && largest <= 2.0 * size);
        assert!(is_named, "{found:?}");
        assert_eq!(samples.steps, 0, "what is no function moves nothing");
    }
    let alone = AisOptions::default()
        .sample(&Noisy::of(1.0), &frame, &Run::new(200, 1), &mut Silent)
        .unwrap();
    assert!(matches!(doubt(&alone), Some(Doubt::AnotherValue { .. })));
}

#[test]
fn rounding_is_no_noise_and_what_was_evaluated_once_more_counts() {
    let run = Run::new(200, 1);
    let target = Noisy::of(1e-5);
    let samples = MpmOptions::default()
        .sample(&target, &Frame::identity(), &run, &mut Silent)
        .unwrap();
    assert_eq!(samples.certificate.unwrap().outcome, Outcome::Converged);
    assert_eq!(samples.density_evaluations, target.calls.into_inner());
}
