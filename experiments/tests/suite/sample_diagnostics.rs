//! What `parvi sample` says about the particles it gives.

use crate::support::{assert_refused, files, parvi, stderr, succeeds, value};

fn diagnostics(line: &str) -> serde_json::Value {
    let directory = tempfile::tempdir().unwrap();
    succeeds(
        directory.path(),
        &format!("sample {line} --out x.csv --diagnostics d.json"),
    );
    assert_eq!(files(directory.path()), ["d.json", "x.csv"]);
    let text = std::fs::read_to_string(directory.path().join("d.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

fn number(value: &serde_json::Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}

#[test]
fn a_gaussian_converges_and_its_moments_are_known() {
    let found = diagnostics("--target gaussian --dim 2 --particles 500");
    assert_eq!(found["outcome"], "converged");
    assert_eq!(number(&found["effective_sample_size"]), 500.0);
    assert!(number(&found["kernel_stein_discrepancy"]) < 0.1);
    let log_evidence_error = number(&found["log_evidence_error"]);
    assert!(log_evidence_error < 0.1, "{found}");
    assert!(
        number(&found["log_evidence"]).abs() < 4.0 * log_evidence_error,
        "{found}"
    );
    assert!(number(&found["pareto_k"]) < 0.7, "{found}");
    assert!(number(&found["pool"]["points"]) <= number(&found["density_evaluations"]));
    assert!(number(&found["pool"]["effective_size"]) > 1000.0, "{found}");
    for coordinate in found["coordinates"].as_array().unwrap() {
        assert!(number(&coordinate["mean"]["estimate"]).abs() < 0.05);
        assert!((number(&coordinate["standard_deviation"]["estimate"]) - 1.0).abs() < 0.05);
        let tail = &coordinate["quantiles"][0];
        assert_eq!(number(&tail["level"]), 0.01);
        let error = number(&tail["standard_error"]);
        assert!((number(&tail["value"]) + 2.326).abs() < 3.0 * error, "{tail}");
        assert!((number(&tail["estimate"]) + 2.326).abs() < 0.2, "{tail}");
    }
    assert!((number(&found["covariance"][1][1]) - 1.0).abs() < 0.05, "{found}");
    assert!(number(&found["covariance"][0][1]).abs() < 0.05, "{found}");
    assert_eq!(found["run"]["seed"], 0);
    assert_eq!(found["run"]["method"], "mpm");
    assert!(number(&found["run"]["wall_seconds"]) > 0.0 && number(&found["unseen"]) < 0.1);
    assert!(
        found["provenance"]["rustc"]
            .as_str()
            .is_some_and(|text| text.starts_with("rustc "))
    );
}

#[test]
fn methods_without_a_certificate_are_diagnosed_by_the_scores() {
    let found = diagnostics("--target student-t --dim 1 --particles 400 --method iid");
    for key in ["outcome", "pool", "log_evidence", "pareto_k"] {
        assert!(found[key].is_null(), "{key}");
    }
    let mean = &found["coordinates"][0]["mean"];
    assert!(number(&mean["estimate"]).abs() < 1e-3, "{mean}");
    assert!(number(&mean["standard_error"]) > 1e-3);
}

#[test]
fn light_parts_may_have_weights() {
    let directory = tempfile::tempdir().unwrap();
    let line = "sample --target mixture-3 --dim 2 --particles 300 --weighted on --out x.csv";
    succeeds(directory.path(), line);
    let header = std::fs::read_to_string(directory.path().join("x.csv")).unwrap();
    assert!(header.starts_with("x1,x2,weight\n"), "{header}");
}

#[test]
fn a_run_that_was_too_short_says_so() {
    let directory = tempfile::tempdir().unwrap();
    let line = "sample --target gaussian --dim 2 --particles 300 --steps 5 --survey off --start-mean 5 --out x.csv";
    let output = succeeds(directory.path(), line);
    assert_eq!(value(&output, "outcome").as_deref(), Some("budget exhausted"));
    assert!(value(&output, "reason").is_some_and(|reason| reason.contains("still moved")));
    assert!(stderr(&output).contains("budget exhausted"), "{}", stderr(&output));
}

#[test]
fn a_diagnostics_file_that_cannot_be_written_is_refused_early() {
    let directory = tempfile::tempdir().unwrap();
    let line = "sample --target banana --particles 50 --out x.csv --diagnostics missing/d.json";
    assert_refused(&parvi(directory.path(), line), &["missing/d.json"]);
    assert_eq!(files(directory.path()), [""; 0]);
}
