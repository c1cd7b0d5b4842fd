//! The report of the study `time-to-equal-error`.

use super::TimeToEqualError;
use super::figure::plot;
use crate::study::prelude::*;

/// Tables and figure.
pub fn report(study: &TimeToEqualError, rows: &Rows<'_>, directory: &StudyDirectory) -> Result<Page, CommandError> {
    let label = study.method.label();
    let (threads, ratio) = (directory.at_most_threads(), number(study.largest_ratio));
    let mut page = directory.page(include_str!("report.md"), &[("at-most", &threads), ("ratio", &ratio)]);
    page.part("What a particle is worth", &[]);
    worth(study, rows, &mut page);
    for rival in &study.rivals {
        page.heading(&format!("Against {}", rival.label()));
        against(study, rows, rival, &mut page);
    }
    page.heading("Figure");
    let plot = plot(study, rows, directory)?;
    page.drawing("time-to-equal-error.svg", multiples(&plot));

    let rivals = rows.having(|row| row.text("method") != label);
    let page = rivals.tell([Status::Reached, Status::OutOfTime], page);
    Ok(rivals.tell([Status::OutOfSizes, Status::Unsupported], page))
}

/// The row of a method for a target and M, if there is one.
fn find<'a>(rows: &Rows<'a>, target: &str, particles: usize, method: &str) -> Rows<'a> {
    let here = rows.with("target", target).with("particles", particles);
    here.with("method", method)
}

/// Every target with every M.
fn comparisons(study: &TimeToEqualError) -> impl Iterator<Item = (String, usize)> {
    let sizes = study.particles.iter().map(|particles| particles.get());
    let of = move |target: &TargetSpecification| {
        let label = target.label();
        sizes.clone().map(move |particles| (label.clone(), particles))
    };
    study.targets.iter().flat_map(of)
}

fn worth(study: &TimeToEqualError, rows: &Rows<'_>, page: &mut Page) {
    let line = |(target, particles): (String, usize)| {
        let here = find(rows, &target, particles, study.method.label());
        let draws = here.first().and_then(|row| row.number("draws_ratio")).map(f64::recip);
        let line = Line::from(here).with("target", target).with("M", particles);
        line.with("draws", draws)
    };
    page.lines("What a particle is worth", comparisons(study).map(line));
}

/// One line per target and M: what the rival needs, and how many times longer that takes.
fn against(study: &TimeToEqualError, rows: &Rows<'_>, rival: &MethodSpecification, page: &mut Page) {
    let label = study.method.label();
    let size = if rival.name.iterates() { "steps" } else { "draws" };
    let its = rival.label();
    let mut lines = Vec::new();
    let mut reasons = Vec::new();
    for (target, particles) in comparisons(study) {
        let own = find(rows, &target, particles, label).first();
        let own = own.and_then(|row| row.number(SECONDS));
        let here = find(rows, &target, particles, its);
        let row = here.first();
        if let Some(row) = row.filter(|row| row.status() == Status::Unsupported) {
            reasons.push(format!("- {target}, M = {particles}: {}.", row.text("reason")));
        }
        let line = Line::from(here.clone()).with("target", target).with("M", particles);
        let line = line.with("size", row.and_then(sizes)).with("own time", own);
        let ratios = row.zip(own).and_then(|(row, own)| ratios(row, own));
        let line = line.with("ratios", ratios);
        lines.push(line.with("ended", row.map(|row| in_words(row.status()))));
    }
    let is_expected = rival.name == MethodName::Iid;
    let section = if is_expected { "expected" } else { "searched" };
    page.part(section, &[("sizes", &size)]);
    let names = [("sizes", size), ("its", its), ("own", label)].map(|(name, word)| each(name, [word]));
    page.lines_over("searched", &names, lines);
    if !reasons.is_empty() {
        page.paragraph(reasons.join("\n"));
    }
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
