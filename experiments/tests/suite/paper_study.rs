//! The study of the paper's own algorithms: a small version runs to a report and can be resumed, bad configurations are refused with the field's name.

use std::collections::HashMap;

use crate::support::{assert_holds, refused_lines, reported, rows, succeeds, value};

const STUDY: &str = r#"
kind = "paper"
start-mean = 1.0
start-sd = 0.5
look-every = 5
reach = 1000.0
reference-points = 1024
reference-seed = 1
directions = 8
rivals = [{ name = "iid" }, { name = "svgd", options = { steps = 5 } }]

[base]
targets = [{ name = "gaussian", dim = 2 }, { name = "mixture-4" }]
algorithms = [1, 2]
variants = [{ guards = "off", coordinates = "own" }, { guards = "on", coordinates = "frame" }]
materials = [{ law = "neo-hookean", youngs-modulus = 1.0, poissons-ratio = 0.3 }]
schedules = [{ shape = "constant", alpha = 1.0 }]
scores = ["nodes"]
volumes = ["uniform"]
frictions = [0.0]
steps = [40]
particles = [60]
seeds = [3]

[[case]]
name = "alpha"
schedules = [{ shape = "constant", alpha = 0.1 }, { shape = "constant", alpha = -1.0 }]

[[case]]
name = "youngs-modulus"
materials = [
    { law = "neo-hookean", youngs-modulus = 0.1, poissons-ratio = -0.9 },
    { law = "neo-hookean", youngs-modulus = 10.0, poissons-ratio = 0.3 },
]

[[case]]
name = "material"
algorithms = [2]
materials = [
    { law = "linear-cauchy", youngs-modulus = 1.0, poissons-ratio = 0.3 },
    { law = "linear-elastic", youngs-modulus = 1.0, poissons-ratio = 0.3 },
    { law = "fixed-corotated", youngs-modulus = 1.0, poissons-ratio = 0.3 },
    { law = "hencky", youngs-modulus = 1.0, poissons-ratio = 0.3 },
    { law = "kelvin-voigt", youngs-modulus = 1.0, poissons-ratio = 0.3, viscosity = 0.1 },
    { law = "softening-hencky", youngs-modulus = 1.0, poissons-ratio = 0.3, yield-stress = 0.1 },
    { law = "drucker-prager", youngs-modulus = 1.0, poissons-ratio = 0.3, friction-angle = 30.0 },
    { law = "tait-fluid", reference-density = 1.0, sound-speed = 1.0, viscosity = 0.05 },
    { law = "isothermal-gas", pressure-per-density = 1.0 },
]

[[case]]
name = "schedule"
schedules = [{ shape = "constant", alpha = 1.0 }, { shape = "geometric", from = 0.1, to = 1.0 }]

[[case]]
name = "cost"
targets = [{ name = "gaussian", dim = 1 }, { name = "gaussian", dim = 2 }, { name = "gaussian", dim = 3 }]
variants = [{ guards = "on", coordinates = "frame" }]
spacings = [0.5, 1.0]
particles = [30, 60]
steps = [5]
"#;

/// Base 8, rivals 4, alpha 16, Young's modulus 16, material 36, the other schedule 8, cost 24.
const CASES: usize = 8 + 4 + 16 + 16 + 36 + 8 + 24;

fn number(row: &HashMap<String, String>, name: &str) -> Option<f64> {
    row[name].parse().ok()
}

#[test]
fn the_papers_algorithms() {
    let (root, output, report) = reported(STUDY, 3);
    let first = rows(root.path());
    assert_eq!(first.len(), CASES);
    assert_eq!(value(&output, "cases").unwrap(), CASES.to_string());
    assert_holds(
        &report,
        &[
            "## Failures\n\n| variant | method |",
            "| as written | algorithm 1 |",
            "## When does it work?",
            "| variant | runs | ended |",
            "| target | start as written | start guards on, frame |",
            "best before the end",
            "The least median over all targets is",
            "- α geometric 0.1…1: better than the constant one in",
            "Largest error of a mode's mass",
            "paper: O(M N d²) | 1 | 1 | 2 |",
            "isothermal-gas κ=1",
            "(figures/transient.svg)",
        ],
    );
    let failed = |row: &HashMap<String, String>| row["status"] == "diverged";
    assert!(first.iter().any(failed), "as written something diverges");
    for row in &first {
        let level = number(row, "energy_level").unwrap();
        match failed(row) {
            true => {
                assert!(!row["reason"].is_empty() && !row["message"].is_empty(), "{row:?}");
                assert!(number(row, "failed_step").unwrap() <= 40.0, "{row:?}");
                assert!(row["final_energy"].is_empty(), "{row:?}");
            }
            false => assert!(number(row, "final_energy").unwrap() > -0.1 * level, "{row:?}"),
        }
        if let (Some(best), Some(end)) = (number(row, "best_energy"), number(row, "final_energy")) {
            assert!(best <= end, "{row:?}");
            assert!(number(row, "best_step").unwrap() >= 5.0, "{row:?}");
        }
        let is_body = row["method"].starts_with("algorithm");
        assert_eq!(is_body, !row["material"].is_empty(), "{row:?}");
        assert_eq!(is_body, number(row, "start_energy").is_some(), "{row:?}");
        let is_mixture = row["target"] == "mixture-4";
        assert_eq!(is_mixture && !failed(row), !row["final_mass"].is_empty(), "{row:?}");
    }

    // A torn file is completed to the same rows.
    let path = root.path().join("out/results.csv");
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::write(&path, &text.as_bytes()[..2 * text.len() / 3]).unwrap();
    succeeds(root.path(), "run study.toml --out out");
    let again = rows(root.path());
    let same = |(row, other): (&HashMap<String, String>, &HashMap<String, String>)| {
        row.iter()
            .all(|(name, value)| name.starts_with("wall") || other[name] == *value)
    };
    assert_eq!(again.len(), CASES);
    assert!(first.iter().zip(&again).all(same));
}

#[test]
fn bad_studies_of_the_paper() {
    refused_lines(
        STUDY,
        r#"
        start-sd = 0.5 | start-sd = 0.0 | start-sd | 0 must be
        start-mean = 1.0 | start-mean = inf | start-mean | finite
        reach = 1000.0 | reach = -1.0 | reach | -1
        look-every = 5 | look-every = 0 | line 5 | 0 is out of range
        seeds = [3] |  | base.seeds | missing
        seeds = [3] | seeds = [] | base.seeds | empty
        algorithms = [1, 2] | algorithms = [3] | line | 3 is out of range
        guards = "off" | guards = "some" | some | mass-floor
        poissons-ratio = 0.3 | poissons-ratio = 0.5 | base.materials | 0.5
        youngs-modulus = 10.0 | youngs-modulus = -10.0 | case.youngs-modulus.materials | -10
        law = "hencky" | law = "jelly" | jelly | neo-hookean
        viscosity = 0.1 | stickiness = 0.1 | stickiness
        from = 0.1, to = 1.0 | from = -0.1, to = 1.0 | case.schedule.schedules | same sign
        alpha = -1.0 | alpha = nan | case.alpha.schedules | finite
        spacings = [0.5, 1.0] | spacings = [0.5, 0.0] | case.cost.spacings | 0
        spacings = [0.5, 1.0] | spacings = [0.5, 0.5] | case.cost | two cases
        frictions = [0.0] | frictions = [-1.0] | base.frictions | -1
        name = "cost" | name = "alpha" | case[4].name | alpha
        name = "cost"\n |  | case[4].name | missing
        [base] | [base]\nname = "b" | base.name
        steps = [5] | step = [5] | `step` | steps
        "#,
    );
}
