//! The report of the study `time-to-equal-error`.

use super::TimeToEqualError;
use super::figure::plot;
use crate::study::prelude::*;

/// Tables and figure.
pub fn report(study: &TimeToEqualError, rows: &Rows<'_>, directory: &StudyDirectory) -> Result<Page, CommandError> {
    let own = study.method.label();
    let (threads, ratio) = (directory.at_most_threads(), number(study.largest_ratio));
    let mut page = directory.page(include_str!("report.md"), &[("at-most", &threads), ("ratio", &ratio)]);
    let told: Vec<Row> = rows.iter().map(|row| told(row, &rows.with("method", own))).collect();
    let told: Rows<'_> = told.iter().collect();
    let lines = comparisons(study, &told.with("method", own));
    page.section("What a particle is worth", &[], lines);
    for rival in &study.rivals {
        let its = rival.label();
        page.heading(&format!("Against {its}"));
        let size = if rival.name.iterates() { "steps" } else { "draws" };
        let is_expected = rival.name == MethodName::Iid;
        let section = if is_expected { "expected" } else { "searched" };
        page.part(section, &[("sizes", &size)]);
        let names = [("sizes", size), ("its", its), ("own", own)].map(|(name, word)| each(name, [word]));
        page.lines_over("searched", &names, comparisons(study, &told));
        let reasons = told.with("method", its).with("ending", Status::Unsupported);
        page.items(&reasons.iter().map(reason).collect::<Vec<_>>());
    }
    page.heading("Figure");
    let plot = plot(study, rows, directory)?;
    page.drawing("time-to-equal-error.svg", multiples(&plot));

    let rivals = rows.having(|row| row.text("method") != own);
    let page = rivals.tell([Status::Reached, Status::OutOfTime], page);
    Ok(rivals.tell([Status::OutOfSizes, Status::Unsupported], page))
}

/// A line for every target with every M.
fn comparisons<'a>(study: &TimeToEqualError, rows: &Rows<'a>) -> Vec<Line<'a>> {
    let targets = rows.lines("target", study.targets.iter().map(TargetSpecification::label));
    let sizes = |line: &Line<'a>| line.by("particles", study.particles.clone());
    targets.iter().flat_map(sizes).collect()
}

/// The row of a case with what tables say of it beside the method's own rows.
fn told(row: &Row, own: &Rows<'_>) -> Row {
    let own = own.with("target", row.text("target"));
    let own = own.with("particles", row.value("particles").clone()).first();
    let own = own.and_then(|own| own.number(SECONDS));
    row.clone()
        .with("draws", row.number("draws_ratio").map(f64::recip))
        .with("sizes", sizes(row))
        .with("ratios", own.and_then(|own| ratios(row, own)))
        .with("ended", in_words(row.status()))
}

fn reason(row: &Row) -> String {
    let [target, particles, reason] = ["target", "particles", "reason"].map(|column| row.value(column).cell());
    format!("- {target}, M = {particles}: {reason}.")
}

/// From the last that missed to the first that reached, or a bound.
fn between(row: &Row, missed: Option<String>, last: String) -> String {
    match (row.status(), missed) {
        (Status::Reached, Some(missed)) => format!("{missed} to {last}"),
        (Status::Reached, None) => last,
        _ => format!("> {last}"),
    }
}

fn sizes(row: &Row) -> Option<String> {
    let size = |column: &str| row.count(column).map(|size| size.to_string());
    Some(between(row, size("missed_size"), size("size")?))
}

/// The times relative to the method's.
fn ratios(row: &Row, own: f64) -> Option<String> {
    let ratio = |column: &str| row.number(column).map(|seconds| number(seconds / own));
    Some(between(row, ratio("wall_seconds_missed"), ratio(SECONDS)?))
}

fn in_words(ending: Status) -> &'static str {
    match ending {
        Status::Reached => "reached",
        Status::OutOfTime => "out of time",
        Status::OutOfSizes => "largest number missed",
        _ => "unsupported",
    }
}
