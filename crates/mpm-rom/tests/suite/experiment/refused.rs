//! What is wrong with an experiment, by file and field.

use super::*;

#[test]
fn what_is_wrong_is_named_with_its_file_and_field() {
    let table: toml::Table = include_str!("../../data/strip_rom_refused.toml").parse().expect("TOML");
    let rows: Vec<[String; 3]> = table["refused"].clone().try_into().expect("rows of texts");
    for [old, new, expected] in &rows {
        let message = message((old, new));
        assert!(message.contains(expected), "{message}");
    }
}

#[test]
fn a_key_that_does_not_fit_the_scene_is_named_with_the_file_that_asks_for_it() {
    let (directory, file) = files();
    let scene = directory.path().join("strip.toml");
    let cases = [
        (
            ("\"gravity.1\"", "\"gravity.7\""),
            "keys.1.key: `gravity.7`",
            "gravity has no `7`",
        ),
        (
            ("\"gravity.0\"", "\"mass\""),
            "keys.0.key: `mass`",
            "the scene has no `mass`",
        ),
        (
            ("\"gravity.0\"", "\"title\""),
            "keys.0.key: `title`",
            "expected a string",
        ),
    ];
    for (number, (change, field, reason)) in cases.into_iter().enumerate() {
        let experiment = Experiment::parse(&EXPERIMENT.replace(change.0, change.1), &file).expect("sound");
        let document = SceneDocument::read(&scene).expect("a scene");
        let errors = [
            experiment.scene_of(&document, &[1.0, 0.0]).expect_err("refused"),
            train::<2>(&experiment, &directory.path().join(number.to_string()), &mut ()).expect_err("refused"),
        ];
        for error in errors.map(|error| error.to_string()) {
            let expected = format!("{}, {field} does not fit the scene {}", file.display(), scene.display());
            assert!(error.starts_with(&expected) && error.contains(reason), "{error}");
        }
    }
    // A scene that is none without any change is to blame itself.
    std::fs::write(&scene, SCENE.replace("dimension", "dimensions")).expect("written");
    let experiment = Experiment::parse(EXPERIMENT, &file).expect("sound");
    let document = SceneDocument::read(&scene).expect("a document");
    let error = experiment
        .scene_of(&document, &[1.0, 0.0])
        .expect_err("refused")
        .to_string();
    assert!(
        error.contains("strip.toml, line 2, column 1: unknown field `dimensions`"),
        "{error}"
    );
}

#[test]
fn numbers_of_sample_points_and_scenes_that_are_not_there_are_refused_before_any_run() {
    let (directory, file) = files();
    let cases = [
        (("[20,", "[0,"), "run.samples: 0 sample points, at least 5 are needed"),
        (
            ("[20,", "[20, 65,"),
            "run.samples: 65 sample points of 64 material points",
        ),
        (("strip.toml", "none.toml"), "scene: "),
        (
            ("manifold = [\"network\", \"linear\"]", "scene = \"none.toml\""),
            "run.scene: ",
        ),
    ];
    for (number, ((old, new), expected)) in cases.into_iter().enumerate() {
        let experiment = Experiment::parse(&EXPERIMENT.replace(old, new), &file).expect("sound");
        let out = directory.path().join(number.to_string());
        let error = train_experiment(&experiment, &out, &mut ()).expect_err(new).to_string();
        let expected = format!("{}, {expected}", file.display());
        assert!(error.starts_with(&expected), "{error}");
        assert!(!out.exists(), "nothing was begun");
    }
}
