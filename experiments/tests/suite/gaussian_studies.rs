//! The studies on N(0, I): small versions run to a report, and bad configurations are refused with the field's name.

use std::collections::HashMap;

use crate::support::{
    assert_cases, assert_holds, assert_report, parvi, refused, refused_lines, reported, rows, run_study, value,
};

const ACCURACY: &str = r#"
kind = "accuracy"
seeds = [1, 2, 3]
dims = [1, 2]
particles = [64, 16]
methods = [
    { name = "mpm", options = { survey = "off", steps = 20 } },
    { name = "mpm", label = "mpm, linear", options = { survey = "off", steps = 20, basis = "linear" }, largest-particles = 20 },
    { name = "iid" },
    { name = "sobol" },
    { name = "svgd", largest-particles = 16, options = { steps = 5 } },
]
"#;

const TIME_TO_LEVEL: &str = r#"
kind = "time-to-level"
seed = 1
threads = 1
dims = [1, 2]
particles = 100
start = { mean = 0.7, standard-deviation = 0.6 }
steps = [1, 4, 16, 64]
repeats = 2
largest-ratio = 1e-3
method = { name = "mpm", options = { survey = "off" } }
rivals = [{ name = "svgd" }, { name = "mpm", label = "again", options = { survey = "off" } }]
"#;

const BASIS_COMPARISON: &str = r#"
kind = "basis-comparison"
seeds = [1, 2]
dims = [1, 2]
particles = 64
bases = ["quadratic", "linear"]
spacings = [0.5, 1.0, 2.0]
steps = [20, 5]
method = { name = "mpm", options = { survey = "off", moment-correction = "off" } }
"#;

const SPACING_PARTICLES: &str = r#"
kind = "spacing-particles"
seeds = [1, 2]
particles = [64, 32, 16]
method = { name = "mpm", options = { survey = "off", basis = "linear", steps = 20 } }
series = [{ dim = 1, spacings = [0.8, 0.2, 0.4] }, { dim = 2, spacings = [0.5, 1.0] }]
"#;

#[test]
fn accuracy() {
    let (root, output, report) = reported(ACCURACY, 1);
    // Per dimension: five methods with 16 particles, three with 64.
    assert_cases(&output, 2 * 3 * (5 + 3), 0);
    assert_holds(
        &report,
        &[
            "| method | M = 16 | / sobol | M = 64 | / sobol |",
            "| mpm, linear |",
            "| i.i.d., expected |",
            "**d = 2**",
            "| best possible |",
            "−0.750",
        ],
    );
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
    assert!(!assert_report(root.path(), 1).contains("/ sobol"));
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

#[test]
fn time_to_level() {
    let (root, output, report) = reported(TIME_TO_LEVEL, 1);
    assert!(
        report.contains("svgd / mpm") && report.contains("again / mpm"),
        "{report}"
    );
    let rows = rows(root.path());
    assert_eq!(rows.len(), 6);
    for row in rows.iter().filter(|row| row["method"] == "mpm") {
        assert_eq!(row["ending"], "reached");
        let number = |name: &str| row[name].parse::<f64>().unwrap();
        assert!(number("energy_distance_squared") <= number("energy_level"));
    }
    // A budget of a thousandth of the time is used up by the first step.
    for row in rows.iter().filter(|row| row["method"] != "mpm") {
        assert_eq!((row["ending"].as_str(), row["steps"].as_str()), ("out-of-time", "1"));
    }
    assert!(report.contains("times the level with `svgd`"), "{report}");
    assert_eq!(value(&output, "reached").unwrap(), "2");
    assert_eq!(value(&output, "out_of_time").unwrap(), "4");
}

#[test]
fn a_resumed_rival_finds_the_time_of_the_method() {
    let (root, _) = run_study(TIME_TO_LEVEL);
    let path = root.path().join("out/results.csv");
    let text = std::fs::read_to_string(&path).unwrap();
    let first_two: String = text.split_inclusive('\n').take(2).collect();
    std::fs::write(&path, first_two).unwrap();
    let output = parvi(root.path(), "run study.toml --out out");
    assert!(output.status.success());
    let rows = rows(root.path());
    let number = |row: usize, name: &str| rows[row][name].parse::<f64>().unwrap();
    let budget = 1e-3 * number(0, "wall_seconds");
    assert!((number(1, "wall_budget_seconds") / budget - 1.0).abs() < 1e-9);
}

#[test]
fn bad_time_to_level() {
    refused_lines(
        TIME_TO_LEVEL,
        r#"
        [1, 2] | [] | dims | empty
        [1, 2] | [2, 2] | dims | d2-m100-mpm
        [1, 4, 16, 64] | [] | steps | empty
        [1, 4, 16, 64] | [1, 4, 4] | steps | 4 before 4
        1e-3 | -1.0 | largest-ratio | -1
        = 0.6 } | = 0.0 } | start.standard-deviation | 0
        mean = 0.7 | mean = nan | start.mean | NaN
        mean = 0.7 | middle = 0.7 | line 7 | `middle`
        "svgd" } | "sobol" } | rivals.name | `sobol`
        { name = "svgd" } | { name = "svgd", options = { steps = 3 } } | rivals.options.steps | `steps`
        method = { name = "mpm", options = { survey = "off" } } | method = { name = "mpm", options = { start-mean = 1.0 } } | method.options.start-mean | `start`
        "#,
    );
}

