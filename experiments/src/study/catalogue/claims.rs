//! What runs say of themselves, beside what is measured.

use super::row::Row;
use crate::study::attempt::Status;
use crate::study::document::{Document, MISSING, number};

/// The largest of the values, and the case it belongs to.
pub fn worst<'a>(rows: &[&'a Row], quantity: impl Fn(&Row) -> Option<f64>) -> Option<(f64, &'a str)> {
    rows.iter()
        .filter_map(|row| Some((quantity(row)?, row.case.as_str())))
        .max_by(|left, right| left.0.total_cmp(&right.0))
}

/// A table of outcomes as the sampler states them, with the worst errors among the runs that state each. Runs that state none
/// are a line of their own.
pub fn claims(method: &str, rows: &[Row], document: &mut Document) {
    document.heading("What runs say of themselves");
    document.paragraph(format!(
        "Finished runs of {method} by the outcome that the sampler states ({MISSING}: none), with the largest errors among \
         them: an outcome `converged` is a claim, and the errors beside it are what it is worth.",
    ));
    let finished: Vec<&Row> = rows
        .iter()
        .filter(|row| row.status == Status::Finished && row.method == method)
        .collect();
    let mut outcomes: Vec<Option<&str>> = finished.iter().map(|row| row.outcome.as_deref()).collect();
    outcomes.sort_unstable();
    outcomes.dedup();
    let header = [
        "outcome",
        "runs",
        "worst mean (sd)",
        "worst sd (relative)",
        "worst mode mass",
        "worst case",
    ];
    let line = |outcome: &Option<&str>| {
        let here: Vec<&Row> = finished
            .iter()
            .copied()
            .filter(|row| row.outcome.as_deref() == *outcome)
            .collect();
        let cell = |found: Option<(f64, &str)>| found.map_or(MISSING.to_owned(), |(value, _)| number(value));
        let larger = |row: &Row| Some(row.mean_error?.max(row.deviation_error?));
        vec![
            outcome.unwrap_or(MISSING).to_owned(),
            here.len().to_string(),
            cell(worst(&here, |row| row.mean_error)),
            cell(worst(&here, |row| row.deviation_error)),
            cell(worst(&here, |row| row.mass_error)),
            worst(&here, larger).map_or(MISSING.to_owned(), |(_, case)| format!("`{case}`")),
        ]
    };
    let table: Vec<Vec<String>> = outcomes.iter().map(line).collect();
    document.table(&header, &table);
}
