//! What an observer sees.

use std::ops::ControlFlow;

use mpm_mesh::generate::{EdgeTarget, disk};
use parvi::{
    AisOptions, MeshOptions, Method, MomentCorrection, MpmOptions, NonFiniteScores, Observer, PaperOptions,
    ParticleView, Progress, Run, SampleError, Samples, Silent, SmcOptions, SteinThinningOptions, SupportPointsOptions,
    SvgdOptions, sample,
};
use parvi_targets::{CatalogueTarget, Frame, Gaussian, GaussianMixture};

use crate::support::{Hiccup, body_alone};

/// What was seen at one moment.
#[derive(Clone, Debug, PartialEq)]
struct Seen {
    body: usize,
    step: usize,
    earlier_steps: usize,
    time: f64,
    positions: Vec<f64>,
    velocities: Option<usize>,
    gradients: Option<Vec<f64>>,
}

/// Notes everything.
#[derive(Default)]
struct Witness(Vec<Seen>);

impl Observer for Witness {
    fn after_step(&mut self, _: Progress) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn see(&mut self, view: &ParticleView<'_>) -> ControlFlow<()> {
        assert_eq!(view.positions().len(), view.particles() * view.dimension());
        assert_eq!(view.masses(), None);
        self.0.push(Seen {
            body: view.body,
            step: view.step,
            earlier_steps: view.earlier_steps,
            time: view.time,
            positions: view.positions(),
            velocities: view.velocities().map(|velocities| velocities.len()),
            gradients: view.deformation_gradients(),
        });
        ControlFlow::Continue(())
    }
}

fn target() -> Gaussian<2> {
    Gaussian::<2>::autoregressive(0.8).expect("a correlation below one")
}

fn watched(method: &Method) -> (Samples<2>, Vec<Seen>) {
    let run = Run::new(60, 4);
    let mut witness = Witness::default();
    let samples = sample(&target(), method, &run, &mut witness).expect("samples");
    let unwatched = sample(&target(), method, &run, &mut Silent).expect("samples");
    assert_eq!(samples.positions, unwatched.positions, "looking changes nothing");
    (samples, witness.0)
}

fn steps_of_a_body(steps: usize) -> MpmOptions {
    MpmOptions {
        steps: Some(steps),
        moment_correction: MomentCorrection::Off,
        ..body_alone()
    }
}

#[test]
fn every_method_that_moves_particles_shows_them_from_the_start_to_what_it_returns() {
    let elastic = PaperOptions {
        steps: Some(9),
        ..PaperOptions::default()
    };
    let methods = [
        Method::Mpm(steps_of_a_body(9)),
        Method::Paper(elastic.clone()),
        Method::Paper(PaperOptions {
            affine: true,
            ..elastic
        }),
        Method::Svgd(SvgdOptions {
            steps: Some(9),
            ..SvgdOptions::default()
        }),
        Method::SupportPoints(SupportPointsOptions {
            steps: Some(9),
            ..SupportPointsOptions::default()
        }),
    ];
    for method in methods {
        let (samples, seen) = watched(&method);
        assert_eq!(seen.len(), samples.steps + 1);
        assert!(seen.iter().enumerate().all(|(step, moment)| moment.step == step));
        assert!(seen.iter().all(|moment| (moment.body, moment.earlier_steps) == (0, 0)));
        assert!(seen.windows(2).all(|pair| pair[0].time < pair[1].time));
        let last = seen.last().expect("a moment");
        assert_eq!(last.positions, samples.positions.as_flattened());
        assert_ne!(seen[0].positions, last.positions);
        let moves = matches!(method, Method::Mpm(_) | Method::Paper(_));
        assert_eq!(last.velocities, moves.then_some(120));
        let elastic = matches!(method, Method::Paper(_));
        assert_eq!(last.gradients.as_ref().map(Vec::len), elastic.then_some(240));
    }
}

#[test]
fn an_elastic_body_begins_undeformed_and_deforms_in_the_targets_coordinates() {
    let options = PaperOptions {
        steps: Some(5),
        ..PaperOptions::default()
    };
    let (_, seen) = watched(&Method::Paper(options));
    let identity = [1.0, 0.0, 0.0, 1.0].repeat(60);
    assert_eq!(seen[0].gradients.as_deref(), Some(identity.as_slice()));
    assert_ne!(seen[5].gradients.as_deref(), Some(identity.as_slice()));
}

