//! What `as written` means, what stands in the user's hands, and what every departure changes.

use mpm_materials::IsothermalGas;
use parvi::{
    Annealing, Coordinates, GivenParticles, Guards, Method, PaperBody, PaperMaterial, PaperOptions, ReferenceVolumes,
    Run, SampleError, Samples, ScoreLocation, Silent, SvgdOptions, sample,
};
use parvi_targets::{Banana, CatalogueTarget, Frame, Gaussian, Target};

fn target() -> Gaussian<2> {
    Gaussian::<2>::autoregressive(0.8).expect("a correlation below one")
}

/// Few small steps, which no run leaves the domain in.
fn gentle() -> PaperOptions {
    PaperOptions {
        steps: Some(6),
        time_step: Some(0.01),
        annealing: Annealing::Constant { alpha: 1e-3 },
        ..PaperOptions::as_written(false)
    }
}

fn run_of(options: &PaperOptions, run: &Run) -> Samples<2> {
    let target = target();
    options
        .sample(&target, &target.frame(), run, &mut Silent)
        .expect("a run that ends well")
}

#[test]
fn as_written_has_no_frame_no_guard_and_the_papers_defaults() {
    let options = PaperOptions::as_written(true);
    assert!(options.affine && options.coordinates == Coordinates::Own && options.guards == Guards::none());
    assert_eq!(options.annealing, Annealing::Constant { alpha: 1.0 });
    assert_eq!(options.score_location, ScoreLocation::Nodes);
    assert_eq!(
        options.material,
        PaperMaterial::neo_hookean(1.0, 0.3).expect("in range")
    );
    assert_eq!(options.reference_volumes, ReferenceVolumes::Uniform);
    // The frame that the caller hands over is not looked at.
    let far = Frame::from_scales([5.0, -3.0], [10.0, 0.1]).expect("scales");
    let run = Run::new(60, 3);
    let other = gentle().sample(&target(), &far, &run, &mut Silent).expect("samples");
    assert_eq!(run_of(&gentle(), &run).positions, other.positions);
}

#[test]
fn every_departure_is_an_option_of_its_own() {
    let run = Run::new(60, 3);
    let written = run_of(&gentle(), &run).positions;
    let with = |change: fn(&mut PaperOptions)| {
        let mut options = gentle();
        change(&mut options);
        run_of(&options, &run).positions
    };
    let departures = [
        with(|options| options.coordinates = Coordinates::Frame),
        with(|options| options.guards.mass_weighted_force = true),
        with(|options| options.guards.mass_floor = 1.0),
        with(|options| options.guards.courant = Some(0.01)),
        with(|options| options.guards.displacement_limit = Some(1e-5)),
        with(|options| options.grid_renewal = Some(2)),
        with(|options| options.reference_volumes = ReferenceVolumes::OfStartDensity),
        with(|options| options.reference_volumes = ReferenceVolumes::OfGrid),
        with(|options| options.annealing = Annealing::Constant { alpha: -1e-3 }),
        with(|options| options.score_location = ScoreLocation::Particles),
    ];
    for (k, departure) in departures.iter().enumerate() {
        assert_ne!(&written, departure, "departure {k}");
        assert!(departures[..k].iter().all(|other| other != departure), "departure {k}");
    }
}

#[test]
fn a_closure_is_the_schedule_it_computes() {
    let (run, frame) = (Run::new(40, 1), target().frame());
    let cases = [
        Annealing::Linear { from: -1e-3, to: 2e-3 },
        Annealing::Cyclic {
            from: 1e-4,
            to: 1e-3,
            cycles: 2,
        },
        Annealing::Geometric { from: -1e-4, to: -1e-3 },
    ];
    for annealing in cases {
        let options = PaperOptions { annealing, ..gentle() };
        let closure = |step: usize, steps: usize| annealing.at(step, steps);
        let body = PaperBody {
            alpha: Some(&closure),
            ..PaperBody::default()
        };
        let by_closure = gentle().sample_body(&body, &target(), &frame, &run, &mut Silent);
        assert_eq!(
            run_of(&options, &run).positions,
            by_closure.expect("samples").positions,
            "{annealing:?}"
        );
    }
    let nowhere = PaperBody::<2> {
        alpha: Some(&|step, _| if step == 4 { f64::NAN } else { 1.0 }),
        ..PaperBody::default()
    };
    let error = gentle().sample_body(&nowhere, &target(), &frame, &run, &mut Silent);
    assert!(matches!(error, Err(SampleError::InvalidOption { field: "alpha", .. })));
}

