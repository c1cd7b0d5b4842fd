//! The best configuration of a body on its way, and the rule that ends a run.

use parvi::{Monitor, PaperMaterial, PaperOptions, Run, Samples, Silent, Watch};
use parvi_metrics::{Cloud, InverseMultiquadric, kernel_stein_discrepancy};
use parvi_targets::{Frame, Gaussian, Target};

const STEPS: usize = 120;

/// A soft elastic body started wide, which falls together and swings: its best configuration is on the way.
fn watched(watch: Watch, change: impl FnOnce(&mut PaperOptions)) -> Samples<2> {
    let mut options = PaperOptions {
        steps: Some(STEPS),
        watch: Some(watch),
        ..PaperOptions::default()
    };
    change(&mut options);
    let mut run = Run::new(200, 3);
    (run.start.mean, run.start.standard_deviation) = (0.5, 1.6);
    options
        .sample(&Gaussian::<2>::standard(), &Frame::identity(), &run, &mut Silent)
        .expect("samples")
}

#[test]
fn the_best_configuration_is_the_least_look() {
    for monitor in [Monitor::SteinDiscrepancy, Monitor::LogDensity, Monitor::ParticleDensity] {
        let watch = Watch {
            monitor,
            every: 7,
            patience: None,
        };
        let samples = watched(watch, |_| {});
        let seen = samples.watched.expect("watched");
        let steps: Vec<usize> = seen.history.iter().map(|look| look.0).collect();
        let expected: Vec<usize> = (0..=STEPS).filter(|s| s % 7 == 0 || *s == STEPS).collect();
        assert_eq!(steps, expected);
        let least = seen.history.iter().min_by(|a, b| a.1.total_cmp(&b.1)).expect("looks");
        assert_eq!((seen.step, seen.value), *least);
        assert!(!seen.ended && samples.steps == STEPS);
        assert_eq!(seen.positions.len(), 200);
        // Looking changes nothing.
        let unseen = watched(watch, |options| options.watch = None);
        assert_eq!(unseen.positions, samples.positions);
        assert_eq!(unseen.score_evaluations, samples.score_evaluations);
    }
}

#[test]
fn the_monitors_are_what_they_are_called() {
    let target = Gaussian::<2>::standard();
    let stein = watched(Watch::default(), |_| {}).watched.expect("watched");
    let scores: Vec<[f64; 2]> = stein.positions.iter().map(|x| target.score(x)).collect();
    let kernel = InverseMultiquadric::new(1.0, -0.5).expect("a kernel");
    let oracle = kernel_stein_discrepancy(&Cloud::new(&stein.positions).expect("a cloud"), &scores, &kernel);
    let oracle = oracle.expect("a discrepancy").squared.sqrt();
    assert!((stein.value / oracle - 1.0).abs() < 1e-10, "{} {oracle}", stein.value);
    assert!(stein.step > 0 && stein.step < STEPS, "best after step {}", stein.step);
    let watch = Watch {
        monitor: Monitor::LogDensity,
        ..Watch::default()
    };
    let samples = watched(watch, |_| {});
    let seen = samples.watched.expect("watched");
    assert_eq!(samples.density_evaluations, 200 * seen.history.len() as u64);
    let mean = seen.positions.iter().map(|x| -target.log_density(x)).sum::<f64>() / 200.0;
    assert!((seen.value - mean).abs() < 1e-12);
}

#[test]
fn a_body_at_rest_ends_its_run() {
    let watch = Watch {
        every: 5,
        patience: Some(4),
        ..Watch::default()
    };
    let friction = |options: &mut PaperOptions| (options.friction, options.steps) = (2.0, Some(2000));
    let samples = watched(watch, friction);
    let seen = samples.watched.expect("watched");
    assert!(seen.ended && samples.steps < 500, "{} steps", samples.steps);
    // Since the look before, not since the start.
    let certificate = samples.certificate.expect("judged");
    assert!(certificate.drift < 0.01, "{certificate:?}");
    assert_eq!(certificate.outcome.name(), "stalled");
    let (last, rest) = seen.history.split_last().expect("looks");
    assert_eq!(last.0, samples.steps);
    let best = rest[..rest.len() - 3]
        .iter()
        .map(|look| look.1)
        .fold(f64::INFINITY, f64::min);
    assert!(rest[rest.len() - 3..].iter().all(|look| look.1 > 0.99 * best));
    // As if it had been told.
    let told = watched(watch, |options| {
        friction(options);
        (options.steps, options.watch) = (Some(samples.steps), None);
    });
    assert_eq!(told.positions, samples.positions);
}

/// ½ Σ m v² + Σ V⁰ Ψ − Σ m log p of an undamped APIC body with small steps hardly changes (docs/theory.md, §11).
#[test]
fn the_energies_of_the_trace_add_up() {
    let samples = watched(Watch::default(), |options| {
        (options.affine, options.trace_every, options.time_step) = (true, 1, Some(2e-3));
        options.score_location = parvi::ScoreLocation::Particles;
        options.material = PaperMaterial::default();
    });
    let total = |k: usize| {
        let point = &samples.trace[k];
        let parts = [point.internal_energy, point.potential_energy];
        point.kinetic_energy + parts.into_iter().map(|part| part.expect("measured")).sum::<f64>()
    };
    let change = total(samples.trace.len() - 1) - total(0);
    let moved = samples.trace.last().expect("a trace").kinetic_energy;
    assert!(
        moved > 0.02 && change.abs() < 0.05 * moved,
        "{change} while {moved} is kinetic"
    );
    assert!(samples.trace.last().expect("a trace").internal_energy > samples.trace[0].internal_energy);
}

#[test]
fn what_makes_no_sense_is_named() {
    let target = Gaussian::<2>::standard();
    let refused = |options: PaperOptions| {
        let error = options.sample(&target, &Frame::identity(), &Run::new(20, 0), &mut Silent);
        error.expect_err("an error").to_string()
    };
    let watch = |every, patience| PaperOptions {
        watch: Some(Watch {
            every,
            patience,
            ..Watch::default()
        }),
        ..PaperOptions::default()
    };
    assert!(refused(watch(0, None)).starts_with("steps between looks = 0"));
    assert!(refused(watch(1, Some(0))).starts_with("patience = 0"));
    for flip_share in [-0.1, 1.1, f64::NAN] {
        let refused = refused(PaperOptions {
            flip_share,
            ..PaperOptions::default()
        });
        assert!(refused.starts_with("FLIP share"), "{refused}");
    }
}
