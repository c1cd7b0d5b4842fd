//! What `parvi sample` says about the particles it gives.

use crate::support::{assert_refused, files, parvi, stderr, value};

fn diagnostics(line: &str) -> serde_json::Value {
    let directory = tempfile::tempdir().unwrap();
    let output = parvi(
        directory.path(),
        &format!("sample {line} --out x.csv --diagnostics d.json"),
    );
    assert!(output.status.success(), "{}", stderr(&output));
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
    for coordinate in found["coordinates"].as_array().unwrap() {
        assert!(number(&coordinate["mean"]["estimate"]).abs() < 1e-9);
        assert!((number(&coordinate["standard_deviation"]["estimate"]) - 1.0).abs() < 1e-6);
        let tail = &coordinate["quantiles"][0];
        assert_eq!(number(&tail["level"]), 0.01);
        let error = number(&tail["standard_error"]);
        assert!((number(&tail["value"]) + 2.326).abs() < 3.0 * error, "{tail}");
    }
}

#[test]
fn methods_without_a_certificate_are_diagnosed_by_the_scores() {
    let found = diagnostics("--target student-t --dim 1 --particles 400 --method iid");
    assert!(found["outcome"].is_null());
    let mean = &found["coordinates"][0]["mean"];
    assert!(number(&mean["estimate"]).abs() < 1e-3, "{mean}");
    assert!(number(&mean["standard_error"]) > 1e-3);
}

#[test]
fn pieces_are_named_on_standard_error_and_may_be_weighted() {
    let directory = tempfile::tempdir().unwrap();
    let line = "sample --target mixture-3 --dim 2 --particles 300 --weighted on --out x.csv";
    let output = parvi(directory.path(), line);
    assert!(output.status.success(), "{}", stderr(&output));
    assert!(stderr(&output).contains("separate pieces"), "{}", stderr(&output));
    assert!(value(&output, "mass_error").is_some());
    let header = std::fs::read_to_string(directory.path().join("x.csv")).unwrap();
    assert!(header.starts_with("x1,x2,weight"), "{header}");
}

#[test]
fn a_run_that_was_too_short_says_so() {
    let directory = tempfile::tempdir().unwrap();
    let line = "sample --target gaussian --dim 2 --particles 300 --steps 5 --survey off --start-mean 5 --out x.csv";
    let output = parvi(directory.path(), line);
    assert!(output.status.success(), "{}", stderr(&output));
    assert_eq!(value(&output, "outcome").as_deref(), Some("budget exhausted"));
    assert!(value(&output, "reason").is_some_and(|reason| reason.contains("still moved")));
    assert!(stderr(&output).contains("budget exhausted"), "{}", stderr(&output));
}

#[test]
fn a_diagnostics_file_that_cannot_be_written_is_refused_early() {
    let directory = tempfile::tempdir().unwrap();
    let output = parvi(
        directory.path(),
        "sample --target banana --particles 50 --out x.csv --diagnostics missing/d.json",
    );
    assert_refused(&output, &["missing/d.json"]);
    assert_eq!(files(directory.path()), [""; 0]);
}
