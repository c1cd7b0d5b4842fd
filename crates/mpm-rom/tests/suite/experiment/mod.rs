//! Experiments from their files.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use mpm_rom::experiment::*;
use mpm_rom::full_order::SceneDocument;
use mpm_rom::online::Update;
use mpm_rom::training::EpochReport;

mod exchanges;
mod more_runs;
mod networks;
mod refused;

/// A strip whose left end is held, and which falls.
const SCENE: &str = include_str!("../../data/bending_strip.toml");

const EXPERIMENT: &str = include_str!("../../data/strip_rom.toml");

fn files() -> (tempfile::TempDir, PathBuf) {
    let directory = tempfile::tempdir().expect("a directory");
    std::fs::write(directory.path().join("strip.toml"), SCENE).expect("written");
    let file = directory.path().join("strip_rom.toml");
    std::fs::write(&file, EXPERIMENT).expect("written");
    (directory, file)
}

fn message(change: (&str, &str)) -> String {
    assert!(EXPERIMENT.contains(change.0), "{change:?}");
    let text = EXPERIMENT.replace(change.0, change.1);
    let error = Experiment::parse(&text, Path::new("rom.toml")).expect_err("refused");
    error.to_string()
}

#[test]
fn keys_take_their_values_from_the_parameters() {
    let experiment = Experiment::parse(EXPERIMENT, Path::new("a/rom.toml")).expect("sound");
    assert_eq!(experiment.scene_file(), Path::new("a/strip.toml"));
    let case = experiment.case(&[2.0, 0.3]).expect("known");
    let value = |k: usize| case.changes[k].1.as_float().expect("a number");
    assert!((value(0) - 2.0 * 0.3f64.sin()).abs() < 1e-15 && (value(1) + 2.0 * 0.3f64.cos()).abs() < 1e-15);
}

/// Breaks after so many full-order runs or epochs; the data have two runs, after which there is nothing left to stop.
struct Stop(u64);

impl Watch for Stop {
    fn after_run(&mut self, done: usize, _: usize) -> ControlFlow<()> {
        break_if(done as u64 == self.0)
    }

    fn after_epoch(&mut self, report: &EpochReport) -> ControlFlow<()> {
        break_if(report.epoch + 1 == self.0)
    }
}

fn break_if(stop: bool) -> ControlFlow<()> {
    if stop {
        ControlFlow::Break(())
    } else {
        ControlFlow::Continue(())
    }
}

fn train_one(experiment: &Experiment, directory: &Path) -> Trained {
    let mut trained = train::<2>(experiment, directory, &mut ()).expect("trained");
    assert_eq!(trained.len(), 1);
    trained.remove(0)
}

#[test]
fn an_experiment_is_stopped_goes_on_and_is_run() {
    let (directory, file) = files();
    let experiment = Experiment::read(&file).expect("sound");
    let (whole, parts) = (directory.path().join("whole"), directory.path().join("parts"));
    assert!(matches!(
        run::<2>(&experiment, &whole, &mut |_, _| true),
        Err(ExperimentError::Untrained { .. })
    ));
    let nowhere = directory.path().join("nowhere");
    let error = run::<2>(&experiment, &nowhere, &mut |_, _| true).expect_err("no model");
    assert!(
        error.to_string().contains("parvi rom train") && !nowhere.exists(),
        "{error}"
    );
    let trained = train_one(&experiment, &whole);
    assert_eq!(
        (trained.points, trained.runs, trained.frames, trained.epochs),
        (64, 2, 10, 7)
    );
    assert!(matches!(
        train::<2>(&experiment, &parts, &mut Stop(2)),
        Err(ExperimentError::Stopped)
    ));
    let data = directory.path().join("data");
    assert!(matches!(
        train::<2>(&experiment, &data, &mut Stop(1)),
        Err(ExperimentError::Stopped)
    ));
    assert!(!data.join(names::TRAINING_DATA).exists());
    let rest = train_one(&experiment, &parts);
    assert_eq!((rest.resumed_at, rest.history.clone()), (2, trained.history));
    let bytes = |directory: &Path, name| std::fs::read(directory.join(name)).expect(name);
    for name in [names::MODEL, names::LOSSES] {
        assert_eq!(bytes(&whole, name), bytes(&parts, name), "{name}");
    }

    let rows = run::<2>(&experiment, &whole, &mut |_, _| true).expect("run");
    let kinds: Vec<_> = rows[..4].iter().map(|row| (row.samples, row.choice.update)).collect();
    assert_eq!((rows[0].choice.way(), rows[2].choice.way()), ("greedy", "all"));
    let updates = [Update::PositionVelocity, Update::VelocityOnly];
    assert!(
        rows[..4]
            .iter()
            .all(|row| row.choice.manifold == ManifoldName::Network && row.reconstruction_error.is_some())
    );
    assert!(
        rows[4..]
            .iter()
            .all(|row| row.choice.manifold == ManifoldName::Linear && row.outcome == "finished")
    );
    assert_eq!(
        kinds,
        [(20, updates[0]), (20, updates[1]), (64, updates[0]), (64, updates[1])]
    );
    let table = String::from_utf8(bytes(&whole, names::RESULTS)).expect("text");
    assert_eq!(table.lines().count(), 9);
    let frames = String::from_utf8(bytes(&whole, names::FRAMES)).expect("text");
    assert!(
        frames.starts_with("run,time,position_error_percent,x1,x2\n0,0.0,"),
        "{frames}"
    );

    let mut other = experiment.clone();
    other.cases.train.pop();
    assert!(matches!(
        train::<2>(&other, &whole, &mut ()),
        Err(ExperimentError::Occupied { .. })
    ));
    other = experiment.clone();
    other.run.samples.truncate(1);
    other.cases.test[0][0] *= 1.01;
    assert_eq!(run::<2>(&other, &whole, &mut |_, _| true).expect("run").len(), 4);
    assert!(matches!(
        run::<2>(&other, &whole, &mut |_, _| false),
        Err(ExperimentError::Stopped)
    ));
    other.cases.test.push(vec![1e12, 0.1]);
    let error = run::<2>(&other, &whole, &mut |_, _| true).expect_err("too heavy");
    let expected = "the full-order run of test case 1 (gravity = 1000000000000.0, angle = 0.1): ";
    assert!(error.to_string().starts_with(expected), "{error}");
}

