//! What every sampler must do.

use mpm_core::SplineGrid;
use mpm_kernels::Quadratic;
use parvi::{
    AisOptions, Method, MomentCorrection, MpmOptions, NonFiniteScores, PaperMaterial, PaperOptions, Run, SampleError,
    Samples, Silent, SmcOptions, SvgdOptions, TransferChoice, galerkin_stein_residual, sample,
};
use parvi_targets::{Banana, Frame, Gaussian, Target};

use crate::support::{StopAfter, assert_correlated, body_alone, on_threads};

fn bits(samples: &Samples<2>) -> Vec<u64> {
    samples.positions.iter().flatten().map(|c| c.to_bits()).collect()
}

#[test]
fn every_method_gives_the_moments_of_a_gaussian() {
    let target = Gaussian::<2>::autoregressive(0.8).expect("a correlation below one");
    // Tolerances: exact for the corrected cloud, the finite width of a lattice, and the sampling error for the others.
    let affine = MpmOptions {
        moment_correction: MomentCorrection::Affine,
        ..body_alone()
    };
    let methods = [
        (Method::Mpm(affine), 1e-9),
        (Method::Mpm(body_alone()), 0.01),
        (Method::Mpm(MpmOptions::default()), 0.02),
        (Method::Ais(AisOptions::default()), 0.02),
        (Method::Smc(SmcOptions::default()), 0.12),
        (
            Method::Svgd(SvgdOptions {
                steps: Some(200),
                ..SvgdOptions::default()
            }),
            0.05,
        ),
        (Method::Sobol, 0.02),
        (Method::Iid, 0.12),
    ];
    for (method, tolerance) in methods {
        let particles = if matches!(method, Method::Svgd(_)) { 300 } else { 2000 };
        let samples = sample(&target, &method, &Run::new(particles, 4), &mut Silent).expect("samples");
        assert_correlated(&samples.positions, 0.8, tolerance, &method);
    }
}

#[test]
fn same_seed_same_bits_on_any_number_of_threads() {
    let target = Banana::new(1.0, 0.5).expect("a banana");
    let methods = [
        Method::Mpm(MpmOptions {
            steps: Some(6),
            ..body_alone()
        }),
        Method::Mpm(MpmOptions {
            steps: Some(4),
            rounds: Some(1),
            ..MpmOptions::default()
        }),
        Method::Paper(PaperOptions {
            affine: true,
            steps: Some(6),
            ..PaperOptions::default()
        }),
        Method::Svgd(SvgdOptions {
            steps: Some(3),
            ..SvgdOptions::default()
        }),
    ];
    for method in methods {
        // Enough for several parts; SVGD takes time by the square.
        let many = match &method {
            Method::Svgd(_) => 2_000,
            Method::Mpm(options) if options.survey => 2_000,
            Method::Paper(_) => 15_000,
            _ => 25_000,
        };
        let on = |threads: usize, particles: usize, seed: u64| {
            let run = Run::new(particles, seed);
            on_threads(threads, || {
                bits(&sample(&target, &method, &run, &mut Silent).expect("samples"))
            })
        };
        let one = on(1, many, 9);
        assert_eq!(one, on(2, many, 9), "{method:?}");
        assert_eq!(one, on(3, many, 9), "{method:?}");
        assert_ne!(on(1, 200, 9), on(1, 200, 10), "another seed is another run");
    }
}

#[test]
fn residual_of_independent_draws_is_about_one() {
    let target = Gaussian::<2>::standard();
    let mut total = 0.0;
    for seed in 0..10 {
        let draws = sample(&target, &Method::Iid, &Run::new(1000, seed), &mut Silent).expect("draws");
        let scores: Vec<[f64; 2]> = draws.positions.iter().map(|x| target.score(x)).collect();
        let mut grid = SplineGrid::<Quadratic, 3, 2>::new([0.1, 0.2], 0.5).expect("a grid");
        let residual = galerkin_stein_residual(&mut grid, &draws.positions, &scores).expect("a residual");
        total += residual.ratio() / 10.0;
    }
    assert!((total - 1.0).abs() < 0.1, "{total}");
}

#[test]
fn particles_that_are_nowhere_are_not_blamed_on_the_score() {
    let options = SvgdOptions {
        step_size: 1e200,
        ..SvgdOptions::default()
    };
    let error = options
        .sample(
            &Gaussian::<2>::standard(),
            &Frame::identity(),
            &Run::new(20, 1),
            &mut Silent,
        )
        .expect_err("no end");
    assert!(matches!(error, SampleError::Diverged { step: 2, .. }), "{error}");
}

