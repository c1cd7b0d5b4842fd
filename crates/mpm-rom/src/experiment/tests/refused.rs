//! What is wrong with an experiment, by file and field.

use super::*;

#[test]
fn what_is_wrong_is_named_with_its_file_and_field() {
    for (change, expected) in [
        (
            ("\"sin angle\"", "\"tan angle\""),
            "rom.toml, keys.0.product: [\"gravity\", \"tan angle\"]",
        ),
        (
            ("test = [[2.0, 0.1]]", "test = []"),
            "rom.toml, cases.test: at least one case",
        ),
        (
            ("[3.0, 0.2]", "[3.0]"),
            "rom.toml, cases.train.1: 1 values for 2 parameters",
        ),
        (
            ("[3.0, 0.2]", "[3.0, nan]"),
            "rom.toml, cases.train.1: NaN is not finite",
        ),
        (("epochs = 7", "epochs = 0"), "rom.toml, training: epochs = 0"),
        (
            ("samples = [20, \"all\"]", "samples = []"),
            "rom.toml, run.samples: at least one",
        ),
        (
            ("samples = [20, \"all\"]", "choice = []"),
            "rom.toml, run.choice: at least one",
        ),
        (
            ("samples = [20, \"all\"]", "exchanges = 9, samples = [25, \"all\"]"),
            "rom.toml, run.exchanges: only greedily chosen sample points are exchanged, 24 at most",
        ),
        (
            (
                "samples = [20, \"all\"]",
                "exchanges = 9, samples = [20], choice = [\"spread\"]",
            ),
            "rom.toml, run.exchanges: only greedily",
        ),
        (
            ("samples = [20, \"all\"]", "choice = [\"best\"]"),
            "unknown variant `best`",
        ),
        (
            ("samples = [20, \"all\"]", "samples = [\"some\"]"),
            "expected a number of points or \"all\" (in `run = {",
        ),
        (("width = 6", "breadth = 6"), "unknown field `breadth`"),
        (
            ("cases = {", "recorded_points = 0\ncases = {"),
            "rom.toml, recorded_points: 0",
        ),
        (
            (
                "cases = {",
                "frames_between = { per_frame = 1, distance = 0.1 }\ncases = {",
            ),
            "rom.toml, frames_between.per_frame: 1: at least 2",
        ),
        (
            (
                "cases = {",
                "frames_between = { per_frame = 2, distance = 0.0 }\ncases = {",
            ),
            "rom.toml, frames_between.distance: 0: must be positive",
        ),
        (
            ("cases = {", "recorded_points = 9\ncases = {"),
            "rom.toml, run.manifold: \"linear\" needs all points of the training: leave out recorded_points",
        ),
        (
            ("manifold = [\"network\",", "scene = \"fine.toml\", manifold = ["),
            "rom.toml, run.manifold: \"linear\" needs all points of the training: leave out run.scene",
        ),
        (
            ("manifold = [\"network\", \"linear\"]", "step_factor = []"),
            "rom.toml, run.step_factor: at least one",
        ),
        (
            ("cases = {", "variants = [{ name = \"a/b\" }]\ncases = {"),
            "rom.toml, variants.0.name: `a/b`",
        ),
        (
            (
                "cases = {",
                "variants = [{ name = \"a\" }, { name = \"a\" }]\ncases = {",
            ),
            "rom.toml, variants.1.name: `a`",
        ),
        (
            ("cases = {", "variants = [{ name = \"a\", weight = 1.0 }]\ncases = {"),
            "rom.toml, variants.0: unknown field `weight`",
        ),
        (
            ("cases = {", "variants = [{ name = \"a\", epochs = 0 }]\ncases = {"),
            "rom.toml, variants.0: epochs = 0",
        ),
    ] {
        let message = message(change);
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