#[test]
fn what_a_failed_training_left_may_be_trained_otherwise() {
    let (directory, file) = files();
    let out = directory.path().join("out");
    let parse = |text: &str| Experiment::parse(text, &file).expect("sound");
    let changed = |from: &str, to: &str| {
        assert!(EXPERIMENT.contains(from), "{from}");
        parse(&EXPERIMENT.replace(from, to))
    };
    // Runs that fail leave no data.
    let error = train::<2>(&changed("[1.0, 0.0]", "[1e12, 0.0]"), &out, &mut ()).expect_err("too heavy");
    let expected = "run 0 (gravity = 1000000000000.0, angle = 0.0): ";
    assert!(error.to_string().starts_with(expected), "{error}");
    // A network that diverges leaves them as they are.
    let wild = changed("epochs = 7", "epochs = 7, initial_rate = 1e300");
    let error = train::<2>(&wild, &out, &mut ()).expect_err("diverges").to_string();
    let expected = format!("the network of {}: epoch 0, step ", out.display());
    assert!(error.starts_with(&expected), "{error}");
    let error = train::<2>(&changed("[1.0, 0.0]", "[1.5, 0.0]"), &out, &mut ()).expect_err("other data");
    assert!(
        error.to_string().ends_with("or remove this one to begin again"),
        "{error}"
    );
    train_one(&parse(EXPERIMENT), &out);
    let config = || std::fs::read_to_string(out.join(names::CONFIG)).expect("written");
    assert_eq!(config(), EXPERIMENT);
    // Its runs have a title of their own.
    let renamed = parse(&EXPERIMENT.replacen("title = \"", "title = \"Again: ", 1));
    run::<2>(&renamed, &out, &mut |_, _| true).expect("run");
    assert_eq!(
        Experiment::read(&out.join(names::CONFIG)).expect("sound").title,
        renamed.title
    );
}

#[test]
fn a_model_of_a_part_of_the_points_runs_a_finer_scene() {
    let (directory, file) = files();
    let fine = SCENE
        .replace("spacing = 0.25", "spacing = 0.125")
        .replace("0.0050000001", "0.0025000001");
    std::fs::write(directory.path().join("fine.toml"), fine).expect("written");
    let text = EXPERIMENT.replace("cases = {", "recorded_points = 25\ncases = {").replace(
        "manifold = [\"network\", \"linear\"], samples = [20, \"all\"], quadrature = [\"lagrangian\"]",
        "scene = \"fine.toml\", samples = [20], choice = [\"drawn\", \"greedy\", \"cubature\"], step_factor = [1, 4], quadrature = [\"eulerian\", \"lagrangian\"]",
    );
    let experiment = Experiment::parse(&text, &file).expect("sound");
    let out = directory.path().join("out");
    assert_eq!(train_one(&experiment, &out).points, 25, "fewer than five of them held");
    let rows = run::<2>(&experiment, &out, &mut |_, _| true).expect("run");
    assert_eq!(rows.len(), 24);
    for row in &rows {
        assert_eq!((row.outcome.as_str(), row.reconstruction_error), ("finished", None));
        assert_eq!(row.steps * row.choice.step_factor, 80, "of the fine scene");
        assert!(row.error.is_some_and(|error| error < 20.0), "{row:?}");
    }

    let refused = text.replace("step_factor = [1, 4]", "step_factor = [3]");
    let refused = Experiment::parse(&refused, &file).expect("sound");
    let other = directory.path().join("out");
    let error = run::<2>(&refused, &other, &mut |_, _| true).expect_err("3 does not divide 20");
    assert!(
        error
            .to_string()
            .contains("run.step_factor: 3 does not divide the number of steps of a frame, 20"),
        "{error}"
    );
}

