//! What is wrong with an experiment, by file and field.

use mpm_rom::online::ReducedBody;
use mpm_rom::training::TrainingError;

use super::*;

/// A training is refused with the experiment's file and this.
fn assert_not_begun(text: &str, file: &Path, out: &Path, expected: &str) {
    let experiment = Experiment::parse(text, file).expect("sound");
    let error = train_experiment(&experiment, out, &mut ())
        .expect_err(expected)
        .to_string();
    let expected = format!("{}, {expected}", file.display());
    assert!(error.starts_with(&expected), "{error}");
    assert!(!out.exists(), "nothing was begun");
}

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
fn a_run_names_what_is_left_to_the_training() {
    let (directory, file) = files();
    let text = EXPERIMENT.replace("cases = {", "variants = [{ name = \"other\", seed = 2 }]\ncases = {");
    let experiment = Experiment::parse(&text, &file).expect("sound");
    let out = directory.path().join("out");
    train_experiment(&experiment, &out, &mut ()).expect("trained");
    for name in [
        "training_data.safetensors",
        "other/model.safetensors",
        "model.safetensors",
    ] {
        let missing = out.join(name);
        std::fs::remove_file(&missing).expect("made by the training");
        let error = run_experiment(&experiment, &out, &mut |_, _| true).expect_err(name);
        let expected = format!("{} is missing: `parvi rom train` with ", missing.display());
        assert!(error.to_string().starts_with(&expected), "{error}");
    }
}

#[test]
fn numbers_of_sample_points_and_scenes_that_are_not_there_are_refused_before_any_run() {
    let (directory, file) = files();
    let cases = [
        (
            ("[20,", "[0,"),
            "run.samples: the number of sample points is 0, at least",
        ),
        (
            ("[20,", "[5,"),
            "run.samples: the number of sample points is 5, at least",
        ),
        (
            ("[20,", "[20, 65,"),
            "run.samples: 65 sample points of 64 material points",
        ),
        (("strip.toml", "none.toml"), "scene: cannot read "),
        (
            ("manifold = [\"network\", \"linear\"]", "scene = \"none.toml\""),
            "run.scene: cannot read ",
        ),
    ];
    for (number, ((old, new), expected)) in cases.into_iter().enumerate() {
        let out = directory.path().join(number.to_string());
        assert_not_begun(&EXPERIMENT.replace(old, new), &file, &out, expected);
    }
}

#[test]
fn what_no_reduced_run_can_have_is_refused_before_the_training() {
    let (directory, file) = files();
    let law = "law = \"fixed-corotated\"";
    for (number, (old, new, field)) in [
        ("step = 0.0050000001", "step = 0.003", "time.step"),
        (", step = 0.0050000001", "", "time.step"),
        ("kind = \"pic\"", "kind = \"apic\"", "transfer.kind"),
        ("dimension = 2", "dimension = 2\ngravity_ramp = 0.1", "gravity_ramp"),
        (
            "courant = 0.5",
            "courant = 0.5, stress_update = \"first\"",
            "time.stress_update",
        ),
        (law, "law = \"drucker-prager\", friction_angle = 30.0", "materials.law"),
    ]
    .into_iter()
    .enumerate()
    {
        assert!(SCENE.contains(old), "{old}");
        let (name, out) = (format!("other_{number}.toml"), directory.path().join("out"));
        let other = directory.path().join(&name);
        std::fs::write(&other, SCENE.replace(old, new)).expect("written");
        let of_run = format!("scene = \"{name}\", choice = [\"drawn\"]");
        for (old, new) in [
            ("\"strip.toml\"", format!("\"{name}\"")),
            ("manifold = [\"network\", \"linear\"]", of_run),
        ] {
            let experiment = Experiment::parse(&EXPERIMENT.replace(old, &new), &file).expect("sound");
            let document = SceneDocument::read(&experiment.run_scene_file()).expect("a scene");
            let scene = experiment.scene_of(&document, &[2.0, 0.1]).expect("a scene");
            let of_run = ReducedBody::<2>::of(&scene).map(|_| ()).expect_err("refused by a run");
            let error = train_experiment(&experiment, &out, &mut ())
                .expect_err(&new)
                .to_string();
            assert_eq!(error, of_run.to_string());
            assert!(
                error.starts_with(&format!("{}: {field}: must be ", other.display())),
                "{error}"
            );
            assert!(!out.exists(), "nothing was begun");
        }
    }
}

