//! The study on random targets: a small version runs to a report, and bad configurations are refused with the field's name.

use std::collections::HashMap;

use crate::support::{assert_holds, number, refused_lines, reported, rows, run_study, value};

const STUDY: &str = r#"
kind = "random-targets"
seed = 3
dims = [1, 2]
target-seeds = { first = 5, count = 3 }
particles = 60
reference-points = 1024
reference-seed = 1
methods = [{ name = "ais", options = { evaluations = 3000 } }, { name = "mpm", label = "body", options = { survey = "off", steps = 5 } }, { name = "iid" }]
"#;

#[test]
fn random_targets() {
    let (root, output, report) = reported(STUDY, 1);
    let first = rows(root.path());
    assert_eq!(value(&output, "cases").unwrap(), "18");
    assert_holds(
        &report,
        &["## d = 2", "better than body", "| ais | 3/3 |", "frame: identity"],
    );
    for row in &first {
        let ratio = number(row, "energy_distance_squared") / number(row, "energy_level");
        assert!(ratio > -0.05 && ratio.is_finite(), "{row:?}");
        let is_pool = row["method"] == "ais";
        assert_eq!(row["log_evidence_deviation"].is_empty(), !is_pool, "{row:?}");
        match row["method"].as_str() {
            "ais" => assert!(number(row, "density_evaluations") > 500.0, "{row:?}"),
            "body" => assert!(number(row, "score_evaluations") > 0.0, "{row:?}"),
            _ => assert!(ratio < 8.0, "{row:?}"),
        }
    }
    // Rows depend on the seeds only, and draws not on the frame.
    let (again, _) = run_study(STUDY);
    let (own, _) = run_study(&STUDY.replace("particles = 60", "particles = 60\nframe = \"own\""));
    let same = |row: &HashMap<String, String>, other: &HashMap<String, String>| {
        row.iter()
            .all(|(name, value)| name.starts_with("wall") || other[name] == *value)
    };
    assert!(
        first
            .iter()
            .zip(&rows(again.path()))
            .all(|(row, other)| same(row, other))
    );
    let own = rows(own.path());
    for (row, other) in first.iter().zip(&own) {
        assert_eq!(same(row, other), row["method"] == "iid", "{row:?} and {other:?}");
    }
}

#[test]
fn bad_random_targets() {
    refused_lines(
        STUDY,
        r#"
        dims = [1, 2] | dims = [] | dims | empty
        dims = [1, 2] | dims = [2, 2] | dims or methods | random-d2-seed5-ais
        count = 3 | count = 0 | line 5 | 0 is out of range
        first = 5,  |  | line 5 | first
        particles = 60 | particles = 60\nframe = "best" | line 7 | best | identity
        label = "body",  | label = "ais",  | random-d1-seed5-ais
        evaluations = 3000 | evaluations = 0 | 0 is out of range
        evaluations = 3000 | pool = "p.csv" | pool | p.csv | study
        survey = "off" | survey = "off", evaluations = 10 | evaluations | needs a survey
        "#,
    );
}