#[test]
fn methods_that_do_not_move_particles_show_none() {
    let methods = [
        Method::Iid,
        Method::Sobol,
        Method::Ais(AisOptions::default()),
        Method::Smc(SmcOptions::default()),
        Method::SteinThinning(SteinThinningOptions::default()),
        Method::Mpm(MpmOptions {
            rounds: Some(0),
            ..MpmOptions::default()
        }),
    ];
    for method in methods {
        assert_eq!(watched(&method).1, []);
    }
}

#[test]
fn rounds_after_a_survey_are_bodies_one_after_the_other() {
    let options = MpmOptions {
        steps: Some(20),
        rounds: Some(3),
        ..MpmOptions::default()
    };
    let (samples, seen) = watched(&Method::Mpm(options));
    let bodies = seen.last().expect("a body").body + 1;
    assert_eq!(samples.steps, 20 * bodies);
    assert_eq!(seen.len(), 21 * bodies);
    for (k, moment) in seen.iter().enumerate() {
        let body = k / 21;
        assert_eq!(
            (moment.body, moment.step, moment.earlier_steps),
            (body, k % 21, 20 * body)
        );
    }
}

#[test]
fn further_rounds_of_a_body_without_a_survey_are_seen() {
    let mut run = Run::new(60, 4);
    (run.start.mean, run.start.standard_deviation) = (400.0, 0.1);
    let mut witness = Witness::default();
    let samples = body_alone()
        .sample(&target(), &target().frame(), &run, &mut witness)
        .expect("samples");
    let last = witness.0.last().expect("a moment");
    assert!(last.body > 0);
    assert_eq!(last.earlier_steps + last.step, samples.steps);
}

#[test]
fn particles_on_a_mesh_are_seen_within_it() {
    let target = GaussianMixture::<2>::two_unequal(0.5).expect("a mixture");
    let edges = EdgeTarget {
        length: 0.4,
        angle: 0.0,
    };
    let mesh = disk([0.5, 0.0], 2.0, &edges).expect("a mesh");
    let options = MeshOptions {
        steps: Some(6),
        ..MeshOptions::default()
    };
    let mut witness = Witness::default();
    let samples = options
        .sample(&target, &mesh, &Run::new(60, 4), &mut witness)
        .expect("samples");
    assert_eq!(witness.0.len(), 7);
    assert_eq!(witness.0[6].positions, samples.positions.as_flattened());
    let rows = witness.0.iter().flat_map(|moment| moment.positions.as_chunks::<2>().0);
    assert!(rows.into_iter().all(|x| (x[0] - 0.5).hypot(x[1]) < 2.0 + 1e-9));
}

#[test]
fn a_run_that_goes_back_shows_where_it_goes_back_to() {
    let options = MpmOptions {
        non_finite_scores: NonFiniteScores::RejectStep,
        ..steps_of_a_body(40)
    };
    let target = Hiccup::of(f64::NAN);
    let mut witness = Witness::default();
    let run = Run::new(60, 4);
    options
        .sample(&target, &Frame::identity(), &run, &mut witness)
        .expect("samples");
    let steps: Vec<usize> = witness.0.iter().map(|moment| moment.step).collect();
    let fall = steps.windows(2).position(|pair| pair[1] <= pair[0]).expect("a fall");
    let back = witness.0[fall + 1].clone();
    assert_eq!(steps[fall + 1..], Vec::from_iter(back.step..=40));
    let before = witness.0.iter().find(|moment| moment.step == back.step);
    assert_eq!(before, Some(&back));
}

/// Stops at a moment.
struct Until(usize);

impl Observer for Until {
    fn after_step(&mut self, _: Progress) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn see(&mut self, view: &ParticleView<'_>) -> ControlFlow<()> {
        if view.step < self.0 {
            ControlFlow::Continue(())
        } else {
            ControlFlow::Break(())
        }
    }
}

#[test]
fn who_sees_may_stop() {
    for step in [0, 3] {
        for method in [Method::Mpm(steps_of_a_body(9)), Method::Svgd(SvgdOptions::default())] {
            let error = sample(&target(), &method, &Run::new(60, 4), &mut Until(step)).unwrap_err();
            assert_eq!(error, SampleError::Interrupted { step });
        }
    }
}