#[test]
fn basis_comparison() {
    let (root, output, report) = reported(BASIS_COMPARISON, 1);
    assert_cases(&output, 2 * 2 * 3 * 2 * 2, 0);
    assert_holds(
        &report,
        &["ED² in the time of quadratic", "time (s), T = 20", "h / default"],
    );
    // The first basis fits into its own time with its largest number of steps.
    let first: Vec<&str> = report
        .lines()
        .filter(|line| line.starts_with("| quadratic |"))
        .collect();
    assert_eq!(first.len(), 2, "{report}");
    assert!(first.iter().all(|line| line.ends_with("(T = 20) |")), "{report}");
    let rows = rows(root.path());
    let unit = |row: &HashMap<String, String>| {
        let number = |name: &str| row[name].parse::<f64>().unwrap();
        number("requested_spacing") / number("spacing_factor")
    };
    for row in &rows {
        let same = |other: &&HashMap<String, String>| other["dim"] == row["dim"] && other["series"] == row["series"];
        let first = rows.iter().find(same).unwrap();
        assert!(
            (unit(row) / unit(first) - 1.0).abs() < 1e-12,
            "one default per basis: {row:?}"
        );
        assert_eq!(row["steps"], row["requested_steps"]);
    }
}

#[test]
fn bad_basis_comparison() {
    refused_lines(
        BASIS_COMPARISON,
        r#"
        seeds = [1, 2] | seeds = [] | seeds | empty
        dims = [1, 2] | dims = [] | dims | empty
        ["quadratic", "linear"] | [] | bases | empty
        "linear" | "round" | line 6 | `round` | quadratic
        "linear" | "quadratic" | bases | d1-m64-quadratic-f0.5-t20-s1
        [0.5, 1.0, 2.0] | [] | spacings | empty
        [0.5, 1.0, 2.0] | [0.5, -1.0] | spacings | -1
        [20, 5] | [] | steps | empty
        [20, 5] | [20, 0] | line 8 | 0 is out of range
        { survey = "off", moment-correction = "off" } | { spacing = 1.0 } | method.options.spacing | `spacings`
        { survey = "off", moment-correction = "off" } | { basis = "cubic" } | method.options.basis | `bases`
        { survey = "off", moment-correction = "off" } | { steps = 3 } | method.options.steps | `steps`
        { name = "mpm", options = { survey = "off", moment-correction = "off" } } | { name = "svgd" } | basis | svgd
        "#,
    );
}

#[test]
fn spacing_particles() {
    let (_root, output, report) = reported(SPACING_PARTICLES, 1);
    assert_cases(&output, 2 * 3 * (3 + 2), 0);
    assert_holds(
        &report,
        &[
            "| h | M = 16 | M = 32 | M = 64 |",
            "active nodes / M",
            "h at M = 512",
            "**d = 2**",
        ],
    );
    assert!(
        report.contains("beyond ") || report.contains("they do up to 64"),
        "{report}"
    );
}

#[test]
fn bad_spacing_particles() {
    refused_lines(
        SPACING_PARTICLES,
        r#"
        seeds = [1, 2] | seeds = [] | seeds | empty
        [64, 32, 16] | [] | particles | empty
        [64, 32, 16] | [64, 64] | particles | d1-m64-mpm-h0.8-t20-s1
        [0.5, 1.0] | [] | series.spacings | empty
        [0.5, 1.0] | [0.5, 0.0] | series.spacings | 0 must be
        dim = 2 | dim = 9 | line 6 | 9 is out of range
        dim = 2, spacings | dim = 2, spacing | line 6 | `spacing`
        steps = 20 | spacing = 0.5 | method.options.spacing | `series`
        { name = "mpm", options = { survey = "off", basis = "linear", steps = 20 } } | { name = "iid" } | spacing | iid
        "#,
    );
}
