//! Small versions of all studies run to a report; the committed configurations can be read.

use std::path::Path;

use crate::support::{assert_cases, assert_report, files, parvi, run_study, stderr, value};

#[test]
fn quickstart() {
    let text = include_str!("../../configs/quickstart.toml");
    let text = text
        .replace("particles = 2048", "particles = 300")
        .replace("points = 262144", "points = 16384");
    let text = text
        .replace("particles = 1000", "particles = 200")
        .replace("draws = 20000", "draws = 2000");
    let (root, output) = run_study(&text);
    let report = assert_report(root.path(), 4);
    assert!(report.contains("**Verdict: "));
    assert!(report.contains("intercept"));
    assert!(["pass", "fail"].contains(&value(&output, "verdict").unwrap().as_str()));
    value(&output, "largest_mean_error").unwrap().parse::<f64>().unwrap();
    // No reference is that good.
    let (root, output) = run_study(&text.replace("mean = 0.02", "mean = 1e-9"));
    assert_eq!(value(&output, "verdict").as_deref(), Some("undecided"));
    assert!(assert_report(root.path(), 4).contains("undecided, since standard errors of the reference"));
    // Nor one whose few heavy weights leave its scramblings near each other by chance.
    let bent = text
        .replace(
            "{ name = \"wells\", dim = 5 }",
            "{ name = \"banana\", parameters = { curvature = 1.0 } }",
        )
        .replace("points = 16384", "points = 32768")
        .replace("seed = 1", "seed = 6")
        .replace(
            "mean = 0.02\nstandard-deviation = 0.03",
            "mean = 0.05\nstandard-deviation = 0.09",
        );
    let (root, output) = run_study(&bent);
    assert_eq!(value(&output, "verdict").as_deref(), Some("undecided"));
    assert!(assert_report(root.path(), 4).contains("undecided, since the tail of the reference's weights"));
}

#[test]
fn covariance_spacing() {
    let (root, output) = run_study(
        r#"
        kind = "covariance-spacing"
        seeds = [0, 1]
        particles = 200
        method = { name = "mpm", options = { survey = "off", shifts = "off", moment-correction = "off", steps = 100 } }
        series = [
            { dim = 1, spacings = [0.5, 1.0], judged-spacing = 1.0, bound = 0.5 },
            { dim = 2, spacings = [1.2, 0.6] },
        ]
        "#,
    );
    assert_report(root.path(), 1);
    assert_eq!(value(&output, "verdict").unwrap(), "pass");
}

#[test]
fn scaling() {
    let (root, output) = run_study(
        r#"
        kind = "scaling"
        seed = 0
        threads = 1
        target = "gaussian"
        steps = 2
        repeats = 2
        method = { name = "mpm", options = { survey = "off" } }
        [particles-sweep]
        dims = [1, 2]
        particles = [100, 200, 400]
        largest-work = 1e9
        fit-from = 100
        [nodes-sweep]
        dims = [2]
        particles = 100
        nodes-per-axis = [8, 64, 10000]
        fit-from = 64
        box = [-4.0, 4.0]
        "#,
    );
    let report = assert_report(root.path(), 8);
    assert_cases(&output, 9, 0);
    assert!(report.contains("paper, dense grid"));
}

#[test]
fn time_error() {
    let (root, output) = run_study(
        r#"
        kind = "time-error"
        seeds = [0]
        particles = 100
        steps = [2, 5]
        reference-points = 1000
        reference-seed = 1
        directions = 8
        targets = [{ name = "mixture-4" }, { name = "wells-small" }]
        methods = [{ name = "mpm" }, { name = "paper-pic" }, { name = "svgd" }, { name = "iid" }, { name = "sobol" }]
        "#,
    );
    let report = assert_report(root.path(), 4);
    assert_eq!(
        value(&output, "unsupported").unwrap(),
        "1",
        "Sobol points of a posterior"
    );
    assert!(report.contains("The paper's algorithms"));
}

/// Without a list of steps every method takes its own number, once per seed.
#[test]
fn quality_bar() {
    let (root, output) = run_study(
        r#"
        kind = "time-error"
        seeds = [0, 1]
        particles = 40
        reference-points = 1000
        reference-seed = 1
        directions = 8
        targets = [{ name = "gaussian", dim = 2 }]
        methods = [{ name = "mpm" }, { name = "stein-thinning" }, { name = "support-points" }, { name = "iid" }]
        "#,
    );
    let report = assert_report(root.path(), 4);
    assert_eq!(value(&output, "finished").unwrap(), "8");
    for method in ["mpm", "stein-thinning", "support-points", "iid"] {
        assert!(report.contains(&format!("| {method} | – | 2/2 |")), "{report}");
    }
    assert!(!report.contains("The paper's algorithms"));
}

#[test]
fn committed_configurations_can_be_read() {
    // An output directory that cannot be made: configurations are read first, so its name is in the message.
    let configurations = Path::new(env!("CARGO_MANIFEST_DIR")).join("configs");
    let names = files(&configurations);
    assert!(names.len() >= 4);
    for name in names {
        let message = stderr(&parvi(&configurations, &format!("run {name} --out {name}/out")));
        let lacks_nuts = cfg!(not(feature = "nuts")) && message.contains("--features nuts");
        assert!(lacks_nuts || message.contains(&format!("{name}/out")), "{message}");
    }
}
