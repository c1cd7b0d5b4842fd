//! Runs of a scene with other parameters, in full order.

use std::ops::ControlFlow;

use mpm_rom::full_order::{
    Case, FramesBetween, FullOrderError, Kept, Recording, SceneDocument, TracedRun, Value, collect,
};
use mpm_rom::online::ReducedBody;
use mpm_rom::snapshots::Frame;
use mpm_scenes::Scene;
use mpm_tensor::{Matrix, vector};
const STRIP: &str = include_str!("../data/falling_strip.toml");

fn document() -> SceneDocument {
    SceneDocument::parse(STRIP, "strip.toml".as_ref()).expect("TOML")
}

/// A run whose only parameter is the number at a key.
fn of_key(key: &str, value: f64) -> Case {
    Case {
        parameters: vec![value],
        changes: vec![(key.to_owned(), Value::Float(value))],
    }
}

#[test]
fn every_run_has_its_own_parameter_and_all_have_the_same_body() {
    let cases: Vec<Case> = [1.0, 3.0].map(|g| of_key("gravity.1", -g)).to_vec();
    let mut done = Vec::new();
    let names = ["gravity".to_owned()];
    let snapshots = collect::<2>(&document(), &names, &cases, &Kept::default(), |run| {
        done.push(run);
        ControlFlow::Continue(())
    })
    .expect("runs");
    assert_eq!((snapshots.runs().len(), snapshots.points(), done), (2, 64, vec![1, 2]));
    assert_eq!((snapshots.body().density, snapshots.body().interval), (2.0, 0.05));
    assert!(vector::distance(&snapshots.body().centroid, &[1.0, 0.25]) < 1e-15);
    for (run, g) in snapshots.runs().iter().zip([1.0, 3.0]) {
        assert_eq!((run.parameters[0], run.frames.len()), (-g, 5));
        assert_eq!(run.frames[0].positions, snapshots.reference());
        assert!(run.frames[0].velocities.iter().all(|v| *v == [0.0; 2]));
        // Free fall in 40 steps of 0.005.
        let last = &run.frames[4];
        for ((x, start), (v, gradient)) in last
            .positions
            .iter()
            .zip(snapshots.reference())
            .zip(last.velocities.iter().zip(&last.deformation_gradients))
        {
            assert!((x[1] - start[1] + g * 0.005 * 0.005 * 820.0).abs() < 1e-6 && (v[1] + 0.2 * g).abs() < 1e-6);
            assert!((*gradient - Matrix::IDENTITY).frobenius_norm() < 1e-12);
        }
    }
}

#[test]
fn what_does_not_fit_is_an_error_with_its_name() {
    let collect = |cases: &[Case]| {
        collect::<2>(&document(), &["p".to_owned()], cases, &Kept::default(), |_| {
            ControlFlow::Continue(())
        })
    };
    assert!(matches!(collect(&[]), Err(FullOrderError::NoRuns)));
    let twice = [of_key("gravity.0", 0.0), of_key("gravity.0", 1.0)];
    let stopped = mpm_rom::full_order::collect::<2>(&document(), &["p".to_owned()], &twice, &Kept::default(), |_| {
        ControlFlow::Break(())
    });
    assert!(matches!(stopped, Err(FullOrderError::Stopped { runs: 1 })));
    let error = collect(&[of_key("bodies.1.shape.radius", 1.0)]).expect_err("no such body");
    assert_eq!(
        error.to_string(),
        "strip.toml, change of `bodies.1.shape.radius`: bodies has no `1`"
    );
    let wider = [of_key("gravity.0", 0.0), of_key("bodies.0.shape.upper.0", 2.5)];
    assert!(matches!(collect(&wider), Err(FullOrderError::AnotherBody { run: 1 })));
    let error =
        mpm_rom::full_order::collect::<3>(&document(), &[], &[of_key("gravity.0", 0.0)], &Kept::default(), |_| {
            ControlFlow::Continue(())
        });
    assert!(matches!(
        error,
        Err(FullOrderError::Dimension { found: 2, expected: 3 })
    ));
}

#[test]
fn tracers_leave_the_run_as_it_is_and_move_with_it() {
    let held = format!(
        "{STRIP}[[kinematic]]\nregion = {{ kind = \"box\", lower = [0.0, 0.0], upper = [0.125, 0.5] }}\n\
        [[held]]\nshape = {{ kind = \"half-space\", point = [0.25, 0.0], normal = [1.0, 0.0] }}\n"
    );
    let scene = Scene::parse(&held, "strip.toml".as_ref()).expect("a scene");
    let body = ReducedBody::<2>::of(&scene).expect("can be reduced");
    let recording = Recording::of(&scene, &[], None).expect("a body");
    let (frames, _) = recording.run(&scene).expect("runs");
    // A tracer at a particle, and one in the middle of four.
    let tracers = [body.reference[37], [0.125, 0.0]];
    let mut traced = TracedRun::new(&body, &tracers).expect("two tracers");
    for frame in &frames[1..] {
        traced.advance_frame().expect("steps");
        for (found, expected) in traced.positions().iter().zip(&frame.positions) {
            // The scene's step is longer by 2e-8.
            assert!(vector::distance(found, expected) < 1e-7, "{found:?} {expected:?}");
        }
        let found = traced.tracers();
        assert!(vector::distance(&found[0], &frame.positions[37]) < 1e-7);
        assert!(found[1][1] < 0.0);
    }
}

