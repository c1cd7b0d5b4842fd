//! What every sampler must do, and what the calibrated one must reach.

use std::ops::ControlFlow;

use mpm_core::SplineGrid;
use mpm_kernels::Quadratic;
use mpm_tensor::vector;
use parvi::{
    AisOptions, BasisChoice, Guards, Method, MomentCorrection, MpmOptions, NonFiniteScores, Observer, PaperMaterial,
    PaperOptions, Progress, Run, SampleError, Samples, ScoreLocation, Settling, Silent, SmcOptions, Start, StartDraws,
    SvgdOptions, TransferChoice, galerkin_stein_residual, sample,
};
use parvi_metrics::{Cloud, CloudMoments, GaussianEnergy};
use parvi_targets::{Banana, CatalogueTarget, Frame, Funnel, Gaussian, GaussianMixture, Ring, StudentT, Target};

fn mpm<const D: usize>(target: &dyn CatalogueTarget<D>, options: MpmOptions, run: &Run) -> Samples<D> {
    sample(target, &Method::Mpm(options), run, &mut Silent).expect("a run that ends well")
}

/// The body's own way, without a survey that would place it on the target.
fn body_alone() -> MpmOptions {
    MpmOptions {
        survey: false,
        ..MpmOptions::default()
    }
}

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
        let cloud = Cloud::new(&samples.positions).expect("finite particles");
        let moments = CloudMoments::new(&cloud).expect("moments");
        for a in 0..2 {
            assert!(moments.mean[a].abs() < tolerance, "{method:?}: mean {:?}", moments.mean);
            for b in 0..2 {
                let expected = if a == b { 1.0 } else { 0.8 };
                let error = (moments.covariance.0[a][b] - expected).abs();
                assert!(error < tolerance, "{method:?}: covariance off by {error}");
            }
        }
    }
}

#[test]
fn energy_distance_is_a_small_share_of_the_independent_one() {
    let target = Gaussian::<2>::standard();
    let energy = GaussianEnergy::<2>::standard().expect("a Gaussian");
    for seed in 1..=5 {
        let samples = mpm(&target, body_alone(), &Run::new(512, seed));
        let squared = energy
            .squared(&Cloud::new(&samples.positions).expect("finite"))
            .expect("ED²");
        // Independent draws: 1.772 / 512 = 3.5e-3 on average.
        // Scrambled Sobol points: 0.156e-3.
        assert!(squared <= 0.15e-3, "seed {seed}: ED² = {squared}");
        assert!(samples.score_evaluations <= 100 * 512);
        assert!(samples.residual.expect("a residual") < 0.6);
    }
}

#[test]
fn bases_transfers_and_score_locations_all_converge() {
    let target = Gaussian::<2>::standard();
    let energy = GaussianEnergy::<2>::standard().expect("a Gaussian");
    let bases = [
        BasisChoice::Lattice,
        BasisChoice::Linear,
        BasisChoice::Quadratic,
        BasisChoice::Cubic,
    ];
    for basis in bases {
        for transfer in [TransferChoice::Pic, TransferChoice::Apic, TransferChoice::Flip(0.9)] {
            let options = MpmOptions {
                basis,
                transfer,
                ..body_alone()
            };
            let samples = mpm(&target, options, &Run::new(512, 2));
            let squared = energy
                .squared(&Cloud::new(&samples.positions).expect("finite"))
                .expect("ED²");
            assert!(squared <= 0.4e-3, "{basis:?}, {transfer:?}: {squared}");
        }
    }
    // At the nodes the covariance shrinks by the kernel's variance; the correction repairs it.
    let at_nodes = MpmOptions {
        score_location: ScoreLocation::Nodes,
        moment_correction: MomentCorrection::Affine,
        ..body_alone()
    };
    let samples = mpm(&target, at_nodes, &Run::new(512, 2));
    let squared = energy
        .squared(&Cloud::new(&samples.positions).expect("finite"))
        .expect("ED²");
    assert!(squared <= 1e-3, "score at nodes: {squared}");
}

