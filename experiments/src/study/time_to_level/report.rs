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

/// One line per dimension: steps and time of the method and of each rival, and the ratio of times.
fn times(study: &TimeToLevel, rows: &Rows<'_>, page: &mut Page) {
    let label = study.method.label();
    let mut lines = Vec::new();
    let mut bounds = Vec::new();
    for &dim in &study.dims {
        let here = rows.with("dim", dim);
        let find = |label: &str| here.with("method", label).first();
        let own = find(label);
        let clock = own.filter(|row| reached(row)).and_then(|row| row.number(SECONDS));
        let level = own.and_then(|row| row.number("energy_level"));
        let mut line = steps_and_time(Line::default().with("dim", dim.get()).with("level", level), label, own);
        for rival in MethodSpecification::labels(&study.rivals) {
            let row = find(rival);
            let ratio = row.and_then(|row| Some(row.number(SECONDS)? / clock?));
            let text = match (ratio, row.filter(|row| !reached(row))) {
                (Some(ratio), Some(row)) => {
                    bounds.push(bound(row, label, ratio));
                    format!("> {}", number(ratio))
                }
                (ratio, _) => ratio.cell(),
            };
            line = steps_and_time(line, rival, row).with(format!("ratio {rival}"), text);
        }
        lines.push(line);
    }
    let rivals = MethodSpecification::labels(&study.rivals);
    page.lines_over("Times", &[each("own", [label]), each("rival", rivals)], lines);
    if !bounds.is_empty() {
        page.paragraph(bounds.join("\n"));
    }
}

/// Steps and time of the run that reached the level, or of the longest one with a mark that it did not.
fn steps_and_time<'a>(line: Line<'a>, label: &str, row: Option<&Row>) -> Line<'a> {
    let mark = if row.is_none_or(reached) { "" } else { "> " };
    let cell = |column: &str| format!("{mark}{}", row.map(|row| row.value(column)).cell());
    let line = line.with(format!("steps {label}"), cell("steps"));
    line.with(format!("time {label}"), cell(SECONDS))
}

fn bound(row: &Row, clock: &str, ratio: f64) -> String {
    let state = row.number("energy_ratio").map_or("diverged".to_owned(), |levels| {
        format!("ED² is still {} times the level", number(levels))
    });
    let ([dim, steps], method) = (
        ["dim", "steps"].map(|column| row.value(column).cell()),
        row.text("method"),
    );
    let times = format!("{} times the time of `{clock}`", number(ratio));
    format!("- d = {dim}: after {steps} steps and {times}, {state} with `{method}`.")
}

/// One panel per dimension, one line per method.
fn plot(study: &TimeToLevel, rows: &Rows<'_>, directory: &StudyDirectory) -> Result<MultiplesPlot, CommandError> {
    let mut panels: Vec<MultiplesPanel> = Vec::new();
    for case in study.cases()? {
        let Some(row) = rows.with("case", case.id()).first() else {
            continue;
        };
        let title = format!("d = {}", case.work.dim);
        let trials = search::read(&case.work.trials_file(directory))?;
        let line = curve_of(case.work.method.label(), row, &trials.iter().collect());
        match panels.last_mut().filter(|panel| panel.title == title) {
            Some(panel) => panel.series.push(line),
            None => panels.push(MultiplesPanel::new(title, [line]).with_level(1.0, "level of i.i.d. draws")),
        }
    }
    Ok(MultiplesPlot::logarithmic("wall time of a run (s)", "ED² / level").with_panels(panels))
}

/// The runs of one search: ED² in levels against the time, repeats in one point.
fn curve_of(label: &str, row: &Row, trials: &Rows<'_>) -> LineSeries {
    let mut line = LineSeries::named(label);
    let level = row.number("energy_level").unwrap_or(f64::NAN);
    for (_, repeats) in trials.by("steps") {
        let energy = repeats.first().and_then(|trial| trial.number(ENERGY));
        line.x.extend(repeats.median(SECONDS));
        line.y.push(energy.map_or(f64::NAN, |energy| energy / level));
    }
    line
}
