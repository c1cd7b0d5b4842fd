//! The report of the study `time-to-level`.

use super::TimeToLevel;
use super::search;
use crate::study::prelude::*;

/// Tables and figure.
pub fn report(study: &TimeToLevel, rows: &Rows<'_>, directory: &StudyDirectory) -> Result<Page, CommandError> {
    let (threads, ratio) = (directory.at_most_threads(), number(study.largest_ratio));
    let mut page = directory.page(include_str!("report.md"), &[("at-most", &threads), ("ratio", &ratio)]);
    page.part("Times", &[]);
    times(study, rows, &mut page);
    page.heading("Figure");
    let plot = plot(study, rows, directory)?;
    page.drawing("time-to-level.svg", multiples(&plot));
    page.part("All searches", &[]);
    let line = |row| Line::from(row).with("ending", Row::text(row, "ending").replace('-', " "));
    page.lines("All searches", rows.iter().map(line));

    Ok(rows.tell([Status::Reached, Status::OutOfTime, Status::OutOfSteps], page))
}

/// Whether a search ended at the level or below.
fn reached(row: &Row) -> bool {
    row.status() == Status::Reached
}

/// One line per dimension: steps and time of the method and of each rival, the longest with a mark where it did not reach the level, and the ratio of times.
fn times(study: &TimeToLevel, rows: &Rows<'_>, page: &mut Page) {
    let own = study.method.label();
    let clock = |row: &Row| {
        let here = rows.with("dim", row.value("dim").clone()).with("method", own);
        here.having(reached).first()?.number(SECONDS)
    };
    let told = |row: &Row| {
        let mark = if reached(row) { "" } else { "> " };
        let ratio = row
            .number(SECONDS)
            .zip(clock(row))
            .map(|(seconds, clock)| seconds / clock);
        let [steps, time] = ["steps", SECONDS].map(|column| format!("{mark}{}", row.value(column).cell()));
        let row = row.clone().with("took", steps).with("time", time).with("times", ratio);
        row.with("ratio", ratio.map(|ratio| format!("{mark}{}", number(ratio))))
    };
    let told: Vec<Row> = rows.iter().map(told).collect();
    let told: Rows<'_> = told.iter().collect();
    let rivals = MethodSpecification::labels(&study.rivals);
    let lines = told.lines("dim", study.dims.clone());
    page.lines_over("Times", &[each("own", [own]), each("rival", rivals)], lines);
    let is_bound = |row: &Row| !reached(row) && row.text("method") != own && row.number("times").is_some();
    let bounds: Vec<String> = told.having(is_bound).iter().map(|row| bound(row, own)).collect();
    page.items(&bounds);
}

/// What is known of a rival that did not reach the level.
fn bound(row: &Row, clock: &str) -> String {
    let state = row.number("energy_ratio").map_or("diverged".to_owned(), |levels| {
        format!("ED² is still {} times the level", number(levels))
    });
    let [dim, steps, times] = ["dim", "steps", "times"].map(|column| row.value(column).cell());
    let method = row.text("method");
    format!("- d = {dim}: after {steps} steps and {times} times the time of `{clock}`, {state} with `{method}`.")
}

/// The runs of all searches, ED² in levels against the time: one panel per dimension, one line per method, repeats in one point.
fn plot(study: &TimeToLevel, rows: &Rows<'_>, directory: &StudyDirectory) -> Result<MultiplesPlot, CommandError> {
    let mut trials = Vec::new();
    for case in study.cases()? {
        if let Some(row) = rows.with("case", case.id()).first() {
            let told = ["dim", "method", "energy_level"];
            let of = |trial, column| Row::with(trial, column, row.value(column).clone());
            let of_case = |trial: Row| completed(&told.into_iter().fold(trial, of));
            trials.extend(case.work.trials(directory, search::COLUMNS)?.into_iter().map(of_case));
        }
    }
    let trials: Rows<'_> = trials.iter().collect();
    let panel = |here: &Rows<'_>| {
        let line = |(label, runs): (String, Rows<'_>)| runs.path(label, "steps", SECONDS, "energy_ratio");
        let lines = here.by("method").into_iter().map(line);
        MultiplesPanel::new("", lines).with_level(1.0, "level of i.i.d. draws")
    };
    let known = study.dims.iter().filter(|dim| !trials.with("dim", **dim).is_empty());
    let panels = trials.panels(("d = ", "dim"), known.copied(), panel);
    Ok(MultiplesPlot::logarithmic("wall time of a run (s)", "ED² / level").with_panels(panels))
}
