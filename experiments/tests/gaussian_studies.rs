//! The studies on N(0, I): small versions run to a report, and bad configurations are refused with the field's name.

mod support;

use std::path::Path;

use support::{assert_refused, assert_report, files, parvi, run_study, value};

const ACCURACY: &str = r#"
kind = "accuracy"
seeds = [1, 2, 3]
dims = [1, 2]
particles = [64, 16]
methods = [
    { name = "mpm", options = { steps = 20 } },
    { name = "mpm", label = "mpm, linear", options = { steps = 20, basis = "linear" }, largest-particles = 20 },
    { name = "iid" },
    { name = "sobol" },
    { name = "svgd", largest-particles = 16, options = { steps = 5 } },
]
"#;

/// Asserts that a study with one text replaced is refused before anything is written.
fn refused(study: &str, from: &str, to: &str, parts: &[&str]) {
    let root = tempfile::tempdir().unwrap();
    let text = study.replacen(from, to, 1);
    assert_ne!(text, study);
    std::fs::write(root.path().join("study.toml"), text).unwrap();
    let parts: Vec<&str> = parts.iter().copied().chain(["study.toml"]).collect();
    assert_refused(&parvi(root.path(), "run study.toml --out out"), &parts);
    assert_eq!(files(root.path()), ["study.toml"]);
}

/// The records of results.csv, by the names of the columns.
fn rows(root: &Path) -> Vec<std::collections::HashMap<String, String>> {
    let mut reader = csv::Reader::from_path(root.join("out/results.csv")).unwrap();
    reader.deserialize().map(|row| row.unwrap()).collect()
}

#[test]
fn accuracy() {
    let (root, output) = run_study(ACCURACY);
    let report = assert_report(root.path(), 1);
    // Per dimension: five methods with 16 particles, three with 64.
    assert_eq!(value(&output, "cases").unwrap(), (2 * 3 * (5 + 3)).to_string());
    assert_eq!(value(&output, "failed").unwrap(), "0");
    for text in [
        "svgd / sobol",
        "mpm, linear / sobol",
        "**d = 2**",
        "| best possible |",
        "−0.750",
    ] {
        assert!(report.contains(text), "{text} is missing in {report}");
    }
    assert!(!report.contains("sobol / sobol"));
    let rows = rows(root.path());
    let of = |series: &str| rows.iter().filter(|row| row["series"] == series).collect::<Vec<_>>();
    assert!(of("svgd").iter().all(|row| row["particles"] == "16"));
    assert!(
        of("mpm")
            .iter()
            .all(|row| !row["active_nodes"].is_empty() && row["steps"] == "20")
    );
    for row in &rows {
        let energy: f64 = row["energy_distance_squared"].parse().unwrap();
        assert!(energy > 0.0 && energy < 1.0, "{row:?}");
    }
}

#[test]
fn accuracy_without_sobol_has_no_ratios() {
    let text = ACCURACY.replace("{ name = \"sobol\" },\n", "");
    let (root, _) = run_study(&text);
    assert!(!assert_report(root.path(), 1).contains(" / sobol"));
}

#[test]
fn bad_accuracy() {
    refused(ACCURACY, "seeds = [1, 2, 3]", "seeds = []", &["seeds", "empty"]);
    refused(
        ACCURACY,
        "seeds = [1, 2, 3]",
        "seeds = [1, 1]",
        &["seeds", "d1-m64-mpm-t20-s1"],
    );
    refused(ACCURACY, "[1, 2]\n", "[]\n", &["dims", "empty"]);
    refused(ACCURACY, "[64, 16]", "[]", &["particles", "empty"]);
    refused(ACCURACY, "[64, 16]", "[64, 1]", &["line 5", "1 is out of range"]);
    refused(
        ACCURACY,
        "label = \"mpm, linear\", ",
        "",
        &["methods", "`mpm`", "label"],
    );
    refused(
        ACCURACY,
        "largest-particles = 20",
        "largest-particles = 0",
        &["0 is out of range"],
    );
    refused(
        ACCURACY,
        "largest-particles",
        "most-particles",
        &["`most-particles`", "largest-particles"],
    );
    refused(
        ACCURACY,
        "options = { steps = 5 }",
        "options = { basis = \"cubic\" }",
        &["basis", "svgd"],
    );
}
