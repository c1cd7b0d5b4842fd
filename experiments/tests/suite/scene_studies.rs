//! The study `scenes`: a small one to its report, going on, and what it refuses.

use std::path::Path;

use crate::support::{
    assert_refused, assert_report, assert_reports_again, files, for_each_line, parvi, rows, stderr, succeeds, value,
};

const BAR: &str = include_str!("../../scenes/vibrating_bar.toml");

const STUDY: &str = r#"
kind = "scenes"
title = "Bars"

[[families]]
name = "bar"
title = "Vibrating bar"
scene = "scenes/bar.toml"
set = { "output.interval" = 10.0, "time.courant" = 0.4 }
x = "grid.spacing"
x-label = "spacing h (m)"
y-label = "error (%)"
read = { quantity = "error of the centre of mass / amplitude", factor = 100.0 }
judged = ["cubic"]
judgements = [{ kind = "order", at-least = 2.0 }, { kind = "bound", at = [1.0] }]
axes = [
    { key = "grid.basis", values = ["quadratic", "cubic"] },
    { key = "grid.spacing", values = [1.0, 0.5] },
    { choices = [{ set = { "time.end" = 10.0 } }, { set = { "time.end" = 10.5 } }], worst = true },
]

[[families]]
name = "end"
title = "End of the bar"
like = "bar"
y-label = "largest position of the end (m)"
read = { column = "upper_x", take = "largest", offset = -25.0, offsets = { "grid.spacing" = 0.25 } }
judgements = [{ kind = "spread", at-most = 0.5 }, { kind = "power-law", exponent = 0.0, tolerance = 1.0 }]
"#;

/// A study of a family of this name, and what else there is of it and of others.
fn family(name: &str, scene: &str, text: &str) -> String {
    let head = format!("[[families]]\nname = \"{name}\"\ntitle = \"Of {name}\"\nscene = \"scenes/{scene}.toml\"\n");
    format!("kind = \"scenes\"\ntitle = \"Families\"\n{head}{text}")
}

/// A directory with the scene and a study of it.
fn root(study: &str) -> tempfile::TempDir {
    let root = tempfile::tempdir().unwrap();
    std::fs::create_dir(root.path().join("scenes")).unwrap();
    std::fs::write(root.path().join("scenes/bar.toml"), BAR).unwrap();
    std::fs::write(root.path().join("study.toml"), study).unwrap();
    root
}

/// results.csv without the column of the wall time.
fn results(root: &Path) -> Vec<Vec<(String, String)>> {
    let sorted = rows(root).into_iter().map(|row| {
        let mut cells: Vec<_> = row.into_iter().filter(|(name, _)| name != "wall_seconds").collect();
        cells.sort();
        cells
    });
    sorted.collect()
}

#[test]
fn families_share_runs_and_are_judged() {
    let root = root(STUDY);
    let output = succeeds(root.path(), "run study.toml --out out");
    for (key, expected) in [("cases", "16"), ("failed", "0"), ("judged", "6"), ("verdict", "pass")] {
        assert_eq!(value(&output, key).as_deref(), Some(expected), "{key}");
    }
    let report = assert_report(root.path(), 2);
    assert!(report.contains("| Vibrating bar | cubic | order ≥ 2 |"), "{report}");
    assert!(
        report.contains("| Vibrating bar | cubic, x = 1 | at most 0.500 |"),
        "{report}"
    );
    assert!(!report.contains("| Vibrating bar | quadratic | order"), "{report}");

    let rows = rows(root.path());
    assert_eq!(rows[0]["case"], "bar: quadratic, spacing = 1, end = 10");
    assert_eq!((rows[0]["label"].as_str(), rows[0]["x"].as_str()), ("quadratic", "1.0"));
    assert_eq!(rows[0]["particles"], "50");
    assert!(!rows[0]["wall_seconds"].is_empty() && rows[8]["wall_seconds"].is_empty());
    assert_eq!(files(&root.path().join("out/raw")).len(), 8);

    // The report needs neither scenes nor runs.
    std::fs::remove_dir_all(root.path().join("scenes")).unwrap();
    std::fs::remove_dir_all(root.path().join("out/raw")).unwrap();
    assert_reports_again(root.path(), &report);
}

#[test]
fn a_torn_study_ends_with_the_same_results_and_changed_scenes_are_seen() {
    let root = root(STUDY);
    let run = || parvi(root.path(), "run study.toml --out out");
    assert!(run().status.success());
    let whole = results(root.path());
    let path = root.path().join("out/results.csv");
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::write(&path, &text[..text.len() / 2]).unwrap();
    assert!(run().status.success());
    assert_eq!(results(root.path()), whole);

    std::fs::write(
        root.path().join("scenes/bar.toml"),
        BAR.replace("density = 1.0", "density = 2.0"),
    )
    .unwrap();
    assert_refused(&run(), &["study.toml", "families.bar", "spacing = 1", "another scene"]);
}