#[test]
fn a_part_of_the_points_moves_as_it_does_among_all() {
    let scene = document().scene(&[]).expect("a scene");
    let all = Recording::<2>::of(&scene, &[], None).expect("a body");
    let part = Recording::<2>::of(&scene, &[], Some(10)).expect("a body");
    assert_eq!((part.body.reference.len(), part.body.centroid), (10, all.body.centroid));
    assert_eq!(Recording::<2>::of(&scene, &[], Some(64)).expect("a body"), all);
    let place = |x: &[f64; 2]| all.body.reference.iter().position(|y| x == y).expect("one of them");
    let numbers: Vec<usize> = part.body.reference.iter().map(place).collect();
    assert!(numbers.windows(2).all(|pair| pair[0] < pair[1]), "{numbers:?}");

    let (whole, effort) = all.run(&scene).expect("runs");
    let (frames, _) = part.clone().about(&[1.0, 0.0]).run(&scene).expect("runs");
    assert_eq!((effort.steps, frames.len()), (40, whole.len()));
    for (frame, whole) in frames.iter().zip(&whole) {
        for (k, &p) in numbers.iter().enumerate() {
            let expected = vector::add(&whole.positions[p], &[0.0, 0.25]);
            assert!(vector::distance(&frame.positions[k], &expected) < 1e-14);
            assert_eq!(frame.velocities[k], whole.velocities[p]);
            assert_eq!(frame.deformation_gradients[k], whole.deformation_gradients[p]);
        }
    }
}

/// Σ |x_p − y_p|².
fn moved(one: &Frame<2>, other: &Frame<2>) -> f64 {
    let pairs = one.positions.iter().zip(&other.positions);
    pairs.map(|(x, y)| vector::norm_squared(&vector::subtract(x, y))).sum()
}

#[test]
fn frames_between_those_of_the_scene_are_kept_where_the_body_moves() {
    let scene = document().scene(&[]).expect("a scene");
    let recording = Recording::<2>::of(&scene, &[], None).expect("a body");
    let between = FramesBetween {
        per_frame: 5,
        distance: 0.0025,
    };
    let (of_scene, effort) = recording.run(&scene).expect("runs");
    let finer = recording.clone().with_frames_between(Some(between));
    let (frames, same) = finer.run(&scene).expect("runs");
    assert_eq!(effort.steps, same.steps);
    let number = |frame: &Frame<2>| frame.time / 0.05;
    let is_of_scene = |frame: &&Frame<2>| (number(frame) - number(frame).round()).abs() < 1e-9;
    let squares: f64 = recording.body.reference.iter().map(vector::norm_squared).sum();
    for pair in frames.windows(2) {
        let moved = moved(&pair[1], &pair[0]) >= 0.0025 * 0.0025 * squares;
        assert!(moved || is_of_scene(&&pair[1]), "at {}", pair[1].time);
    }
    // Free fall by t² / 2: by 0.00125 in the first frame, by 0.0015 and more between all instants of the last, of a body of size 0.6.
    let count = |from: f64, to: f64| frames.iter().filter(|f| f.time > from && f.time < to).count();
    assert_eq!((count(0.001, 0.049), count(0.1501, 0.1999)), (0, 4));
    let found: Vec<_> = frames.iter().filter(is_of_scene).collect();
    assert_eq!(found.len(), of_scene.len());
    for (found, expected) in found.iter().zip(&of_scene) {
        assert!(moved(found, expected).sqrt() < 1e-6, "at {}", found.time);
    }

    let seven = FramesBetween {
        per_frame: 7,
        ..between
    };
    let error = recording
        .with_frames_between(Some(seven))
        .run(&scene)
        .expect_err("10 steps a frame");
    assert!(
        error
            .to_string()
            .starts_with("the number of instants per frame, 7, does not divide that of its steps, 10"),
        "{error}"
    );
}

#[test]
fn a_scene_that_cannot_be_read_is_named() {
    let directory = tempfile::tempdir().expect("a directory");
    let file = directory.path().join("scene.toml");
    let message = || SceneDocument::read(&file).expect_err("no scene").to_string();
    let missing = message();
    assert!(
        missing.starts_with(&format!("cannot read {}: ", file.display())),
        "{missing}"
    );
    std::fs::write(&file, b"title = \"\xff\"\n").expect("written");
    let binary = message();
    let expected = format!("{}, line 1, column 10: what follows is not UTF-8", file.display());
    assert!(binary.starts_with(&expected), "{binary}");
}
