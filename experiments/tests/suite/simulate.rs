//! `parvi simulate`: files, lines, refusals, going on after Ctrl-C.

use crate::support::{assert_refused, files, interrupted, parvi, stderr, stdout, succeeds, value};

const SCENE: &str = r#"
title = "falling block"
dimension = 2
gravity = [0.0, -1.0]
domain = { lower = [0.0, 0.0], upper = [2.0, 2.0] }
grid = { spacing = 0.25 }
time = { end = 0.5 }
materials.rubber = { law = "neo-hookean", density = 1.0, young_modulus = 10.0, poisson_ratio = 0.3 }
output = { interval = 0.25, series_interval = 0.05 }

[[bodies]]
name = "block"
shape = { kind = "box", lower = [0.5, 1.0], upper = [1.0, 1.5] }
material = "rubber"

[[probes]]
name = "corner"
at = [1.0, 1.0]
"#;

#[test]
fn a_scene_leaves_frames_series_and_figures() {
    let root = tempfile::tempdir().unwrap();
    std::fs::write(root.path().join("scene.toml"), SCENE).unwrap();
    let output = succeeds(root.path(), "simulate scene.toml --out out");
    assert_eq!(value(&output, "outcome").as_deref(), Some("finished"));
    assert_eq!(value(&output, "time").as_deref(), Some("0.5"));
    assert_eq!(value(&output, "particles").as_deref(), Some("16"));
    for key in ["scene", "steps", "wall_seconds", "nanoseconds_per_particle_step"] {
        assert!(value(&output, key).is_some(), "{key} is missing in {}", stdout(&output));
    }
    assert_eq!(
        files(&root.path().join("out")),
        [
            "checkpoint.cbor",
            "particles.pvd",
            "particles_000000.vtu",
            "particles_000001.vtu",
            "particles_000002.vtu",
            "scene.toml",
            "series.csv",
            "series_centre_of_mass.svg",
            "series_energies.svg",
            "series_extent.svg",
            "series_momenta.svg",
            "series_probe_corner.svg",
        ]
    );
    // A finished run is not run again.
    let again = parvi(root.path(), "simulate scene.toml --out out");
    assert_eq!(value(&again, "resumed_at").as_deref(), Some("0.5"));
    assert_eq!(value(&again, "steps"), value(&output, "steps"));
}

#[test]
fn a_run_anew_leaves_nothing_of_an_earlier_one() {
    let root = tempfile::tempdir().unwrap();
    let scene = root.path().join("scene.toml");
    std::fs::write(
        &scene,
        SCENE.replace("end = 0.5", "end = 1.0").replace("corner", "edge"),
    )
    .unwrap();
    succeeds(root.path(), "simulate scene.toml --out out");
    let out = root.path().join("out");
    std::fs::remove_file(out.join("checkpoint.cbor")).unwrap();
    std::fs::write(out.join("notes.txt"), "mine").unwrap();
    std::fs::write(&scene, SCENE).unwrap();
    succeeds(root.path(), "simulate scene.toml --out out");
    succeeds(root.path(), "simulate scene.toml --out fresh");
    let mut expected = files(&root.path().join("fresh"));
    expected.push("notes.txt".to_owned());
    expected.sort();
    assert_eq!(files(&out), expected);
}

#[test]
fn files_of_other_commands_are_refused_with_the_command_for_them() {
    let root = tempfile::tempdir().unwrap();
    let files = [
        ("scene.toml", SCENE, "a scene, which `parvi simulate` takes"),
        (
            "study.toml",
            "kind = \"quickstart\"",
            "the configuration of a study, which `parvi run` takes",
        ),
        (
            "rom.toml",
            "scene = \"scene.toml\"\ncases = {}",
            "the configuration of a reduced-order model, which `parvi rom train|run` takes",
        ),
    ];
    for (name, text, _) in files {
        std::fs::write(root.path().join(name), text).unwrap();
    }
    for (command, own) in [
        ("simulate", "scene.toml"),
        ("run", "study.toml"),
        ("rom train", "rom.toml"),
        ("rom run", "rom.toml"),
    ] {
        for (name, _, message) in files.into_iter().filter(|(name, ..)| *name != own) {
            let output = parvi(root.path(), &format!("{command} {name} --out out"));
            assert_refused(&output, &[&format!("{name} seems to be {message}; this command takes")]);
            assert_eq!(output.status.code(), Some(2));
        }
    }
    assert!(!root.path().join("out").exists());
}

