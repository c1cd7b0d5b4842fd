//! Densities without a finite integral, and what a survey in vain has taken.

use std::sync::atomic::{AtomicU64, Ordering};

use parvi::certificate::Doubt;
use parvi::{AisOptions, MpmOptions, Outcome, Run, SampleError, Samples, Silent, SmcOptions, Start, SvgdOptions};
use parvi_targets::{Frame, Target};

use crate::half_lines::UnitCube;

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

/// A Cauchy law has no standard deviation that particles could have; a t law with ν = 3 does, and a normal law whose log density has a floor.
#[test]
fn standard_deviations_that_do_not_exist_are_not_vouched_for() {
    let square = |x: &[f64; 2]| x[0] * x[0] + x[1] * x[1];
    let heavy = |x: &[f64; 2]| -1.5 * square(x).ln_1p();
    let products = |x: &[f64; 2]| -(x[0] * x[0]).ln_1p() - (x[1] * x[1]).ln_1p();
    let sound = |x: &[f64; 2]| -2.5 * (square(x) / 3.0).ln_1p();
    let floored = |x: &[f64; 2]| (-0.5 * square(x)).max(-700.0);
    let laws: [(LogDensity<'_>, bool); 4] = [(&heavy, true), (&products, true), (&sound, false), (&floored, false)];
    for (law, (log_density, expected)) in laws.into_iter().enumerate() {
        let samples = Counted::new(log_density).sampled(&MpmOptions::default(), 1000);
        let said = doubt(&samples);
        assert_eq!(
            matches!(said, Some(Doubt::Spreadless { .. })),
            expected,
            "{law}: {said:?}"
        );
    }
}

/// N(0, I), or a slope without end, with a score given by a function.
struct Scored<S>(bool, S);

impl<S: Fn(&[f64; 2]) -> [f64; 2] + Sync> Target<2> for Scored<S> {
    fn log_density(&self, x: &[f64; 2]) -> f64 {
        if self.0 {
            -0.5 * (x[0] * x[0] + x[1] * x[1])
        } else {
            0.5 * x[0]
        }
    }

    fn score(&self, x: &[f64; 2]) -> [f64; 2] {
        (self.1)(x)
    }
}

#[test]
fn a_score_that_is_no_number_is_no_gradient() {
    let (frame, run) = (Frame::identity(), Run::new(100, 1));
    for value in [f64::NAN, f64::INFINITY] {
        let target = Scored(true, move |_: &[f64; 2]| [value; 2]);
        let ais = AisOptions::default().sample(&target, &frame, &run, &mut Silent);
        let mpm = MpmOptions::default().sample(&target, &frame, &run, &mut Silent);
        for samples in [ais, mpm] {
            let doubt = doubt(&samples.expect("particles"));
            assert_eq!(doubt, Some(Doubt::NoScore { points: 8, of: 8 }));
        }
    }
}

#[test]
fn no_temperatures_lead_to_an_improper_density() {
    let slope = Scored(false, |_: &[f64; 2]| [0.5, 0.0]);
    let options = SmcOptions {
        pool_size: Some(256),
        populations: 2,
        chain_length: 16,
    };
    let error = options.sample(&slope, &Frame::identity(), &Run::new(20, 1), &mut Silent);
    let error = error.expect_err("no end");
    assert!(matches!(error, SampleError::TooFar { temperatures: 2000 }), "{error}");
}

#[test]
fn particles_that_end_outside_are_said_to() {
    let options = SvgdOptions {
        steps: Some(50),
        ..SvgdOptions::default()
    };
    let samples = options.sample(&UnitCube, &Frame::<2>::identity(), &Run::new(50, 1), &mut Silent);
    let samples = samples.expect("particles");
    let outside = |x: &&[f64; 2]| !UnitCube.log_density(x).is_finite();
    let particles = samples.positions.iter().filter(outside).count();
    assert!(particles > 0 && samples.density_evaluations == 50);
    assert_eq!(doubt(&samples), Some(Doubt::Outside { particles, of: 50 }));
    let inside = options.sample(
        &Scored(true, |x: &[f64; 2]| x.map(|c| -c)),
        &Frame::identity(),
        &Run::new(50, 1),
        &mut Silent,
    );
    assert_eq!(inside.expect("particles").certificate, None);
}

#[test]
fn importance_sampling_takes_no_start_law_that_is_none_and_no_zero_evaluations() {
    let target = Scored(true, |x: &[f64; 2]| x.map(|c| -c));
    let ais = |particles, evaluations, standard_deviation| {
        let mut run = Run::new(particles, 1);
        run.start = Start {
            standard_deviation,
            ..Start::default()
        };
        let options = AisOptions {
            evaluations,
            ..AisOptions::default()
        };
        options.sample(&target, &Frame::identity(), &run, &mut Silent)
    };
    for standard_deviation in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = ais(100, None, standard_deviation);
        assert!(
            matches!(refused, Err(SampleError::InvalidOption { .. })),
            "{standard_deviation}"
        );
    }
    assert!(ais(100, Some(0), 1.0).is_err_and(|error| error.to_string().starts_with("evaluations = 0:")));
    for (count, limit) in [(100, 1), (1000, 1000), (5000, 3000)] {
        let samples = ais(count, Some(limit), 1.0).expect("particles");
        let pool = samples.pool.as_ref().expect("a pool");
        let of_pool = pool.density_evaluations + pool.score_evaluations;
        let besides = samples.density_evaluations + samples.score_evaluations - of_pool;
        let first = 375 * 2 + 3 * count as u64 / 4;
        assert!(
            of_pool <= limit + first && besides <= count as u64 + 100,
            "{of_pool} {besides}"
        );
    }
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
    // The survey's, and those of two short rounds from its pool, of 20 and 40 steps; a round of a body takes 97,000.
    assert!(samples.pool.is_some() && evaluations < 70_000, "{evaluations}");
    let nothing = Counted::new(|_: &[f64; 2]| f64::NEG_INFINITY);
    let refused = options.sample(&nothing, &Frame::identity(), &Run::new(1000, 1), &mut Silent);
    assert!(matches!(refused, Err(SampleError::Pool(_))));
    assert!(nothing.densities.into_inner() < 4000 && nothing.scores.into_inner() < 1000);
}
