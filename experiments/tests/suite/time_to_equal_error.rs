//! The study of times to equal error: a small version runs to a report, and what it cannot do is refused with the field's name.

use std::collections::HashMap;

use crate::support::{
    assert_holds, assert_refused, assert_reports_again, files, number, parvi, refused_lines, reported, rows, run_study,
    value,
};

const STUDY: &str = r#"
kind = "time-to-equal-error"
seeds = [0, 1, 2]
particles = [40, 80]
draws = { from = 50, to = 400 }
steps = { from = 5, to = 40 }
largest-ratio = 1000.0
reference-points = 2048
reference-seed = 1
targets = [{ name = "gaussian", dim = 2 }, { name = "wells-small" }]
method = { name = "mpm" }
rivals = [{ name = "iid" }, { name = "svgd" }]
"#;

fn find<'a>(rows: &'a [HashMap<String, String>], case: &str) -> &'a HashMap<String, String> {
    rows.iter()
        .find(|row| row["case"] == case)
        .unwrap_or_else(|| panic!("{case} is missing"))
}

#[test]
fn rivals_are_held_against_the_method() {
    let (root, output, report) = reported(STUDY, 1);
    let rows = rows(root.path());
    assert_eq!(rows.len(), 2 * 2 * 3);
    assert_eq!(
        value(&output, "unsupported").unwrap(),
        "2",
        "independent draws of a posterior"
    );
    assert_holds(
        &report,
        &["draws per particle", "## Against iid", "## Against svgd", "exact draws"],
    );
    for particles in ["40", "80"] {
        let own = find(&rows, &format!("gaussian-d2-m{particles}-mpm"));
        assert!(own["goal"].is_empty() && own["size"].is_empty(), "{own:?}");
        // Of independent draws exactly so many are needed that their expected error is the goal or just below.
        let draws = find(&rows, &format!("gaussian-d2-m{particles}-iid"));
        let (goal, size) = (number(draws, "goal"), number(draws, "size"));
        assert_eq!(goal, number(own, "energy_distance_squared"));
        let mean_distance = number(draws, "mean_distance");
        assert!(
            mean_distance / size <= goal && mean_distance / (size - 1.0) > goal,
            "{draws:?}"
        );
        // The search of a rival ends at the error or at one of its limits.
        for target in ["gaussian-d2", "wells-small"] {
            let rival = find(&rows, &format!("{target}-m{particles}-svgd"));
            let (goal, size) = (number(rival, "goal"), number(rival, "size"));
            let reached = rival["energy_distance_squared"]
                .parse::<f64>()
                .is_ok_and(|energy| energy <= goal);
            match rival["ending"].as_str() {
                "reached" => assert!(reached, "{rival:?}"),
                "out-of-sizes" => assert!(!reached && size == 40.0, "{rival:?}"),
                "out-of-time" => assert!(!reached, "{rival:?}"),
                _ => panic!("{rival:?}"),
            }
            if size > 5.0 {
                assert_eq!(number(rival, "missed_size"), size / 2.0);
            }
        }
    }
    let before = std::fs::read_to_string(root.path().join("out/report.md")).unwrap();
    assert_reports_again(root.path(), &before);
}

/// A chain's runs for the larger M are those for the smaller one, and more.
#[test]
fn chains_need_the_feature() {
    let text = STUDY.replace("{ name = \"iid\" }, { name = \"svgd\" }", "{ name = \"nuts\" }");
    if cfg!(not(feature = "nuts")) {
        let root = tempfile::tempdir().unwrap();
        std::fs::write(root.path().join("study.toml"), text).unwrap();
        assert_refused(
            &parvi(root.path(), "run study.toml --out out"),
            &["`nuts`", "--features nuts"],
        );
        assert_eq!(files(root.path()), ["study.toml"]);
        return;
    }
    let (root, _) = run_study(&text);
    let raw = |particles: usize| {
        let path = root.path().join(format!("out/raw/gaussian-d2-m{particles}-1-nuts.csv"));
        std::fs::read_to_string(path).unwrap()
    };
    assert!(raw(80).starts_with(&raw(40)));
    assert_eq!(rows(root.path()).len(), 2 * 2 * 2);
}

#[test]
fn bad_input() {
    refused_lines(
        STUDY,
        r#"
        seeds = [0, 1, 2] | seeds = [] | seeds | empty
        particles = [40, 80] | particles = [] | particles | empty
        particles = [40, 80] | particles = [40, 1] | line 4 | 1 is out of range
        particles = [40, 80] | particles = [40, 40] | particles | gaussian-d2-m40-mpm
        from = 50, to = 400 | from = 50, to = 40 | draws.to | 40 | 50
        from = 5, to = 40 | from = 5, to = 4 | steps.to | 4 | 5
        from = 5, to = 40 | from = 0, to = 4 | line 6 | 0 is out of range
        from = 5, to = 40 | from = 5 | line 6 | `to`
        largest-ratio = 1000.0 | largest-ratio = 0.0 | largest-ratio | 0
        targets = [{ name = "gaussian", dim = 2 }, { name = "wells-small" }] | targets = [] | targets | empty
        { name = "iid" } | { name = "sobol" } | rivals.name | `sobol`
        { name = "svgd" } | { name = "svgd", options = { steps = 7 } } | rivals.options.steps | `steps`
        reference-seed = 1\n |  | study.toml | reference-seed
        "#,
    );
}