#[test]
fn bad_scenes_are_refused_with_file_field_and_value() {
    let root = tempfile::tempdir().unwrap();
    let cases = [
        ("spacing = 0.25", "spacings = 0.25", "unknown field `spacings`"),
        (
            "poisson_ratio = 0.3",
            "poisson_ratio = 0.5",
            "materials.rubber.poisson_ratio = 0.5",
        ),
        ("end = 0.5", "end = 0.5, step = 1.0", "time.step = 1"),
    ];
    for (from, to, part) in cases {
        std::fs::write(root.path().join("bad.toml"), SCENE.replace(from, to)).unwrap();
        assert_refused(&parvi(root.path(), "simulate bad.toml --out out"), &["bad.toml", part]);
    }
    assert_refused(
        &parvi(root.path(), "simulate none.toml --out out"),
        &["none.toml: cannot be read"],
    );
}

#[test]
fn what_cannot_be_reported_is_named() {
    let root = tempfile::tempdir().unwrap();
    std::fs::write(root.path().join("scene.toml"), SCENE).unwrap();
    let series = root.path().join("out/series.csv");
    succeeds(root.path(), "simulate scene.toml --out out");
    let whole = std::fs::read_to_string(&series).unwrap();
    let header = whole.lines().next().unwrap();
    for (text, expected) in [
        (
            whole.replacen("\n0.05,", "\n0.05,1.0,", 1),
            "series.csv, line 3: the number of values is 22, that of columns 21",
        ),
        (
            whole.replacen("\n0.05,", "\nx,", 1),
            "series.csv, line 3: time = `x`: must be a number",
        ),
        (format!("{header}\n"), "series.csv: no rows"),
    ] {
        assert_ne!(text, whole);
        std::fs::write(&series, text).unwrap();
        assert_refused(&parvi(root.path(), "report out"), &[expected]);
    }
    std::fs::remove_file(&series).unwrap();
    assert_refused(
        &parvi(root.path(), "report out"),
        &["cannot read out/series.csv: No such file"],
    );
    assert_refused(&parvi(root.path(), "report none"), &["cannot read none: No such file"]);
    assert_refused(
        &parvi(root.path(), "report scene.toml"),
        &["cannot read scene.toml: Not a directory"],
    );
}

/// A filling of ten million particles is not waited for.
#[cfg(unix)]
#[test]
fn a_run_that_has_not_begun_is_ended_at_once() {
    let root = tempfile::tempdir().unwrap();
    let fine = SCENE.replace(
        "material = \"rubber\"\n",
        "material = \"rubber\"\nfill = \"poisson-disk\"\nspacing = 2e-4\n",
    );
    assert_ne!(fine, SCENE);
    std::fs::write(root.path().join("scene.toml"), fine).unwrap();
    let start = std::time::Instant::now();
    let waited = || start.elapsed().as_millis() > 300;
    let output = interrupted(root.path(), "simulate scene.toml --out out", waited);
    assert!(
        start.elapsed().as_secs() < 5 && stderr(&output).is_empty(),
        "{}",
        stderr(&output)
    );
    assert!(!root.path().join("out").exists());
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_goes_on_to_the_same_bits() {
    let root = tempfile::tempdir().unwrap();
    let slow = SCENE.replace("time = { end = 0.5 }", "time = { end = 0.5, step = 4e-5 }");
    let scene = slow.replace("interval = 0.25, series_interval = 0.05", "interval = 0.05");
    std::fs::write(root.path().join("scene.toml"), scene).unwrap();
    let whole = succeeds(root.path(), "simulate scene.toml --out whole");
    let second = root.path().join("part/particles_000001.vtu");
    let part = interrupted(root.path(), "simulate scene.toml --out part", || second.exists());
    let said = stderr(&part);
    assert!(
        said.contains("stopping after the step or run at hand") && said.contains("the same line started again goes on"),
        "{said}"
    );
    assert_eq!(value(&part, "outcome").as_deref(), Some("interrupted"));
    let rest = succeeds(root.path(), "simulate scene.toml --out part");
    assert_eq!(value(&rest, "steps"), value(&whole, "steps"));
    for name in ["series.csv", "particles_000010.vtu", "particles.pvd"] {
        let [whole, part] = ["whole", "part"].map(|run| std::fs::read(root.path().join(run).join(name)).unwrap());
        assert_eq!(whole, part, "{name}");
    }
}
