//! The studies on the catalogue of targets: small versions run to a report, and bad configurations are refused with the field's
//! name.

use crate::support::{assert_holds, number, refused, refused_lines, reported, rows, run_study, value};

const CATALOGUE: &str = r#"
kind = "catalogue"
seeds = [0, 1]
particles = 200
dims = [1, 2]
targets = [{ name = "gaussian", parameters = { correlation = 0.9 } }, { name = "mixture-2" }, { name = "banana" }, { name = "wells-small" }]
starts = [{ mean = 0.0, standard-deviation = 1.0 }, { mean = 3.0, standard-deviation = 0.5 }]
methods = [{ name = "mpm" }, { name = "paper-pic", options = { steps = 5 } }, { name = "iid" }, { name = "sobol" }]
reference-points = 2048
reference-seed = 1
directions = 8
draws = 5
"#;

const STABILITY: &str = r#"
kind = "stability"
seed = 3
cases = 60
dims = [1, 2, 3]
"#;

#[test]
fn catalogue() {
    let (root, output, report) = reported(CATALOGUE, 1);
    let rows = rows(root.path());
    // Seven targets, two methods from two starts and two without a start, two seeds.
    assert_eq!(rows.len(), 7 * (2 * 2 + 2) * 2);
    assert_eq!(value(&output, "cases").unwrap(), rows.len().to_string());
    assert_eq!(value(&output, "judged").unwrap(), (7 * 2 * 2).to_string());
    let missed: usize = value(&output, "missed").unwrap().parse().unwrap();
    assert_eq!(
        report.matches("of independent draws, at most").count(),
        missed,
        "{report}"
    );
    assert_holds(
        &report,
        &[
            "one mode, light tails, d ≤ 4",
            "funnel, Student t, mixtures",
            "## From N(3, 0.5²)",
            "gaussian-d2-r0.9",
            "## Claims",
            "## References",
            "| wells-small",
        ],
    );
    let claimed: usize = value(&output, "claimed").unwrap().parse().unwrap();
    assert!(claimed > 0, "{report}");
    assert_eq!(value(&output, "false_claims").unwrap(), "0");
    assert!(!rows.iter().any(|row| row["target"].starts_with("banana-d")));
    for row in rows.iter().filter(|row| row["status"] == "finished") {
        let ratio = number(row, "energy_distance_squared") / number(row, "energy_level");
        assert!(ratio > -0.05 && ratio.is_finite(), "{row:?}");
        let judges_itself = row["method"] == "mpm" || row["method"].starts_with("paper");
        assert_eq!(row["outcome"].is_empty(), !judges_itself, "{row:?}");
        assert_eq!(row["mass_error"].is_empty(), !row["target"].starts_with("mixture"));
        if row["method"] == "iid" {
            assert!(ratio < 8.0, "{row:?}");
            assert!(
                row["start_mean"].is_empty() && row["score_evaluations"] == "0",
                "{row:?}"
            );
        }
        if row["method"] == "mpm" && row["target"] == "gaussian-d2-r0.9" && row["start_mean"] == "0.0" {
            assert!(ratio < 0.5 && number(row, "mean_error") < 0.1, "{row:?}");
        }
    }
    let unsupported: Vec<_> = rows.iter().filter(|row| row["status"] == "unsupported").collect();
    assert!(
        unsupported.len() == 4 && unsupported.iter().all(|row| row["method"] == "sobol"),
        "Sobol points of a posterior: {unsupported:?}"
    );
}

/// The measured distances belong to the target, not to the points that stand for it: with as many reference points per particle
/// as the committed study has, two scramblings agree to 1 % of the level of independent draws.
#[test]
fn the_reference_hardly_matters() {
    let distances = |seed: u64| {
        let text = format!(
            r#"
            kind = "catalogue"
            seeds = [0]
            particles = 64
            dims = [2, 4]
            targets = [{{ name = "funnel" }}, {{ name = "student-t" }}, {{ name = "mixture-3" }}, {{ name = "wells-small" }}]
            starts = [{{ mean = 0.0, standard-deviation = 1.0 }}]
            methods = [{{ name = "mpm" }}]
            reference-points = 8192
            reference-seed = {seed}
            directions = 2
            draws = 1
            "#
        );
        let (root, _) = run_study(&text);
        rows(root.path())
            .iter()
            .map(|row| {
                let ratio = number(row, "energy_distance_squared") / number(row, "energy_level");
                (row["case"].clone(), ratio)
            })
            .collect::<Vec<_>>()
    };
    let (first, second) = (distances(1), distances(2));
    assert_eq!(first.len(), 8);
    for ((case, first), (_, second)) in first.iter().zip(&second) {
        assert!((first - second).abs() < 0.01, "{case}: {first} and {second}");
    }
}