#[test]
fn a_negative_factor_drives_the_particles_apart() {
    let spread = |alpha: f64| {
        let options = PaperOptions {
            annealing: Annealing::Constant { alpha },
            steps: Some(40),
            ..PaperOptions::default()
        };
        let samples = run_of(&options, &Run::new(200, 1));
        samples.positions.iter().flatten().map(|c| c * c).sum::<f64>()
    };
    assert!(spread(-1.0) > 2.0 * spread(1.0));
}

#[test]
fn what_is_given_is_used() {
    let target = Gaussian::<2>::standard();
    let mut run = Run::new(50, 5);
    let drawn = gentle().sample(&target, &Frame::identity(), &run, &mut Silent);
    let drawn = drawn.expect("samples").positions;
    let start: Vec<f64> = parvi_start(&run);
    run.given = GivenParticles {
        positions: Some(start),
        velocities: Some(vec![0.0; 100]),
        masses: Some(vec![0.02; 50]),
        reference_volumes: Some(vec![0.02; 50]),
    };
    let given = gentle().sample(&target, &Frame::identity(), &run, &mut Silent);
    assert_eq!(drawn, given.expect("samples").positions, "the defaults, given by hand");
    for change in [
        (|given| given.velocities = Some(vec![0.1; 100])) as fn(&mut GivenParticles),
        |given| given.masses = Some((0..50).map(|p| 0.01 + 0.001 * f64::from(p)).collect()),
        |given| given.reference_volumes = Some(vec![0.5; 50]),
    ] {
        let mut run = run.clone();
        change(&mut run.given);
        let other = gentle().sample(&target, &Frame::identity(), &run, &mut Silent);
        assert_ne!(drawn, other.expect("samples").positions);
    }
}

/// The start of a run, as an observer sees it.
fn parvi_start(run: &Run) -> Vec<f64> {
    use std::ops::ControlFlow;
    struct First(Option<Vec<f64>>);
    impl parvi::Observer for First {
        fn after_step(&mut self, _: parvi::Progress) -> ControlFlow<()> {
            ControlFlow::Continue(())
        }
        fn see(&mut self, view: &parvi::ParticleView<'_>) -> ControlFlow<()> {
            self.0.get_or_insert_with(|| view.positions());
            ControlFlow::Continue(())
        }
    }
    let mut first = First(None);
    gentle()
        .sample(&Gaussian::<2>::standard(), &Frame::identity(), run, &mut first)
        .expect("samples");
    first.0.expect("a start")
}

/// Both ways to V⁰_p = m_p / ρ(X_p) find the same volumes where a grid resolves the start; a grid that is renewed finds them on its first place.
#[test]
fn volumes_by_density_are_those_of_the_law_or_of_the_grid() {
    let mut run = Run::new(4_000, 2);
    // Nothing but the stress moves: what one step does is proportional to V⁰.
    let moved = |volumes: ReferenceVolumes| {
        let options = PaperOptions {
            reference_volumes: volumes,
            annealing: Annealing::Constant { alpha: 0.0 },
            spacing: Some(0.3),
            steps: Some(2),
            time_step: Some(0.01),
            guards: Guards {
                mass_floor: 0.0,
                ..Guards::default()
            },
            ..PaperOptions::default()
        };
        let gas = IsothermalGas::CALIBRATED.with_reference_density(1.0).expect("positive");
        let body = PaperBody {
            material: Some(&gas),
            ..PaperBody::default()
        };
        let samples = options.sample_body(&body, &Gaussian::<2>::standard(), &Frame::identity(), &run, &mut Silent);
        samples.expect("samples").positions
    };
    let by_law = moved(ReferenceVolumes::OfStartDensity);
    let by_grid = moved(ReferenceVolumes::OfGrid);
    let off = by_law.iter().zip(&by_grid).filter(|(a, _)| a[0].hypot(a[1]) < 1.5);
    let off = off.map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1])).fold(0.0, f64::max);
    let uniform = moved(ReferenceVolumes::Uniform);
    let apart = by_law
        .iter()
        .zip(&uniform)
        .map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]));
    assert!(off < 0.2 * apart.fold(0.0, f64::max), "off by {off}");

    run.given = GivenParticles::at(&[[0.0, 0.0], [1.0, 1.0]]);
    run.particles = 2;
    let options = PaperOptions {
        reference_volumes: ReferenceVolumes::OfStartDensity,
        ..gentle()
    };
    let error = options.sample(&target(), &target().frame(), &run, &mut Silent);
    let error = error.expect_err("no density");
    assert!(matches!(error, SampleError::NotTaken { .. }), "{error}");
}

