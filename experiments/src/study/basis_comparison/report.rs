//! The report of the study `basis-comparison`.

use super::BasisComparison;
use super::choice::{Choice, at};
use crate::study::prelude::*;

/// Tables and figure.
pub fn report(study: &BasisComparison, rows: &Rows<'_>) -> Report {
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
    rows.report(page)
}

/// The median ED² × 10³.
fn thousandths(rows: &Rows<'_>) -> Option<f64> {
    rows.median(ENERGY).map(|energy| 1e3 * energy)
}

fn best_table(study: &BasisComparison, rows: &Rows<'_>, dim: Dimension, page: &mut Page) {
    let first = study.bases.first();
    let allowed = first.and_then(|&basis| Choice::of(study, rows, dim, basis)?.longest());
    let mut header = "basis | best h | h / default".names();
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
            let here = at(rows, dim, basis, choice.factor).with("requested_steps", steps);
            cells.extend(line(&[&thousandths(&here), &here.median(SECONDS)]));
        }
        let equal = allowed.and_then(|seconds| choice.within(seconds));
        cells.push(
            equal
                .map(|(steps, energy)| format!("{} (T = {steps})", number(1e3 * energy)))
                .cell(),
        );
        table.push(cells);
    }
    page.table(&header, &table);
}

/// The errors of all spacings at the largest number of steps.
fn spacings(study: &BasisComparison, rows: &Rows<'_>, page: &mut Page) {
    let Some(&most) = study.step_counts().last() else {
        return;
    };
    page.paragraph(format!("All spacings at {most} steps."));
    let mut table = Vec::new();
    for &dim in &study.dims {
        for &basis in &study.bases {
            for &factor in &study.spacings {
                let here = at(rows, dim, basis, factor).with("requested_steps", most);
                let spacing = here.first().and_then(|row| row.number("requested_spacing"));
                let names = line(&[&dim.to_string(), &basis.to_string(), &factor.to_string(), &spacing]);
                let cells = here.medians(&[&NODES_PER_PARTICLE, &SECONDS]);
                table.push([names, vec![thousandths(&here).cell()], cells].concat());
            }
        }
    }
    page.table(
        "d | basis | h / default | h | ED² × 10³ | active nodes / M | time (s)",
        &table,
    );
}

/// One panel per dimension, one line per basis.
fn plot(study: &BasisComparison, rows: &Rows<'_>) -> MultiplesPlot {
    let panel = |&dim: &Dimension| {
        let here = rows.with("dim", dim);
        let expected = here.first().and_then(|row| row.number("energy_level"));
        let lines = study
            .bases
            .iter()
            .filter_map(|&basis| line_of(study, &here, dim, basis));
        let panel = MultiplesPanel::new(format!("d = {dim}"), lines);
        match expected {
            Some(level) => panel.with_level(level, "expected of i.i.d. draws"),
            None => panel,
        }
    };
    MultiplesPlot::logarithmic("wall time (s)", "ED² (standard deviations)")
        .with_panels(study.dims.iter().map(panel))
        .with_note("Medians over the seeds; bars from the smallest to the largest ED².")
}

fn line_of(study: &BasisComparison, rows: &Rows<'_>, dim: Dimension, basis: Basis) -> Option<LineSeries> {
    let choice = Choice::of(study, rows, dim, basis)?;
    let timed = choice.by_steps.into_iter();
    let points = timed.filter_map(|(_, runs)| Some((runs.median(SECONDS)?, runs)));
    Some(curve(basis.to_string(), points, ENERGY))
}