#[test]
fn a_scene_of_another_body_is_refused_before_the_training_and_before_a_run() {
    let (directory, file) = files();
    let linear = "manifold = [\"network\", \"linear\"]";
    let changed = [
        (
            "upper = [2.0, 0.5]",
            "upper = [2.5, 0.5]",
            "only one of them has a point at [2.",
        ),
        (
            "upper = [2.0, 0.5]",
            "upper = [1.5, 0.5]",
            "only one of them has a point at [1.",
        ),
        (
            "lower = [0.0, 0.0], upper = [2.0, 0.5]",
            "lower = [0.0, 0.5], upper = [2.0, 1.0]",
            "only one",
        ),
    ];
    let whole = directory.path().join("whole");
    train_one(&Experiment::read(&file).expect("sound"), &whole);
    for (old, new, expected) in changed {
        assert!(SCENE.contains(old));
        std::fs::write(directory.path().join("other.toml"), SCENE.replace(old, new)).expect("written");
        for key in ["scene", "super_resolution"] {
            let text = EXPERIMENT.replace(linear, &format!("{key} = \"other.toml\""));
            let field = format!("run.{key}: another body than that of the training: {expected}");
            assert_not_begun(&text, &file, &directory.path().join("out"), &field);
            let experiment = Experiment::parse(&text, &file).expect("sound");
            let error = run::<2>(&experiment, &whole, &mut |_, _| true).expect_err("another body");
            assert!(error.to_string().contains(&field), "{error}");
        }
    }
}

#[test]
fn a_step_factor_that_does_not_divide_a_frame_is_refused_before_the_training() {
    let (directory, file) = files();
    for factor in [0, 7] {
        let run = format!("step_factor = [1, {factor}]");
        let text = EXPERIMENT.replace("manifold = [\"network\", \"linear\"]", &run);
        let expected = format!("run.step_factor: {factor} does not divide the ");
        assert_not_begun(&text, &file, &directory.path().join("out"), &expected);
    }
}

#[test]
fn a_scene_that_has_changed_since_its_runs_were_made_is_refused_with_its_file() {
    let (directory, file) = files();
    let text = EXPERIMENT.replace("samples = [20, \"all\"]", "samples = [\"all\"]");
    let experiment = Experiment::parse(&text, &file).expect("sound");
    let (out, scene) = (directory.path().join("out"), directory.path().join("strip.toml"));
    train_one(&experiment, &out);
    std::fs::write(&scene, format!("# A comment.\n{SCENE}")).expect("written");
    train_one(&experiment, &out);
    let softer = SCENE.replace("young_modulus = 500.0", "young_modulus = 400.0");
    assert_ne!(softer, SCENE);
    std::fs::write(&scene, softer).expect("written");
    for error in [
        train::<2>(&experiment, &out, &mut ()).expect_err("other data"),
        run::<2>(&experiment, &out, &mut |_, _| true).expect_err("another model"),
    ] {
        assert!(matches!(error, ExperimentError::ChangedScene { .. }), "{error}");
        let expected = format!("{}: changed since it was trained on", scene.display());
        assert!(error.to_string().starts_with(&expected), "{error}");
    }
    // What an earlier version left.
    std::fs::remove_file(out.join(names::SCENE)).expect("removed");
    let rows = run::<2>(&experiment, &out, &mut |_, _| true).expect("run");
    assert_eq!(rows.len(), 4);
}

#[test]
fn instants_that_do_not_divide_a_frame_are_refused_before_anything_is_written() {
    let (directory, file) = files();
    let text = EXPERIMENT.replace(
        "cases = {",
        "frames_between = { per_frame = 3, distance = 0.01 }\ncases = {",
    );
    let expected =
        "frames_between.per_frame: the number of instants per frame, 3, does not divide that of its steps, 10";
    assert_not_begun(&text, &file, &directory.path().join("out"), expected);
}

