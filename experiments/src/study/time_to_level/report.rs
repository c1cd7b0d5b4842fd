//! The report of the study `time-to-level`.

use super::search::{Ending, Trial};
use super::{Case, Row, TimeToLevel};
use crate::CommandError;
use crate::output::table_file;
use crate::plots::page::{Cell, MISSING, Page, line, number};
use crate::plots::{LineSeries, MultiplesPanel, MultiplesPlot, ReferenceLevel, multiples};
use crate::statistics::summarize;
use crate::study::definition::{self, Report, Study};
use crate::study::directory::StudyDirectory;

/// Tables and figure.
pub fn report(study: &TimeToLevel, rows: &[Row], directory: &StudyDirectory) -> Result<Report, CommandError> {
    let mut page = Page::new("Wall time to the error of independent draws");
    page.paragraph(format!(
        "Target N(0, I), M = {} particles, which begin as N({} · 1, {}² I); seed {}, all methods on the same threads{}. The \
         level is E‖Y − Y'‖/M, the expected ED² of M independent draws. A method is run with more and more steps until a run \
         ends at or below the level; its time is that of this one run (median of up to {} where it takes less than a second). \
         A rival is stopped once a run takes {} times as long as `{}` needed.",
        study.particles,
        study.start.mean,
        study.start.standard_deviation,
        study.seed,
        study
            .threads
            .map_or(String::new(), |threads| format!(" (at most {threads})")),
        study.repeats,
        number(study.largest_ratio),
        study.method.label(),
    ));
    page.heading("Times");
    times(study, rows, &mut page);
    page.heading("Figure");
    let caption = "ED² in units of the level against the wall time of a run, a point per number of steps.";
    let plot = plot(study, rows, directory)?;
    page.figure("time-to-level.svg", caption, multiples(&plot));
    page.heading("All searches");
    searches(rows, &mut page);

    let count = |ending: Ending| rows.iter().filter(|row| row.ending == ending).count();
    Ok(Report::new(page)
        .with("reached", count(Ending::Reached))
        .with("out_of_time", count(Ending::OutOfTime))
        .with("out_of_steps", count(Ending::OutOfSteps)))
}

/// ED² after the last run, in units of the level.
fn levels(row: &Row) -> Option<f64> {
    row.energy_distance_squared.map(|energy| energy / row.energy_level)
}

/// One line per dimension: steps and time of the method and of each rival, and the ratio of times.
fn times(study: &TimeToLevel, rows: &[Row], page: &mut Page) {
    let label = study.method.label();
    let mut header = vec![
        "d".to_owned(),
        "level".to_owned(),
        format!("{label}: steps"),
        format!("{label}: time (s)"),
    ];
    for rival in study.rivals.iter().map(|rival| rival.label()) {
        header.extend([
            format!("{rival}: steps"),
            format!("{rival}: time (s)"),
            format!("{rival} / {label}"),
        ]);
    }
    let mut table = Vec::new();
    let mut bounds = Vec::new();
    for &dim in &study.dims {
        let find = |label: &str| rows.iter().find(|row| row.dim == dim.get() && row.method == label);
        let clock = find(label);
        let mut line = vec![dim.to_string(), clock.map(|row| row.energy_level).cell()];
        line.extend(steps_and_time(clock));
        let clock = clock.filter(|row| row.ending == Ending::Reached);
        for rival in &study.rivals {
            let row = find(rival.label());
            line.extend(steps_and_time(row));
            let ratio = row.zip(clock).map(|(row, clock)| row.wall_seconds / clock.wall_seconds);
            let unreached = row.filter(|row| row.ending != Ending::Reached);
            line.push(match (ratio, unreached) {
                (None, _) => MISSING.to_owned(),
                (Some(ratio), None) => number(ratio),
                (Some(ratio), Some(row)) => {
                    bounds.push(bound(row, label, ratio));
                    format!("> {}", number(ratio))
                }
            });
        }
        table.push(line);
    }
    page.table(&header, &table);
    if !bounds.is_empty() {
        page.paragraph(bounds.join("\n"));
    }
}

/// Steps and time of the run that reached the level, or of the longest one with a mark that it did not.
fn steps_and_time(row: Option<&Row>) -> [String; 2] {
    match row {
        None => [MISSING.to_owned(), MISSING.to_owned()],
        Some(row) => {
            let mark = if row.ending == Ending::Reached { "" } else { "> " };
            [
                format!("{mark}{}", row.steps),
                format!("{mark}{}", number(row.wall_seconds)),
            ]
        }
    }
}

fn bound(row: &Row, clock: &str, ratio: f64) -> String {
    let state = levels(row).map_or("diverged".to_owned(), |levels| {
        format!("ED² is still {} times the level", number(levels))
    });
    format!(
        "- d = {}: after {} steps and {} times the time of `{clock}`, {state} with `{}`.",
        row.dim,
        row.steps,
        number(ratio),
        row.method,
    )
}

fn searches(rows: &[Row], page: &mut Page) {
    let line = |row: &Row| {
        let ending = match row.ending {
            Ending::Reached => "reached",
            Ending::OutOfTime => "out of time",
            Ending::OutOfSteps => "out of steps",
        };
        line(&[
            &row.dim,
            &row.method,
            &ending,
            &row.runs,
            &row.steps,
            &levels(row),
            &row.wall_seconds,
            &row.wall_seconds_least,
            &row.wall_seconds_most,
            &row.wall_budget_seconds,
        ])
    };
    let header = "d | method | ending | runs | steps | ED² / level | time (s) | least (s) | most (s) | budget (s)";
    page.table(header, rows.iter().map(line));
}

/// One panel per dimension, one line per method.
fn plot(study: &TimeToLevel, rows: &[Row], directory: &StudyDirectory) -> Result<MultiplesPlot, CommandError> {
    let mut panels: Vec<MultiplesPanel> = Vec::new();
    for case in study.cases()? {
        let id = definition::Case::id(&case);
        let Some(row) = rows.iter().find(|row| row.case == id) else {
            continue;
        };
        let title = format!("d = {}", case.dim);
        let line = curve(&case, row, &table_file::read(&case.trials_file(directory))?)?;
        match panels.last_mut().filter(|panel| panel.title == title) {
            Some(panel) => panel.series.push(line),
            None => panels.push(MultiplesPanel {
                title,
                series: vec![line],
                guides: Vec::new(),
                levels: vec![ReferenceLevel::new(1.0, "level of i.i.d. draws")],
            }),
        }
    }
    Ok(MultiplesPlot {
        panels,
        ..MultiplesPlot::logarithmic("wall time of a run (s)", "ED² / level")
    })
}

/// The runs of one search: ED² in levels against the time, repeats in one point.
fn curve(case: &Case, row: &Row, trials: &[Trial]) -> Result<LineSeries, CommandError> {
    let mut line = LineSeries::named(case.method.label());
    for repeats in trials.chunk_by(|left, right| left.steps == right.steps) {
        let times: Vec<f64> = repeats.iter().map(|trial| trial.wall_seconds).collect();
        let energy = repeats.first().and_then(|trial| trial.energy_distance_squared);
        line.x.push(summarize(&times)?.median);
        line.y.push(energy.map_or(f64::NAN, |energy| energy / row.energy_level));
    }
    Ok(line)
}
