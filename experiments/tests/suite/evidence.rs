//! The study of evidence: a small version runs to a report, and bad configurations are refused with the field's name.

use crate::support::{assert_cases, assert_holds, number, refused_lines, reported, rows};

const STUDY: &str = r#"
kind = "evidence"
run-seeds = { first = 3, count = 4 }
particles = 80
targets = [{ name = "gaussian", dim = 2 }, { name = "spike-slab", dim = 1 }]
methods = [{ name = "ais" }, { name = "smc" }, { name = "iid" }]
"#;

#[test]
fn evidence() {
    let (root, output, report) = reported(STUDY, 1);
    assert_cases(&output, 24, 0);
    assert_holds(
        &report,
        &[
            "## gaussian-d2",
            "| smc | 8/8 |",
            "| iid | 0/8 | – |",
            "## Errors beyond three standard errors",
        ],
    );
    for row in rows(root.path()) {
        assert_eq!(
            row["log_evidence_deviation"].is_empty(),
            row["method"] == "iid",
            "{row:?}"
        );
        if row["method"] != "iid" {
            let error = number(&row, "log_evidence_error");
            assert!(
                error > 0.0 && number(&row, "log_evidence_deviation").abs() < 10.0 * error,
                "{row:?}"
            );
        }
    }
}

#[test]
fn bad_studies_of_evidence() {
    refused_lines(
        STUDY,
        r#"
        "gaussian", dim = 2 | "wells-small" | targets | wells-small | not known
        { name = "iid" } | { name = "ais" } | two cases | gaussian-d2-ais-s3
        count = 4 | count = 0 | line 3 | 0 is out of range
        particles = 80 | particles = 80\nmore = 1 | line 5 | more
        "#,
    );
}