#[test]
fn training_data_of_another_experiment_are_refused() {
    let (directory, file) = files();
    let [own, other] = ["own", "other"].map(|name| directory.path().join(name));
    let (train_own, scene) = ("train = [[1.0, 0.0], [3.0, 0.2]]", directory.path().join("strip.toml"));
    let longer = SCENE.replace("upper = [2.0, 0.5]", "upper = [2.25, 0.5]");
    let changes = [
        (
            train_own,
            "train = [[1.0, 0.0]]",
            "1 run, where the experiment has 2 runs",
        ),
        (
            train_own,
            "train = [[1.0, 0.0], [3.0, 0.2], [1.0, 0.1]]",
            "3 runs, where the experiment has 2 runs",
        ),
        (
            train_own,
            "train = [[1.0, 0.0], [3.0, 0.3]]",
            "run 1 of [3.0, 0.3], where the experiment has [3.0, 0.2]",
        ),
        (
            "title = \"A strip\"",
            "title = \"A strip\"",
            "72 points, where the experiment has 64 points",
        ),
    ];
    let experiment = Experiment::parse(EXPERIMENT, &file).expect("sound");
    train_one(&experiment, &own);
    for (old, new, expected) in changes {
        if old == new {
            std::fs::write(&scene, &longer).expect("written");
        }
        train_one(
            &Experiment::parse(&EXPERIMENT.replace(old, new), &file).expect("sound"),
            &other,
        );
        std::fs::write(&scene, SCENE).expect("written");
        let data = own.join(names::TRAINING_DATA);
        std::fs::copy(other.join(names::TRAINING_DATA), &data).expect("copied");
        let error = run::<2>(&experiment, &own, &mut |_, _| true)
            .expect_err("other data")
            .to_string();
        assert!(error.starts_with(&format!("{}: {expected}", data.display())), "{error}");
        std::fs::remove_dir_all(&other).expect("removed");
    }
    let error = train::<2>(&experiment, &own, &mut ()).expect_err("other data");
    assert!(
        matches!(error, ExperimentError::Training(TrainingError::OtherCheckpoint { .. })),
        "as many runs of as many parameters: {error}"
    );
}

#[test]
fn runs_whose_steps_are_cut_are_refused() {
    let (directory, file) = files();
    let out = directory.path().join("out");
    let scene = directory.path().join("strip.toml");
    let experiment = Experiment::parse(EXPERIMENT, &file).expect("sound");
    for (old, new, found, expected) in [
        (
            "interval = 0.05",
            "interval = 0.05, series_interval = 0.013",
            "48",
            "40",
        ),
        ("end = 0.2,", "end = 0.2025,", "41", "40.5"),
    ] {
        assert!(SCENE.contains(old), "{old}");
        std::fs::write(&scene, SCENE.replace(old, new)).expect("written");
        let error = train::<2>(&experiment, &out, &mut ()).expect_err(new).to_string();
        let expected = format!(
            "run 0 (gravity = 1.0, angle = 0.0): {}: the number of time steps is {found}, where time.step = 0.0050000001 makes {expected}",
            scene.display()
        );
        assert!(error.starts_with(&expected), "{error}");
        assert!(!out.join(names::TRAINING_DATA).exists());
    }
}

#[test]
fn names_of_parameters_are_columns_of_their_own() {
    let (directory, file) = files();
    let out = directory.path().join("out");
    let text = EXPERIMENT.replace("samples = [20, \"all\"]", "samples = [\"all\"]");
    let experiment = Experiment::parse(&text, &file).expect("sound");
    train_one(&experiment, &out);
    run::<2>(&experiment, &out, &mut |_, _| true).expect("run");
    let table = std::fs::read_to_string(out.join(names::RESULTS)).expect("a table");
    let head = table.lines().next().expect("a head").split(',');
    let columns = head.filter(|name| !experiment.parameters.iter().any(|own| own == name));
    for name in columns.chain(["gravity", "a,b", "a\\nb", ""]) {
        let message = message(("\"angle\"]\nkeys", &format!("\"{name}\"]\nkeys")));
        assert!(message.starts_with("rom.toml, parameters.1: "), "{name}: {message}");
    }
}

#[test]
fn a_linear_manifold_of_more_coordinates_than_there_are_is_named_with_its_field() {
    let (directory, file) = files();
    let text = EXPERIMENT.replace("coordinates = 2", "coordinates = 9");
    let experiment = Experiment::parse(&text, &file).expect("sound");
    let out = directory.path().join("out");
    train_one(&experiment, &out);
    let error = run::<2>(&experiment, &out, &mut |_, _| true)
        .expect_err("8 frames that move")
        .to_string();
    let expected = format!(
        "{}, run.manifold: \"linear\": the number of coordinates is 9, ",
        file.display()
    );
    assert!(error.starts_with(&expected), "{error}");
}
