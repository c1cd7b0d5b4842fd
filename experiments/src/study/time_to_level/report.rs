//! The report of the study `time-to-level`.

use super::{RUNS, TimeToLevel};
use crate::plots::page::counted;
use crate::study::contestant::{runs_of, told};
use crate::study::prelude::*;

/// Tables and figure.
pub fn report(study: &TimeToLevel, rows: &Rows<'_>, directory: &StudyDirectory) -> Result<Page, CommandError> {
    let (threads, ratio) = (directory.at_most_threads(), number(study.largest_ratio));
    let mut page = directory.page(include_str!("report.md"), &[("at-most", &threads), ("ratio", &ratio)]);
    page.part("Times", &[]);
    let own = study.method.label();
    let told = told(rows, own, "steps");
    times(study, &told.iter().collect(), &mut page);
    page.heading("Figure");
    let plot = plot(study, rows, directory)?;
    page.drawing("time-to-level.svg", multiples(&plot));
    page.section("All searches", &[], &told);

    Ok(rows.tell([Status::Reached, Status::OutOfTime, Status::OutOfSteps], page))
}

/// One line per dimension: steps and time of the method and of each rival, and the ratio of times; what is known of rivals that did not reach the level.
fn times(study: &TimeToLevel, told: &Rows<'_>, page: &mut Page) {
    let own = study.method.label();
    let repeated = [
        each("own", [own]),
        each("rival", MethodSpecification::labels(&study.rivals)),
    ];
    page.lines_over("Times", &repeated, told.lines("dim", study.dims.clone()));
    let is_bound = |row: &Row| row.status() != Status::Reached && row.text("method") != own;
    let bound = |row: &Row| {
        let state = row.number("energy_ratio").map_or("diverged".to_owned(), |levels| {
            format!("ED² is still {} times the level", number(levels))
        });
        let [dim, times] = ["dim", "times"].map(|column| row.value(column).cell());
        let steps = row
            .count("steps")
            .map_or(MISSING.to_owned(), |steps| counted(steps, "steps"));
        let method = row.text("method");
        format!("- d = {dim}: after {steps} and {times} times the time of `{own}`, {state} with `{method}`.")
    };
    let bounds = told.having(|row| is_bound(row) && row.number("times").is_some());
    page.items(&bounds.iter().map(bound).collect::<Vec<_>>());
}

/// The runs of all searches, ED² in levels against the time: one panel per dimension, one line per method, repeats in one point.
fn plot(study: &TimeToLevel, rows: &Rows<'_>, directory: &StudyDirectory) -> Result<MultiplesPlot, CommandError> {
    let runs = runs_of(study, rows, directory, RUNS)?;
    let runs: Rows<'_> = runs.iter().flat_map(|(_, runs)| runs).collect();
    let panel = |here: &Rows<'_>| {
        let line = |(label, runs): (String, Rows<'_>)| runs.path(label, "steps", SECONDS, "energy_ratio");
        let lines = here.by("method").into_iter().map(line);
        MultiplesPanel::new("", lines).with_level(1.0, "level of i.i.d. draws")
    };
    let known = study.dims.iter().filter(|dim| !runs.with("dim", **dim).is_empty());
    let panels = runs.panels(("d = ", "dim"), known.copied(), panel);
    Ok(MultiplesPlot::logarithmic("wall time of a run (s)", "ED² / level").with_panels(panels))
}
