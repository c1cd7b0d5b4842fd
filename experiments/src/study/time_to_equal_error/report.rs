//! The report of the study `time-to-equal-error`.

use super::{RUNS, TimeToEqualError};
use crate::plots::{TimeErrorPanel, time_error};
use crate::study::contestant::{runs_of, told};
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
    rows.references(&mut page);
    page.heading("Figure");
    let plot = plot(study, rows, directory)?;
    page.drawing("time-to-equal-error.svg", multiples(&plot));

    let rivals = rows.having(|row| row.text("method") != own);
    let page = rivals.tell([Status::Reached, Status::OutOfTime], page);
    let page = rivals.tell([Status::OutOfSizes, Status::Unsupported], page);
    Ok(rivals.tell([Status::NoReference], page))
}

/// A line for every target with every M.
fn comparisons<'a>(study: &TimeToEqualError, rows: &Rows<'a>) -> Vec<Line<'a>> {
    let targets = study.targets.iter().map(TargetSpecification::label);
    rows.lines_by(("target", targets), ("particles", study.particles.clone()))
}

fn reason(row: &Row) -> String {
    let [target, particles, reason] = ["target", "particles", "reason"].map(|column| row.value(column).cell());
    format!("- {target}, M = {particles}: {reason}.")
}

/// A panel per target: the method with a point per M; chains and independent draws with a point per number of draws; other rivals with a curve for every
/// M, a point per number of steps.
fn plot(study: &TimeToEqualError, rows: &Rows<'_>, directory: &StudyDirectory) -> Result<MultiplesPlot, CommandError> {
    let mut panels: Vec<TimeErrorPanel> = Vec::new();
    for (case, runs) in runs_of(study, rows, directory, RUNS)? {
        let runs: Rows<'_> = runs.iter().collect();
        // On a logarithmic axis there is no place for zero and below.
        let settings = runs.pairs_by("size", SECONDS, "energy_above_zero");
        if settings.is_empty() {
            continue;
        }
        let is_one_curve = case.index == 0 || !case.method.name.iterates() || study.particles.len() == 1;
        let mut curve = case.method.label().to_owned();
        if !is_one_curve {
            curve.push_str(&format!(", M = {}", case.particles));
        }
        let known = TimeErrorPanel::settings(&mut panels, &case.target.label(), &curve);
        if case.index == 0 {
            known.extend(settings);
        } else if settings.len() > known.len() {
            // The runs of a chain for the larger M begin with those for the smaller one.
            *known = settings;
        }
    }
    Ok(time_error("wall time (s)", "ED²", panels))
}
