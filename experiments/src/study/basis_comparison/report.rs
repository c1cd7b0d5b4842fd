//! The report of the study `basis-comparison`.

use super::BasisComparison;
use super::choice::{Choice, runs};
use crate::options::{Basis, Dimension};
use crate::plots::page::{Cell, MISSING, Page, line, number};
use crate::plots::{LineSeries, MultiplesPanel, MultiplesPlot, ReferenceLevel, multiples};
use crate::study::definition::Report;
use crate::study::run_row::{ENERGY, NODES_PER_PARTICLE, RunRow, SECONDS, median, report_of_runs, values};

/// Tables and figure.
pub fn report(study: &BasisComparison, rows: &[RunRow]) -> Report {
    let mut page = Page::new("Bases at equal time");
    page.paragraph(format!(
        "Target N(0, I), M = {} particles, method `{}`, {} seeds; medians over the seeds. ED² is the squared energy distance, \
         exact in the expectation over the Gaussian. Spacings h, in standard deviations, are multiples of each basis's own \
         default; the best is the one with the lowest ED² at {} steps.",
        study.particles,
        study.method.label(),
        study.seeds.len(),
        study.step_counts().last().copied().unwrap_or(0),
    ));
    page.heading("Figure");
    let caption =
        "Squared energy distance ED² against wall time at each basis's best spacing, a point per number of steps.";
    let drawing = multiples(&plot(study, rows));
    page.figure("basis-comparison.svg", caption, drawing);
    page.heading("At the best spacing");
    if let Some(first) = study.bases.first() {
        page.paragraph(format!(
            "ED² × 10³ and wall time per number of steps T; in the last column ED² × 10³ at the largest T of that basis that \
             takes no longer than the largest T of `{first}`. An asterisk marks a best spacing at the edge of the scan.",
        ));
    }
    for &dim in &study.dims {
        page.paragraph(format!("**d = {dim}**"));
        best_table(study, rows, dim, &mut page);
    }
    page.heading("Spacings");
    spacings(study, rows, &mut page);
    report_of_runs(page, rows)
}

/// The median ED² × 10³.
fn thousandths(rows: &[&RunRow]) -> Option<f64> {
    median(rows, ENERGY).map(|energy| 1e3 * energy)
}

fn best_table(study: &BasisComparison, rows: &[RunRow], dim: Dimension, page: &mut Page) {
    let first = study.bases.first();
    let allowed = first.and_then(|&basis| Choice::of(study, rows, dim, basis)?.longest());
    let mut header = ["basis", "best h", "h / default"].map(str::to_owned).to_vec();
    for steps in study.step_counts() {
        header.extend([format!("ED², T = {steps}"), format!("time (s), T = {steps}")]);
    }
    let name = first.map_or(String::new(), Basis::to_string);
    header.push(format!("ED² in the time of {name}"));
    let mut table = Vec::new();
    for &basis in &study.bases {
        let Some(choice) = Choice::of(study, rows, dim, basis) else {
            continue;
        };
        let edge = if choice.is_at_the_edge(study) { "*" } else { "" };
        let factor = format!("{}{edge}", choice.factor);
        let mut cells = line(&[&basis.to_string(), &choice.spacing(), &factor]);
        for steps in study.step_counts() {
            let here = runs(rows, dim, basis, choice.factor, steps);
            cells.extend(line(&[&thousandths(&here), &median(&here, SECONDS)]));
        }
        let equal = allowed.and_then(|seconds| choice.within(seconds));
        cells.push(equal.map_or(MISSING.to_owned(), |(steps, energy)| {
            format!("{} (T = {steps})", number(1e3 * energy))
        }));
        table.push(cells);
    }
    page.table(&header, &table);
}

/// The errors of all spacings at the largest number of steps.
fn spacings(study: &BasisComparison, rows: &[RunRow], page: &mut Page) {
    let Some(&most) = study.step_counts().last() else {
        return;
    };
    page.paragraph(format!("All spacings at {most} steps."));
    let mut table = Vec::new();
    for &dim in &study.dims {
        for &basis in &study.bases {
            for &factor in &study.spacings {
                let here = runs(rows, dim, basis, factor, most);
                let mut cells = vec![dim.to_string(), basis.to_string(), factor.to_string()];
                cells.push(here.first().and_then(|row| row.requested_spacing).cell());
                cells.push(thousandths(&here).cell());
                cells.extend([NODES_PER_PARTICLE, SECONDS].map(|quantity| median(&here, quantity).cell()));
                table.push(cells);
            }
        }
    }
    page.table(
        "d | basis | h / default | h | ED² × 10³ | active nodes / M | time (s)",
        &table,
    );
}

/// One panel per dimension, one line per basis.
fn plot(study: &BasisComparison, rows: &[RunRow]) -> MultiplesPlot {
    let level = |value| ReferenceLevel::new(value, "expected of i.i.d. draws");
    let panel = |&dim: &Dimension| {
        let row = rows.iter().find(|row| row.dim == dim.get());
        let lines = study.bases.iter();
        MultiplesPanel {
            title: format!("d = {dim}"),
            series: lines.filter_map(|&basis| curve(study, rows, dim, basis)).collect(),
            levels: row.and_then(|row| row.energy_level).map(level).into_iter().collect(),
            ..MultiplesPanel::default()
        }
    };
    MultiplesPlot {
        panels: study.dims.iter().map(panel).collect(),
        notes: vec!["Medians over the seeds; bars from the smallest to the largest ED².".to_owned()],
        ..MultiplesPlot::logarithmic("wall time (s)", "ED² (standard deviations)")
    }
}

fn curve(study: &BasisComparison, rows: &[RunRow], dim: Dimension, basis: Basis) -> Option<LineSeries> {
    let choice = Choice::of(study, rows, dim, basis)?;
    let mut line = LineSeries::named(basis.to_string());
    for (_, runs) in &choice.by_steps {
        if let Some(time) = median(runs, SECONDS) {
            line.push_median(time, &values(runs, ENERGY));
        }
    }
    Some(line)
}