#[test]
fn far_and_narrow_starts_arrive() {
    let target = Gaussian::<2>::autoregressive(0.5).expect("a correlation below one");
    let energy = GaussianEnergy::new([0.0; 2], &target.frame().covariance()).expect("a Gaussian");
    for (mean, standard_deviation) in [(0.7, 0.6), (5.0, 0.5), (0.0, 0.1)] {
        let run = Run {
            start: Start {
                mean,
                standard_deviation,
                ..Start::default()
            },
            ..Run::new(512, 3)
        };
        let samples = mpm(&target, body_alone(), &run);
        let squared = energy
            .squared(&Cloud::new(&samples.positions).expect("finite"))
            .expect("ED²");
        assert!(
            squared <= 0.5e-3,
            "start {mean} ± {standard_deviation}: ED² = {squared}"
        );
    }
}

#[test]
fn covariance_at_rest_without_shifts_and_correction() {
    let target = Gaussian::<2>::standard();
    for seed in 0..4 {
        let options = MpmOptions {
            shifts: false,
            moment_correction: MomentCorrection::Off,
            basis: BasisChoice::Quadratic,
            spacing: Some(1.2),
            steps: Some(400),
            ..body_alone()
        };
        let samples = mpm(&target, options, &Run::new(1000, seed));
        let moments = CloudMoments::new(&Cloud::new(&samples.positions).expect("finite")).expect("moments");
        for a in 0..2 {
            for b in 0..2 {
                let expected = if a == b { 1.0 } else { 0.0 };
                let error = (moments.covariance.0[a][b] - expected).abs();
                assert!(error <= 1e-3, "seed {seed}: {error}");
            }
        }
    }
}

#[test]
fn same_seed_same_bits_on_any_number_of_threads() {
    let target = Banana::new(1.0, 0.5).expect("a banana");
    let methods = [
        Method::Mpm(MpmOptions {
            steps: Some(12),
            ..body_alone()
        }),
        Method::Mpm(MpmOptions {
            steps: Some(4),
            rounds: Some(1),
            ..MpmOptions::default()
        }),
        Method::Paper(PaperOptions {
            affine: true,
            steps: Some(12),
            ..PaperOptions::default()
        }),
        Method::Svgd(SvgdOptions {
            steps: Some(3),
            ..SvgdOptions::default()
        }),
    ];
    for method in methods {
        let on = |threads: usize, seed: u64| {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .expect("a pool");
            // Enough for several parts; SVGD takes time by the square.
            let particles = match &method {
                Method::Svgd(_) => 4_000,
                Method::Mpm(options) if options.survey => 2_000,
                _ => 30_000,
            };
            let run = Run::new(particles, seed);
            pool.install(|| bits(&sample(&target, &method, &run, &mut Silent).expect("samples")))
        };
        let one = on(1, 9);
        assert_eq!(one, on(2, 9), "{method:?}");
        assert_eq!(one, on(3, 9), "{method:?}");
        assert_ne!(one, on(1, 10), "another seed is another run");
    }
}