#[test]
fn a_run_that_fails_is_a_row() {
    let study = STUDY.replace("\"quadratic\", \"cubic\"", "\"linear\"");
    let root = root(
        &study
            .replace("judged = [\"cubic\"]", "set.\"bodies.0.velocity.amplitude\" = [60.0]")
            .replace("set = { \"output.interval\" = 10.0, \"time.courant\" = 0.4 }\n", ""),
    );
    let output = succeeds(root.path(), "run study.toml --out out");
    assert_eq!(value(&output, "verdict").as_deref(), Some("fail"));
    assert_ne!(value(&output, "failed").as_deref(), Some("0"));
    let rows = rows(root.path());
    assert!(
        rows.iter()
            .any(|row| row["status"] == "diverged" && row["reason"].contains("step ")),
        "{rows:?}"
    );
}

/// Errors beside the exact motion and beside a finer run, which is run once; the finer run beside itself has that of the fit between its particles alone. Histories are drawn from the series.
#[test]
fn runs_are_compared_with_others() {
    let study = &family(
        "particles",
        "bar",
        r#"set = { "output.interval" = 1.0 }
x = ["mesh.generate.size", "grid.spacing"]
x-label = "spacing h (m)"
y-label = "error"
read = { particles = "displacement-error" }
judgements = [{ kind = "bound", reference = 0.0, tolerance = 0.01 }]
history = [{ column = "kinetic_energy + strain_energy", label = "energy (J)" }]
axes = [
    { choices = [
        { label = "grid" },
        { label = "mesh", set = { mesh = { generate = { kind = "segments", start = 0.0, end = 30.0, size = 1.0 } } }, drop = ["grid"] },
    ] },
    { key = "grid.spacing", values = [1.0] },
]

[[families]]
name = "finer"
title = "Beside a finer run"
like = "particles"
set = { "output.series_interval" = 0.5 }
y-label = "difference"
read = { particles = "displacement-error", against = { label = "fine", set = { "grid.spacing" = 0.5 } } }
axes = [{ key = "grid.spacing", values = [1.0, 0.5] }]

[[families]]
name = "centre"
title = "Centre of mass beside a finer run"
like = "finer"
y-label = "difference"
read = { column = "centre_x", take = "difference", against = { label = "fine", set = { "grid.spacing" = 0.5 } } }
history = [{ column = "centre_x", label = "centre of mass (m)" }]
drawn = [1.0]
"#,
    );
    let root = root(study);
    let output = succeeds(root.path(), "run study.toml --out out");
    assert_eq!(
        value(&output, "verdict").as_deref(),
        Some("pass"),
        "{}",
        stderr(&output)
    );
    assert_report(root.path(), 5);
    let rows = rows(root.path());
    let number = |row: usize| rows[row]["value"].parse::<f64>().unwrap();
    assert!(number(0) > 1e-5 && number(1) > 1e-5);
    assert!(number(2) > 1e-3 && number(3) < 1e-5, "{rows:?}");
    assert!(number(4) > 1e-5 && number(5) == 0.0, "{rows:?}");
    assert!(rows[0]["against"].is_empty() && rows[2]["against"] == rows[3]["scene"]);
    assert_eq!(files(&root.path().join("out/raw")).len(), 4);
}

/// Asserts that a study with one text replaced is refused before anything is written.
fn refused(from: &str, to: &str, parts: &[&str]) {
    let text = STUDY.replacen(from, to, 1);
    assert_ne!(text, STUDY);
    let root = root(&text);
    let parts: Vec<&str> = parts.iter().copied().chain(["study.toml"]).collect();
    assert_refused(&parvi(root.path(), "run study.toml --out out"), &parts);
    assert_eq!(files(root.path()), ["scenes", "study.toml"]);
}

#[test]
fn changes_that_the_scene_refuses() {
    let case = "case `quadratic, spacing = 1, end = 10`";
    refused(
        "\"output.interval\" = 10.0",
        "\"output.colour\" = 1",
        &[
            "families.bar",
            case,
            "scenes/bar.toml",
            "output.colour",
            "unknown field",
        ],
    );
    for_each_line(
        r#"
        "grid.basis" | "grid.basis.order" | families.bar | grid.basis.order | `basis` is neither a table nor an array
        "output.interval" | "bodies.3.fill" | families.bar | bodies.3.fill | elements 0 to 0
        values = [1.0, 0.5] | values = [1.0, -0.5] | spacing = -0.5 | grid.spacing
        "#,
        |line| refused(line[0], line[1], &line[2..]),
    );
}