struct Broken;

impl Target<2> for Broken {
    fn log_density(&self, x: &[f64; 2]) -> f64 {
        -0.5 * (x[0] * x[0] + x[1] * x[1])
    }
    fn score(&self, x: &[f64; 2]) -> [f64; 2] {
        [-x[0], if x[1] > 1.5 { f64::NAN } else { -x[1] }]
    }
}

#[test]
fn a_score_that_is_not_a_number_is_an_error_with_its_place() {
    let frame = Frame::identity();
    let reporting = MpmOptions {
        non_finite_scores: NonFiniteScores::Report,
        survey: false,
        ..MpmOptions::default()
    };
    let errors = [
        reporting
            .sample(&Broken, &frame, &Run::new(200, 0), &mut Silent)
            .unwrap_err(),
        PaperOptions::default()
            .sample(&Broken, &frame, &Run::new(200, 0), &mut Silent)
            .unwrap_err(),
        SvgdOptions::default()
            .sample(&Broken, &frame, &Run::new(200, 0), &mut Silent)
            .unwrap_err(),
    ];
    for error in errors {
        let SampleError::ScoreNotFinite { position, score, .. } = error else {
            panic!("{error}");
        };
        assert!(position[1] > 1.5 && score[1].is_nan());
    }
}

#[test]
fn options_out_of_range_are_named() {
    let target = Gaussian::<2>::standard();
    let run = Run::new(50, 0);
    let with = |change: fn(&mut MpmOptions)| {
        let mut options = MpmOptions::default();
        change(&mut options);
        Method::Mpm(options)
    };
    let cases: [(Method, &str); 13] = [
        (with(|o| o.spacing = Some(0.0)), "spacing"),
        (with(|o| o.spacing = Some(f64::NAN)), "spacing"),
        (with(|o| o.steps = Some(0)), "steps"),
        (with(|o| o.time_step = Some(-1.0)), "time step"),
        (with(|o| o.friction = Some(-0.1)), "friction"),
        (with(|o| o.displacement_limit = 0.0), "displacement limit"),
        (with(|o| o.spacing_schedule.range = 0.5), "spacing range"),
        (with(|o| o.spacing_schedule.coarse_start = f64::NAN), "coarse start"),
        (with(|o| o.settling.share = 1.0), "settling share"),
        (with(|o| o.settling.time_step = 0.0), "settling time step"),
        (with(|o| o.transfer = TransferChoice::Flip(1.5)), "FLIP share"),
        (
            Method::Svgd(SvgdOptions {
                step_size: 0.0,
                ..SvgdOptions::default()
            }),
            "step size",
        ),
        (
            Method::Svgd(SvgdOptions {
                bandwidth: Some(-1.0),
                ..SvgdOptions::default()
            }),
            "bandwidth",
        ),
    ];
    for (method, named) in cases {
        match sample(&target, &method, &run, &mut Silent) {
            Err(SampleError::InvalidOption { field, .. }) => assert_eq!(field, named),
            other => panic!("{method:?}: {other:?}"),
        }
    }
    for method in [Method::Iid, Method::Sobol, Method::Mpm(MpmOptions::default())] {
        let error = sample(&target, &method, &Run::new(1, 0), &mut Silent).unwrap_err();
        assert!(
            matches!(error, SampleError::InvalidOption { field: "particles", .. }),
            "{error}"
        );
    }
    let error = PaperMaterial::neo_hookean(1.0, 0.5).unwrap_err();
    assert!(error.to_string().contains("poisson_ratio"), "{error}");
    let rough = PaperOptions {
        friction: -1.0,
        ..PaperOptions::default()
    };
    match sample(&target, &Method::Paper(rough), &run, &mut Silent) {
        Err(SampleError::InvalidOption { field, .. }) => assert_eq!(field, "friction"),
        other => panic!("{other:?}"),
    }
}

#[test]
fn the_observer_stops_a_run() {
    let target = Gaussian::<2>::standard();
    for (method, step) in [
        (Method::Mpm(MpmOptions::default()), 1),
        (Method::Mpm(body_alone()), 3),
        (Method::Svgd(SvgdOptions::default()), 3),
    ] {
        let error = sample(&target, &method, &Run::new(50, 0), &mut StopAfter(step)).unwrap_err();
        assert_eq!(error, SampleError::Interrupted { step });
    }
}
