//! `parvi rom`: training, reduced runs, refusals; the committed experiments.

use std::path::Path;

use mpm_rom::experiment::Experiment;
use mpm_rom::full_order::{Recording, SceneDocument};

use crate::support::{assert_refused, files, parvi, stderr, stdout, succeeds, value};

const SCENE: &str = include_str!("../../../crates/mpm-rom/tests/data/bending_strip.toml");

const EXPERIMENT: &str = r#"
title = "A strip"
scene = "strip.toml"
parameters = ["gravity"]
keys = [{ key = "gravity.1", factor = -1.0, product = ["gravity"] }]
cases = { train = [[1.0], [3.0]], test = [[2.0]] }
training = { coordinates = 2, width = 6, depth = 2, epochs = 5, batch = 2 }
run = { samples = [20, "all"] }
"#;

#[test]
fn a_model_is_trained_and_run() {
    let root = tempfile::tempdir().unwrap();
    std::fs::write(root.path().join("strip.toml"), SCENE).unwrap();
    std::fs::write(root.path().join("rom.toml"), EXPERIMENT).unwrap();
    let early = parvi(root.path(), "rom run rom.toml --out out");
    assert!(
        !early.status.success() && stderr(&early).contains("model.safetensors"),
        "{}",
        stderr(&early)
    );
    let trained = succeeds(root.path(), "rom train rom.toml --out out");
    for (key, expected) in [("points", "64"), ("runs", "2"), ("frames", "10"), ("epochs", "5")] {
        assert_eq!(value(&trained, key).as_deref(), Some(expected), "{key}");
    }
    assert_refused(
        &parvi(root.path(), "report out"),
        &["out holds a model and no reduced runs: `parvi rom run` with"],
    );
    let run = succeeds(root.path(), "rom run rom.toml --out out");
    assert_eq!(stdout(&run).lines().count(), 2, "{}", stdout(&run));
    assert!(
        stdout(&run).starts_with("manifold=network samples=20 choice=greedy "),
        "{}",
        stdout(&run)
    );
    assert_eq!(
        files(&root.path().join("out")),
        [
            "checkpoint.safetensors",
            "config.toml",
            "coordinates.svg",
            "errors.svg",
            "frames.csv",
            "losses.csv",
            "losses.svg",
            "model.safetensors",
            "results.csv",
            "scene.toml",
            "speed_up.svg",
            "training_data.safetensors",
        ]
    );
    let figures = ["coordinates.svg", "errors.svg", "speed_up.svg"].map(|name| root.path().join("out").join(name));
    let drawn = [&figures[0], &figures[1]].map(|file| std::fs::read(file).unwrap());
    for file in &figures {
        std::fs::remove_file(file).unwrap();
    }
    let report = succeeds(root.path(), "report out");
    assert_eq!(stdout(&report).lines().count(), 2, "{}", stdout(&report));
    assert_eq!(
        [&figures[0], &figures[1]].map(|file| std::fs::read(file).unwrap()),
        drawn
    );
    assert!(figures[2].exists());

    // A run that failed has no error, and no part in figures and means.
    let table = root.path().join("out/results.csv");
    let rows = std::fs::read_to_string(&table).unwrap();
    let error = rows.lines().nth(1).and_then(|row| row.split(',').nth(10)).unwrap();
    std::fs::write(
        &table,
        rows.replacen("\"finished\"", "\"J < 0\"", 1).replacen(error, "", 1),
    )
    .unwrap();
    let report = succeeds(root.path(), "report out");
    let lines: Vec<String> = stdout(&report).lines().map(str::to_owned).collect();
    assert!(
        lines[0].ends_with(" finished=0/1") && lines[1].contains(" finished=1/1 mean_error_percent="),
        "{lines:?}"
    );
    let figure = std::fs::read_to_string(&figures[1]).unwrap();
    assert!(figure.contains("no part in the means: 1."), "{figure}");
}

#[test]
fn a_training_that_is_not_finished_has_no_report() {
    let root = tempfile::tempdir().unwrap();
    std::fs::create_dir(root.path().join("out")).unwrap();
    std::fs::write(root.path().join("out/config.toml"), EXPERIMENT).unwrap();
    std::fs::write(root.path().join("out/scene.toml"), SCENE).unwrap();
    assert_refused(
        &parvi(root.path(), "report out"),
        &["out holds a training that is not finished"],
    );
}

#[test]
fn what_is_wrong_is_named() {
    let root = tempfile::tempdir().unwrap();
    std::fs::write(root.path().join("strip.toml"), SCENE).unwrap();
    for (change, expected) in [
        (("strip.toml", "none.toml"), "rom.toml, scene: cannot read none.toml: "),
        (
            ("gravity.1", "gravity.7"),
            "rom.toml, keys.0.key: `gravity.7` does not fit the scene strip.toml",
        ),
        (("epochs = 5", "epoch = 5"), "rom.toml, line 7, column "),
        (("epochs = 5", "epochs = 0"), "epochs = 0"),
        (
            ("samples = [20", "samples = [3"),
            "rom.toml, run.samples: the number of sample points is 3, at least",
        ),
    ] {
        std::fs::write(root.path().join("rom.toml"), EXPERIMENT.replace(change.0, change.1)).unwrap();
        assert_refused(&parvi(root.path(), "rom train rom.toml --out out"), &[expected]);
    }
}

#[test]
fn committed_experiments_can_be_read() {
    // A directory that cannot be made: files are read first, so its name is in the message.
    let experiments = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("rom");
    let files = std::fs::read_dir(&experiments).unwrap();
    let names: Vec<String> = files
        .map(|file| file.unwrap().file_name().into_string().unwrap())
        .collect();
    assert!(names.len() >= 9, "{names:?}");
    for name in names {
        let message = stderr(&parvi(&experiments, &format!("rom run {name} --out {name}/out")));
        assert!(message.contains(&format!("{name}/out")), "{message}");
    }
}

#[test]
fn random_pokes_are_none_of_those_that_their_network_is_tested_on() {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("rom");
    let read = |name: &str| Experiment::read(&directory.join(name)).unwrap();
    let (pokes, random) = (read("poke.toml"), read("poke_random.toml"));
    assert_eq!(pokes.training, random.training);
    assert!(random.cases.test.iter().all(|angle| !pokes.cases.test.contains(angle)));
}

/// The points around the moved ones are stretched most when they are let go, after 36 frames.
#[test]
fn no_time_step_of_a_poke_is_cut() {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("rom");
    let pokes = Experiment::read(&directory.join("poke.toml")).unwrap();
    let document = SceneDocument::read(&pokes.scene_file()).unwrap();
    let mut scene = pokes.scene_of(&document, &pokes.cases.train[0]).unwrap();
    scene.time.end = 37.0 * scene.output.interval;
    let recording = Recording::<3>::of(&scene, &pokes.parameters, Some(1)).unwrap();
    recording.run_in_even_steps(&scene).unwrap();
}