#[test]
fn families_that_make_no_sense() {
    for_each_line(
        r#"
        values = [1.0, 0.5] | values = [] | families.bar.axes | axes.1 `values` is empty
        axes = [\n | axes = []\nignored = [\n | line | ignored
        x = "grid.spacing" | x = "grid.basis" | families.bar.x | `grid.basis` is no number
        like = "bar" | like = "beam" | families.end.like | `beam`
        name = "end" | name = "bar" | families.bar.name | another family
        scene = "scenes/bar.toml" | scene = "bar.toml" | families.bar.scene | bar.toml
        scene = "scenes/bar.toml"\n |  | families.bar.scene | is missing
        column = "upper_x",  |  | families.end.read | column
        [1.0, 0.5] | [1.0, 1.0] | families.axes | two cases
        at-least | at-most | line | at-most
        kind = "order" | kind = "orders" | line | orders | power-law
        judged = ["cubic"] | judged = ["cubics"] | families.bar.judged | `cubics` is no part
        at = [1.0] | at = [1.0, 2.0] | families.bar.judgements.1.at | no run has 2 as its x
        at-most = 0.5 | at-most = nan | families.end.judgements.0.at-most | must be a number
        factor = 100.0 | factor = nan | families.bar.read | must be numbers
        kind = "spread", at-most = 0.5 | kind = "bound", reference = 1.0 | families.end.judgements.0.tolerance | is missing
        judged = ["cubic"] | drawn = [3.0] | families.bar.drawn | no run has 3
        "grid.spacing" = 0.25 | "grid.width" = 0.25 | families.end.read.offsets | grid.width
        "#,
        |line| refused(line[0], line[1], &line[2..]),
    );
    let tables = "[[families]]\nname = \"none\"\ntitle = \"t\"\nscene = \"scenes/bar.toml\"\nx = \"grid.spacing\"\nx-label = \"x\"\ny-label = \"y\"\nread = { column = \"upper_x\" }\n\n[[families]]\nname = \"bar\"";
    refused(
        "[[families]]\nname = \"bar\"",
        tables,
        &["families.none.axes", "is empty"],
    );
}

#[test]
fn numbers_that_the_run_does_not_have() {
    for (from, to, parts) in [
        (
            "quantity = \"error of the centre",
            "quantity = \"horror of the centre",
            ["families.bar.read.quantity", "none of `error of the centre of mass"],
        ),
        (
            "column = \"upper_x\"",
            "column = \"upper_z\"",
            ["families.end.read.column", "`upper_x`"],
        ),
        (
            "judged = [",
            "history = [{ column = \"speed\", label = \"v\" }]\njudged = [",
            ["families.bar.history.column", "`speed` is none of `time`"],
        ),
    ] {
        let study = STUDY.replace(from, to).replace("[1.0, 0.5]", "[1.0]");
        let output = parvi(root(&study).path(), "run study.toml --out out");
        assert_refused(&output, &["study.toml", parts[0], parts[1]]);
    }
}

/// From wherever the command is called, a scene's mesh is looked for beside the scene.
#[test]
fn meshes_of_scenes_are_found_from_anywhere() {
    let study = &family(
        "disk",
        "disk",
        r#"x = "bodies.0.spacing"
x-label = "spacing (m)"
y-label = "kinetic energy (J)"
read = { column = "kinetic_energy", take = "largest" }
axes = [{ key = "bodies.0.spacing", values = [0.5] }]
"#,
    );
    let scene = r#"
title = "disk"
dimension = 2

[mesh]
file = "../meshes/disk.msh"

[transfer]
kind = "apic"

[time]
end = 1e-4

[materials.rubber]
law = "neo-hookean"
density = 1000.0
young_modulus = 1e5
poisson_ratio = 0.3

[[bodies]]
name = "ball"
material = "rubber"
shape = { kind = "sphere", centre = [0.0, 0.0], radius = 1.0 }
spacing = 0.5
velocity = [1.0, 0.0]

[output]
interval = 1e-4
"#;
    let root = root(study);
    std::fs::create_dir(root.path().join("meshes")).unwrap();
    std::fs::create_dir(root.path().join("elsewhere")).unwrap();
    std::fs::write(root.path().join("scenes/disk.toml"), scene).unwrap();
    let mesh = include_str!("../../meshes/disk.msh");
    std::fs::write(root.path().join("meshes/disk.msh"), mesh).unwrap();
    let output = succeeds(&root.path().join("elsewhere"), "run ../study.toml --out out");
    assert_eq!(value(&output, "failed").as_deref(), Some("0"));
}
