//! The report of the study `time-to-equal-error`.

use super::TimeToEqualError;
use super::figure::plot;
use crate::study::contestant::told;
use crate::study::prelude::*;

/// Tables and figure.
pub fn report(study: &TimeToEqualError, rows: &Rows<'_>, directory: &StudyDirectory) -> Result<Page, CommandError> {
    let own = study.method.label();
    let (threads, ratio) = (directory.at_most_threads(), number(study.largest_ratio));
    let mut page = directory.page(include_str!("report.md"), &[("at-most", &threads), ("ratio", &ratio)]);
    let told = told(rows, own, "size");
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

fn reason(row: &Row) -> String {
    let [target, particles, reason] = ["target", "particles", "reason"].map(|column| row.value(column).cell());
    format!("- {target}, M = {particles}: {reason}.")
}
