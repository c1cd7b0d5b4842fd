//! Densities without a finite integral, and what a survey in vain has taken.

use std::sync::atomic::{AtomicU64, Ordering};

use parvi::certificate::Doubt;
use parvi::{AisOptions, MpmOptions, Outcome, Run, SampleError, Samples, Silent};
use parvi_targets::{Frame, Target};

type LogDensity<'a> = &'a (dyn Fn(&[f64; 2]) -> f64 + Sync);

/// log p as a function, scores by differences; counts what is evaluated.
struct Counted<F> {
    log_density: F,
    densities: AtomicU64,
    scores: AtomicU64,
}

impl<F: Fn(&[f64; 2]) -> f64 + Sync> Counted<F> {
    fn new(log_density: F) -> Self {
        Self {
            log_density,
            densities: AtomicU64::new(0),
            scores: AtomicU64::new(0),
        }
    }

    fn sampled(&self, options: &MpmOptions, particles: usize) -> Samples<2> {
        let samples = options.sample(self, &Frame::identity(), &Run::new(particles, 1), &mut Silent);
        let samples = samples.expect("particles");
        let counts = [&self.densities, &self.scores].map(|count| count.load(Ordering::Relaxed));
        assert_eq!([samples.density_evaluations, samples.score_evaluations], counts);
        samples
    }
}

impl<F: Fn(&[f64; 2]) -> f64 + Sync> Target<2> for Counted<F> {
    fn log_density(&self, x: &[f64; 2]) -> f64 {
        self.densities.fetch_add(1, Ordering::Relaxed);
        (self.log_density)(x)
    }

    fn score(&self, x: &[f64; 2]) -> [f64; 2] {
        self.scores.fetch_add(1, Ordering::Relaxed);
        std::array::from_fn(|axis| {
            let [mut above, mut below] = [*x; 2];
            let step = 1e-5 * x[axis].abs().max(1.0);
            above[axis] += step;
            below[axis] -= step;
            ((self.log_density)(&above) - (self.log_density)(&below)) / (above[axis] - below[axis])
        })
    }
}

fn doubt(samples: &Samples<2>) -> Option<Doubt> {
    match &samples.certificate.as_ref()?.outcome {
        Outcome::Stalled(doubt) => Some(doubt.clone()),
        _ => None,
    }
}

/// log(1 + e^t) without overflow.
fn softplus(t: f64) -> f64 {
    t.max(0.0) + (-t.abs()).exp().ln_1p()
}

#[test]
fn what_does_not_fall_off_is_said_to_be_improper() {
    // A slope; nothing at all; a logistic regression of separated data without a prior.
    let separated = |x: &[f64; 2]| -softplus(-(x[0] + 2.0 * x[1])) - softplus(-(2.0 * x[0] + x[1])) - softplus(-x[0]);
    let improper: [LogDensity<'_>; 3] = [&|x| x[0], &|_| 0.0, &separated];
    for log_density in improper {
        let samples = Counted::new(log_density).sampled(&MpmOptions::default(), 100);
        assert!(
            matches!(doubt(&samples), Some(Doubt::Endless { .. })),
            "{:?}",
            doubt(&samples)
        );
    }
    let alone = AisOptions::default().sample(
        &Counted::new(separated),
        &Frame::identity(),
        &Run::new(100, 1),
        &mut Silent,
    );
    assert!(matches!(doubt(&alone.expect("particles")), Some(Doubt::Endless { .. })));
}

#[test]
fn proper_densities_fall_off() {
    // Cauchy's law, a box, a funnel.
    let cauchy = |x: &[f64; 2]| -1.5 * (x[0] * x[0] + x[1] * x[1]).ln_1p();
    let boxed = |x: &[f64; 2]| {
        if x.iter().all(|c| c.abs() < 50.0) {
            0.0
        } else {
            f64::NEG_INFINITY
        }
    };
    let funnel = |x: &[f64; 2]| -x[0] * x[0] / 18.0 - 0.5 * x[0] - 0.5 * x[1] * x[1] * (-x[0]).exp();
    let proper: [LogDensity<'_>; 3] = [&cauchy, &boxed, &funnel];
    for log_density in proper {
        let samples = Counted::new(log_density).sampled(&MpmOptions::default(), 100);
        assert!(!matches!(doubt(&samples), Some(Doubt::Endless { .. })));
    }
}

#[test]
fn a_survey_in_vain_is_counted() {
    let far = |x: &[f64; 2]| -0.5e6 * ((x[0] - 1e6).powi(2) + (x[1] - 1e6).powi(2));
    let samples = Counted::new(far).sampled(&MpmOptions::default(), 100);
    let doubt = doubt(&samples);
    assert!(
        matches!(doubt, Some(Doubt::SurveyInVain { evaluations }) if evaluations >= 900),
        "{doubt:?}"
    );
}

#[test]
fn evaluations_are_bounded_where_nothing_can_be_weighed() {
    let ridge = |x: &[f64; 2]| -0.5 * x[0] * x[0] - 0.5 * (x[1] - 500.0 * (x[0] * x[0] - 1.0)).powi(2);
    let options = MpmOptions {
        evaluations: Some(3000),
        ..MpmOptions::default()
    };
    let samples = Counted::new(ridge).sampled(&options, 1000);
    let evaluations = samples.density_evaluations + samples.score_evaluations;
    // The survey's, and those of short rounds from its pool; a round of a body takes 97,000.
    assert!(samples.pool.is_some() && evaluations < 40_000, "{evaluations}");
    let nothing = Counted::new(|_: &[f64; 2]| f64::NEG_INFINITY);
    let refused = options.sample(&nothing, &Frame::identity(), &Run::new(1000, 1), &mut Silent);
    assert!(matches!(refused, Err(SampleError::Pool(_))));
    assert!(nothing.densities.into_inner() < 4000 && nothing.scores.into_inner() < 1000);
}