#[test]
fn the_paper_s_algorithms_stay_finite_with_their_guards() {
    let targets: [Box<dyn CatalogueTarget<2>>; 6] = [
        Box::new(Gaussian::<2>::autoregressive(0.9).expect("a correlation below one")),
        Box::new(Banana::new(1.0, 0.5).expect("a banana")),
        Box::new(Ring::new(2.0, 0.2).expect("a ring")),
        Box::new(GaussianMixture::<2>::four_equal(0.5).expect("a mixture")),
        Box::new(Funnel::<2>::new(1.5).expect("a funnel")),
        Box::new(StudentT::<2>::new(5.0).expect("a t distribution")),
    ];
    for target in &targets {
        for affine in [false, true] {
            let options = PaperOptions {
                affine,
                ..PaperOptions::default()
            };
            for seed in 0..2 {
                let samples = sample(
                    &**target,
                    &Method::Paper(options.clone()),
                    &Run::new(500, seed),
                    &mut Silent,
                );
                let samples = samples.unwrap_or_else(|error| panic!("{}, affine {affine}: {error}", target.name()));
                assert!(samples.positions.iter().flatten().all(|c| c.is_finite()));
            }
        }
    }
    let unguarded = PaperOptions {
        guards: Guards::none(),
        ..PaperOptions::default()
    };
    for target in &targets {
        // Without guards the algorithms may fail, but they say so.
        if let Ok(samples) = sample(
            &**target,
            &Method::Paper(unguarded.clone()),
            &Run::new(500, 0),
            &mut Silent,
        ) {
            assert!(samples.positions.iter().flatten().all(|c| c.is_finite()));
        }
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
    assert!(error.to_string().contains("Poisson"), "{error}");
    let rough = PaperOptions {
        friction: -1.0,
        ..PaperOptions::default()
    };
    match sample(&target, &Method::Paper(rough), &run, &mut Silent) {
        Err(SampleError::InvalidOption { field, .. }) => assert_eq!(field, "friction"),
        other => panic!("{other:?}"),
    }
}

struct StopAfter(usize);

impl Observer for StopAfter {
    fn after_step(&mut self, progress: Progress) -> ControlFlow<()> {
        if progress.step == self.0 {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
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

#[test]
fn the_trace_has_the_steps_asked_for() {
    let target = Gaussian::<2>::standard();
    let options = MpmOptions {
        trace_every: 10,
        steps: Some(40),
        ..body_alone()
    };
    let samples = mpm(&target, options, &Run::new(300, 1));
    let steps: Vec<usize> = samples.trace.iter().map(|point| point.step).collect();
    assert_eq!(steps, [1, 10, 20, 30, 40]);
    assert!(
        samples
            .trace
            .iter()
            .all(|point| point.residual.is_some_and(f64::is_finite))
    );
    let (first, last) = (samples.trace[0], samples.trace[4]);
    assert!(last.residual < first.residual, "the residual falls");
    assert!(last.kinetic_energy < first.kinetic_energy, "the cloud comes to rest");
}

#[test]
fn the_residual_does_not_depend_on_the_trace() {
    let target = Gaussian::<2>::standard();
    for (basis, shifts) in [(BasisChoice::Lattice, true), (BasisChoice::Quadratic, false)] {
        let residual = |trace_every| {
            let options = MpmOptions {
                basis,
                shifts,
                trace_every,
                steps: Some(20),
                ..MpmOptions::default()
            };
            let samples = mpm(&target, options, &Run::new(400, 4));
            samples.residual.expect("a residual")
        };
        let plain = residual(0);
        for trace_every in [3, 10] {
            assert!((residual(trace_every) / plain - 1.0).abs() < 1e-12, "{basis:?}");
        }
    }
}

#[test]
fn without_shifts_the_body_moves_far_less() {
    let target = Gaussian::<2>::standard();
    let spread = |shifts| {
        // Hat functions leave a tremor on any one lattice (docs/theory.md, section 8); quadratic splines do not.
        let options = |steps| MpmOptions {
            basis: BasisChoice::Quadratic,
            shifts,
            steps: Some(steps),
            settling: Settling {
                share: 0.0,
                ..Settling::default()
            },
            moment_correction: MomentCorrection::Off,
            ..MpmOptions::default()
        };
        let run = Run::new(300, 5);
        let (one, other) = (mpm(&target, options(1000), &run), mpm(&target, options(1001), &run));
        let pairs = one.positions.iter().zip(&other.positions);
        pairs.map(|(a, b)| vector::distance(a, b)).fold(0.0, f64::max)
    };
    let (resting, moving) = (spread(false), spread(true));
    assert!(resting < 0.3 * moving, "{resting} with one lattice, {moving} with many");
}

#[test]
fn quasi_random_starts_have_the_moments_asked_for_and_are_not_the_yardstick() {
    let target = Gaussian::<3>::standard();
    let at = |draws| {
        let options = MpmOptions {
            steps: Some(1),
            time_step: Some(1e-9),
            moment_correction: MomentCorrection::Off,
            ..body_alone()
        };
        let start = Start {
            mean: 2.0,
            standard_deviation: 0.5,
            draws,
        };
        let run = Run {
            start,
            ..Run::new(1024, 8)
        };
        mpm(&target, options, &run).positions
    };
    let quiet = at(StartDraws::QuasiRandom);
    for axis in 0..3 {
        let mean = quiet.iter().map(|x| x[axis]).sum::<f64>() / 1024.0;
        let variance = quiet.iter().map(|x| (x[axis] - mean).powi(2)).sum::<f64>() / 1024.0;
        assert!(
            (mean - 2.0).abs() < 1e-2 && (variance - 0.25).abs() < 5e-3,
            "{mean}, {variance}"
        );
    }
    assert_ne!(quiet, at(StartDraws::Independent));
    let yardstick = sample(&target, &Method::Sobol, &Run::new(1024, 8), &mut Silent).expect("points");
    let same = |x: &[f64; 3], y: &[f64; 3]| (0..3).all(|a| (x[a] - 2.0 - 0.5 * y[a]).abs() < 1e-6);
    assert!(!quiet.iter().zip(&yardstick.positions).any(|(x, y)| same(x, y)));
}