#[test]
fn bad_catalogue() {
    refused_lines(
        CATALOGUE,
        r#"
        seeds = [0, 1] | seeds = [] | seeds | empty
        seeds = [0, 1] | seeds = [0, 0] | seeds | gaussian-d1-r0.9-mpm-m200-mean0-sd1-s0
        dims = [1, 2] | dims = [] | dims | empty
        dims = [1, 2] | dims = [9] | line 5 | 9 is out of range
        dims = [1, 2] | dims = [1] | targets | `banana` | `dims`
        "mixture-2" | "mixture-9" | mixture-9 | mixture-3
        correlation = 0.9 | width = 0.9 | gaussian | width
        standard-deviation = 0.5 | standard-deviation = 0.0 | starts.standard-deviation | 0
        mean = 3.0 | mean = inf | starts.mean | inf
        "#,
    );
    let moving = r#"{ name = "mpm" }, { name = "paper-pic", options = { steps = 5 } }, "#;
    refused(CATALOGUE, moving, "", &["methods", "`iid`"]);
    refused_lines(
        CATALOGUE,
        r#"
        options = { steps = 5 } | options = { start-sd = 5.0 } | start-sd | `starts`
        reference-points = 2048 | reference-points = 20 | line 9 | 20 is out of range
        draws = 5 | draw = 5 | line 12 | `draw`
        { name = "mixture-2" }, { name = "banana" } | { name = "logistic" } | targets | logistic | data
        "#,
    );
    let planar = CATALOGUE.replace(
        "{ name = \"mixture-2\" }, { name = \"banana\" }, { name = \"wells-small\" }",
        "",
    );
    let planar = planar.replace("\"gaussian\", parameters = { correlation = 0.9 }", "\"ring\"");
    refused(&planar, "dims = [1, 2]", "dims = [1]", &["targets", "`dims`"]);
}

#[test]
fn stability() {
    let (root, output, report) = reported(STABILITY, 1);
    let all = rows(root.path());
    assert_eq!(all.len(), 60);
    assert_eq!(value(&output, "panicked").unwrap(), "0", "{report}");
    assert_eq!(value(&output, "not_finite").unwrap(), "0", "{report}");
    for row in &all {
        match row["ending"].as_str() {
            "finite" => assert!(row["reason"].is_empty() && number(row, "reach") >= 0.0, "{row:?}"),
            _ => assert!(!row["reason"].is_empty() && !row["message"].is_empty(), "{row:?}"),
        }
    }
    assert_holds(
        &report,
        &[
            "| mpm |",
            "guards off",
            "frame / target's frame",
            "Panics and numbers that are not finite",
        ],
    );

    // A case depends on the seed and its number only.
    let (root, _) = run_study(&STABILITY.replace("cases = 60", "cases = 7"));
    let few = rows(root.path());
    assert_eq!(few.len(), 7);
    for (row, again) in all.iter().zip(&few) {
        let same = |(name, value): (&String, &String)| name.starts_with("wall") || again[name] == *value;
        assert!(row.iter().all(same), "{row:?} and {again:?}");
    }
}

#[test]
fn bad_stability() {
    refused_lines(
        STABILITY,
        r#"
        cases = 60 | cases = 0 | line 4 | 0 is out of range
        dims = [1, 2, 3] | dims = [] | dims | empty
        dims = [1, 2, 3] | dims = [1]\ntargets = ["gaussian", "ring"] | targets | `ring` | `dims`
        dims = [1, 2, 3] | dims = [1]\ntargets = ["bell"] | bell | ring
        dims = [1, 2, 3] | dims = [1]\ntargets = ["logistic"] | targets | logistic | data
        seed = 3 | seeds = [3] | line 3 | `seeds`
        "#,
    );
}