#[test]
fn weights_and_frames_between_those_of_the_scene_have_a_part_in_a_run() {
    let (directory, file) = files();
    let text = EXPERIMENT
        .replace(
            "cases = {",
            "frames_between = { per_frame = 2, distance = 0.01 }\ncases = {",
        )
        .replace("samples = [20, \"all\"]", "samples = [12, \"all\"]")
        .replace("manifold = [\"network\", \"linear\"]", "manifold = [\"linear\"]");
    let errors = |text: &str, out: &str| {
        let experiment = Experiment::parse(text, &file).expect("sound");
        let out = directory.path().join(out);
        let frames = train_one(&experiment, &out).frames;
        // Greedy points are tried on training runs, whose frames are not evenly spaced.
        let rows = run::<2>(&experiment, &out, &mut |_, _| true).expect("run");
        assert!(
            rows.iter()
                .all(|row| row.outcome == "finished" && row.frames.len() == 5),
            "{rows:?}"
        );
        let errors = rows.iter().map(|row| row.error.expect("frames"));
        (frames, errors.collect::<Vec<_>>())
    };
    let (frames, equal) = errors(&text, "equal");
    assert!(
        frames > 10 && frames < 18,
        "2 runs of 5 frames and some of 4 instants between: {frames}"
    );
    let weighted = text.replace("samples = [12", "weights = \"nearest\", samples = [12");
    let (_, nearest) = errors(&weighted, "nearest");
    assert!(
        equal.iter().chain(&nearest).all(|&error| error < 5.0),
        "{equal:?} {nearest:?}"
    );
    // Two updates with 12 points, then with all, where weights are the same.
    assert!(
        equal[0] != nearest[0] && equal[2..] == nearest[2..],
        "{equal:?} {nearest:?}"
    );
}

#[test]
fn points_drawn_anew_in_every_step_are_near_the_full_order_run() {
    let (directory, file) = files();
    let changes = [
        ("[20, \"all\"]", "[12, 64, \"all\"], choice = [\"redrawn\"]"),
        ("[\"network\", \"linear\"]", "[\"linear\"]"),
        ("[\"lagrangian\"]", "[\"lagrangian\", \"eulerian\"]"),
    ];
    let text = changes
        .iter()
        .fold(EXPERIMENT.to_owned(), |text, (from, to)| text.replace(from, to));
    let experiment = Experiment::parse(&text, &file).expect("sound");
    let out = directory.path().join("out");
    train_one(&experiment, &out);
    let rows = run::<2>(&experiment, &out, &mut |_, _| true).expect("run");
    assert_eq!(rows.len(), 12);
    for row in &rows {
        assert_eq!(row.outcome, "finished");
        assert!(row.error.is_some_and(|error| error < 5.0), "{row:?}");
    }
    let of = |samples| rows.iter().filter(move |row| row.choice.samples == samples);
    for (drawn, all) in of(SampleCount::Drawn(64)).zip(of(SampleCount::All)) {
        assert_eq!((drawn.choice.way(), all.choice.way()), ("redrawn", "all"));
        assert_eq!((drawn.samples, &drawn.frames), (64, &all.frames), "all of 64 points");
    }
    assert!(
        of(SampleCount::Drawn(12))
            .zip(of(SampleCount::All))
            .all(|(few, all)| few.frames != all.frames)
    );
    // Not every step has what all coordinates need.
    let refused = Experiment::parse(&text.replace("[12,", "[5,"), &file).expect("sound");
    let error = run::<2>(&refused, &out, &mut |_, _| true).expect_err("too few");
    let expected = format!(
        "{}, run.samples: the number of sample points is 5, at least 6 are needed",
        file.display()
    );
    assert!(error.to_string().starts_with(&expected), "{error}");
}