#[test]
fn other_methods_take_positions_or_say_that_they_do_not() {
    let target = target();
    let mut run = Run::new(3, 0);
    run.given = GivenParticles::at(&[[0.0, 0.0], [1.0, 1.0], [0.5, -1.0]]);
    let svgd = SvgdOptions {
        steps: Some(1),
        step_size: 1e-12,
        ..SvgdOptions::default()
    };
    let samples = sample(&target, &Method::Svgd(svgd), &run, &mut Silent).expect("samples");
    assert!((samples.positions[2][1] + 1.0).abs() < 1e-9);
    let body = parvi::MpmOptions {
        survey: false,
        steps: Some(1),
        time_step: Some(1e-9),
        moment_correction: parvi::MomentCorrection::Off,
        ..parvi::MpmOptions::default()
    };
    let samples = sample(&target, &Method::Mpm(body), &run, &mut Silent).expect("samples");
    assert!((samples.positions[2][1] + 1.0).abs() < 1e-6);
    for method in [Method::Iid, Method::Sobol] {
        let error = sample(&target, &method, &run, &mut Silent).expect_err("refused");
        assert!(matches!(error, SampleError::NotTaken { .. }), "{error}");
    }
    run.given.masses = Some(vec![1.0; 3]);
    let error = sample(&target, &Method::Svgd(SvgdOptions::default()), &run, &mut Silent);
    let refused = SampleError::NotTaken {
        method: "svgd",
        field: "masses",
    };
    assert_eq!(error.expect_err("refused"), refused);
}

#[test]
fn given_particles_that_make_no_sense_are_named() {
    let wrong = |change: fn(&mut GivenParticles)| {
        let mut run = Run::new(2, 0);
        run.given = GivenParticles::at(&[[0.0, 0.0], [1.0, 1.0]]);
        change(&mut run.given);
        gentle()
            .sample(&target(), &target().frame(), &run, &mut Silent)
            .expect_err("refused")
    };
    let value = |error: SampleError| match error {
        SampleError::GivenValue { field, particle, .. } => (field, particle),
        other => panic!("{other}"),
    };
    assert_eq!(
        value(wrong(|given| given.positions = Some(vec![0.0, f64::NAN, 0.0, 0.0]))),
        ("start positions", 0)
    );
    assert_eq!(
        value(wrong(|given| given.masses = Some(vec![1.0, -1.0]))),
        ("masses", 1)
    );
    assert_eq!(
        value(wrong(|given| given.reference_volumes = Some(vec![1.0, 0.0]))),
        ("reference volumes", 1)
    );
    assert_eq!(
        value(wrong(
            |given| given.velocities = Some(vec![0.0, 0.0, f64::INFINITY, 0.0])
        )),
        ("velocities", 1)
    );
    let error = wrong(|given| given.positions = Some(vec![0.0; 6]));
    assert!(matches!(error, SampleError::GivenLength { length: 6, .. }), "{error}");
}

/// The cost of Algorithm 1 is one score per node that is ever active, whatever M and T.
#[test]
fn the_force_that_does_not_change_costs_each_node_once() {
    struct Counted {
        target: Banana,
        nodes: std::sync::Mutex<Vec<[u64; 2]>>,
    }
    impl Target<2> for Counted {
        fn log_density(&self, x: &[f64; 2]) -> f64 {
            self.target.log_density(x)
        }
        fn score(&self, x: &[f64; 2]) -> [f64; 2] {
            self.nodes.lock().expect("no panic").push(x.map(f64::to_bits));
            self.target.score(x)
        }
    }
    let counted = |cached: bool, certificate: bool| {
        let target = Counted {
            target: Banana::new(1.0, 0.5).expect("a banana"),
            nodes: std::sync::Mutex::new(Vec::new()),
        };
        let options = PaperOptions {
            cached_scores: cached,
            certificate,
            ..PaperOptions::default()
        };
        let frame = target.target.frame();
        let samples = options.sample(&target, &frame, &Run::new(10_000, 1), &mut Silent);
        (samples.expect("samples"), target.nodes.into_inner().expect("no panic"))
    };
    let (samples, evaluated) = counted(true, true);
    let (without, every) = counted(false, true);
    assert_eq!(samples.positions, without.positions, "the same bits");
    assert_eq!(samples.certificate, without.certificate);
    let moving = every.len() - 10_000;
    let ever_active: std::collections::HashSet<_> = every[..moving].iter().collect();
    assert_eq!(samples.steps, 200);
    assert_eq!(samples.score_evaluations, ever_active.len() as u64);
    assert!(samples.score_evaluations <= 1_000, "{}", samples.score_evaluations);
    assert_eq!(without.score_evaluations, moving as u64);
    assert_eq!(samples.judging_evaluations, 10_000);
    assert_eq!(
        evaluated.len() as u64,
        samples.score_evaluations + samples.judging_evaluations
    );
}
