//! What stands for a target without exact draws: particles are not held against a sample that is worth too little.

use crate::support::{assert_holds, number, reported, rows, run_study, value};

/// A ring of radius 10 and width 0.1, of which an importance sample about its centre meets a few points.
const RING: &str = "
import sys
for line in sys.stdin:
    what, x, y = line.split()
    radius = (float(x) ** 2 + float(y) ** 2) ** 0.5
    print('' if what == 'score' else -0.5 * ((radius - 10.0) / 0.1) ** 2, flush=True)
";

/// A study with a target that `program` evaluates, or `None` where there is no Python.
fn with_ring(study: &str) -> Option<(tempfile::TempDir, String)> {
    let python = std::process::Command::new("python3").arg("--version").output();
    python.ok()?;
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("ring.py");
    std::fs::write(&file, RING).unwrap();
    let program = format!("python3 '{}'", file.display());
    let target = format!("{{ name = \"program\", dim = 2, parameters = {{ program = \"{program}\" }} }}");
    Some((directory, study.replace("RING", &target)))
}

#[test]
fn errors_beside_a_poor_reference_are_not_stated() {
    let study = r#"
        kind = "time-error"
        seeds = [0]
        particles = 100
        steps = [5]
        reference-points = 1000
        reference-seed = 1
        directions = 4
        targets = [RING, { name = "wells-small" }]
        methods = [{ name = "svgd" }, { name = "iid" }]
    "#;
    let Some((_directory, study)) = with_ring(study) else {
        return;
    };
    let (root, output, report) = reported(&study, 4);
    let rows = rows(root.path());
    assert_eq!(value(&output, "no_reference").unwrap(), "2");
    assert_eq!(value(&output, "diverged").unwrap(), "0");
    for row in &rows[..2] {
        assert_eq!(row["status"], "no-reference", "{row:?}");
        assert!(row["energy_distance_squared"].is_empty() && row["energy_level"].is_empty());
        assert!(row["note"].contains("independent draws, not 100"), "{row:?}");
        assert!(number(row, "reference_size") < 100.0, "{row:?}");
    }
    for row in &rows[2..] {
        assert_eq!(row["status"], "finished", "{row:?}");
        assert!(number(row, "reference_size") > 1e5 && number(row, "energy_distance_squared") > 0.0);
    }
    assert_holds(
        &report,
        &[
            "independent draws have ED² – and SW₂ –",
            "## References",
            "| wells-small | ",
            "## Runs that are held against nothing",
            "-svgd-m100-t5-s0`: no-reference: the importance sample",
        ],
    );
}

#[test]
fn nothing_is_searched_for_without_a_reference() {
    let study = r#"
        kind = "time-to-equal-error"
        targets = [RING, { name = "wells-small" }]
        method = { name = "mpm" }
        rivals = [{ name = "svgd" }]
        seeds = [0]
        particles = [2000, 40]
        draws = { from = 50, to = 50 }
        steps = { from = 5, to = 5 }
        largest-ratio = 1000.0
        reference-points = 1024
        reference-seed = 1
    "#;
    let Some((_directory, study)) = with_ring(study) else {
        return;
    };
    let (root, output) = run_study(&study);
    let rows = rows(root.path());
    let endings: Vec<&str> = rows.iter().map(|row| row["ending"].as_str()).collect();
    // A sample of 1024 points suffices for 40 particles and not for 2000.
    assert_eq!(endings[..6], ["no-reference"; 6]);
    assert!(!endings[6..].contains(&"no-reference"), "{rows:?}");
    assert!(rows[4]["reason"].contains("independent draws, not 2000"), "{rows:?}");
    assert_eq!(value(&output, "no_reference").unwrap(), "3", "rivals alone are counted");
}