#[test]
fn more_points_than_those_of_the_dynamics_are_compared_with_a_run_of_their_own() {
    let (directory, file) = files();
    let denser = SCENE.replace("material = \"rubber\"", "material = \"rubber\"\nparticles_per_axis = 3");
    std::fs::write(directory.path().join("denser.toml"), &denser).expect("written");
    let text = EXPERIMENT.replace(
        "manifold = [\"network\", \"linear\"], samples = [20, \"all\"], quadrature = [\"lagrangian\"]",
        "manifold = [\"network\", \"linear\"], super_resolution = \"denser.toml\", vtu = true, samples = [20], inverted = \"limit\"",
    );
    let experiment = Experiment::parse(&text, &file).expect("sound");
    let out = directory.path().join("out");
    train::<2>(&experiment, &out, &mut ()).expect("trained");
    // What an earlier, longer `run` of more cases has left, and what somebody put beside it.
    let earlier = [
        "run_0000/particles_000005.vtu",
        "run_0009/particles_000000.vtu",
        "run_0008/notes.txt",
    ];
    for file in earlier.map(|name| out.join(name)) {
        std::fs::create_dir_all(file.parent().expect("a directory")).expect("made");
        std::fs::write(file, "earlier").expect("written");
    }
    let rows = run::<2>(&experiment, &out, &mut |_, _| true).expect("run");
    assert_eq!(rows.len(), 4);
    let there = [earlier[0], "run_0009", earlier[2]].map(|name| out.join(name).exists());
    assert_eq!(there, [false, false, true]);
    assert!(rows[2..].iter().all(|row| row.super_resolved.is_none()), "linear");
    for row in &rows[..2] {
        let fine = row.super_resolved.expect("asked for");
        assert_eq!(fine.points, 144);
        let (fine_error, error) = (fine.error.expect("frames"), row.error.expect("frames"));
        // The same grid, so that particles and tracers of the coarse run see nearly the same motion.
        assert!(fine.tracer_error > 0.0 && fine.tracer_error < 1.0, "{fine:?}");
        assert!(fine_error > 0.0 && (fine_error - error).abs() < 0.2 * error, "{row:?}");
        assert!(row.latent_return > 0.0 && row.latent_return <= 1.0);
    }
    let table = std::fs::read_to_string(out.join(names::RESULTS)).expect("a table");
    let names = table.lines().next().expect("a head");
    assert!(
        names.starts_with("case,gravity,angle,manifold,variant,samples,"),
        "{names}"
    );
    for line in table.lines() {
        assert_eq!(line.split(',').count(), names.split(',').count(), "{line}");
    }
    for run in ["run_0000", "run_0001"] {
        let run = out.join(run);
        let index = std::fs::read_to_string(run.join("particles.pvd")).expect("an index");
        assert_eq!(index.matches("DataSet").count(), 5);
        let last = std::fs::read(run.join("particles_000004.vtu")).expect("the last frame");
        let head = String::from_utf8_lossy(&last[..last.len().min(4000)]).into_owned();
        assert!(head.contains("NumberOfPoints=\"144\""), "{head}");
        assert!(head.contains("Name=\"position_error\""), "{head}");
    }

    for (change, expected) in [
        (("interval = 0.05", "interval = 0.1"), "a frame every 0.1 s"),
        (
            ("end = 0.2", "end = 0.3"),
            "the number of frames is 7, where the scene that is run has 5",
        ),
    ] {
        std::fs::write(directory.path().join("denser.toml"), denser.replace(change.0, change.1)).expect("written");
        let error = run::<2>(&experiment, &out, &mut |_, _| true).expect_err("refused");
        let message = error.to_string();
        assert!(
            message.contains("run.super_resolution") && message.contains(expected),
            "{message}"
        );
    }
}

#[test]
fn sample_points_are_on_the_regions_of_each_case() {
    let (directory, file) = files();
    let keys = EXPERIMENT.replace("\"angle\"]\nkeys", "\"angle\", \"end\"]\nkeys").replace(
        "keys = [",
        "keys = [\n    { key = \"kinematic.0.region.lower.0\", offset = -0.1, factor = 1.85, product = [\"end\"] },\n    { key = \"kinematic.0.region.upper.0\", offset = 0.25, factor = 1.85, product = [\"end\"] },",
    );
    // The first training case is held at the other end than the unseen one.
    let text = keys.replace(
        "train = [[1.0, 0.0], [3.0, 0.2]], test = [[2.0, 0.1]]",
        "train = [[1.0, 0.0, 0.0], [3.0, 0.2, 1.0]], test = [[2.0, 0.1, 1.0]]",
    );
    let experiment = Experiment::parse(&text, &file).expect("sound");
    let out = directory.path().join("out");
    train_one(&experiment, &out);
    // Given points without five on the region would be refused.
    let rows = run::<2>(&experiment, &out, &mut |_, _| true).expect("run");
    let greedy: Vec<_> = rows.iter().filter(|row| row.choice.way() == "greedy").collect();
    assert!(!greedy.is_empty() && greedy.iter().all(|row| row.samples == 20));
}
