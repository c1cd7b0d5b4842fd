//! The report of the study `basis-comparison`.

use super::BasisComparison;
use super::choice::Choice;
use crate::study::prelude::*;

/// Tables and figure.
pub fn report(study: &BasisComparison, rows: &Rows<'_>, _: &StudyDirectory) -> Result<Page, CommandError> {
    let mut page = Page::new("Bases at equal time");
    let most = study.step_counts().last().copied().unwrap_or(0);
    page.paragraph(format!(
        "Target N(0, I), M = {} particles, method `{}`, {} seeds; medians over the seeds. ED² is the squared energy distance, \
         exact in the expectation over the Gaussian. Spacings h, in standard deviations, are multiples of each basis's own \
         default; the best is the one with the lowest ED² at {most} steps.",
        study.particles,
        study.method.label(),
        study.seeds.len(),
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
    for dim in &study.dims {
        page.paragraph(format!("**d = {dim}**"));
        best_table(study, &rows.with("dim", *dim), &mut page);
    }
    page.heading("Spacings");
    spacings(study, &rows.with("requested_steps", most), &mut page);
    Ok(rows.close(page))
}

/// A line per basis, in one dimension.
fn best_table(study: &BasisComparison, here: &Rows<'_>, page: &mut Page) {
    let (Some(first), Some(&most)) = (study.bases.first(), study.step_counts().last()) else {
        return;
    };
    let longest = |choice: Choice<'_>| choice.with_steps(most).median(SECONDS);
    let allowed = Choice::of(study, here, *first).and_then(longest);
    let mut header = "basis | best h | h / default".names();
    for steps in study.step_counts() {
        header.extend([format!("ED², T = {steps}"), format!("time (s), T = {steps}")]);
    }
    header.push(format!("ED² in the time of {first}"));
    let cells = |&basis: &Basis| {
        let choice = Choice::of(study, here, basis)?;
        let edge = if choice.is_at_the_edge(study) { "*" } else { "" };
        let mut cells = vec![basis.to_string()];
        cells.extend(choice.runs.cells("first requested_spacing"));
        cells.push(format!("{}{edge}", choice.factor));
        for steps in study.step_counts() {
            let statistics = "median energy_thousandths | median wall_seconds";
            cells.extend(choice.with_steps(steps).cells(statistics));
        }
        let equal = allowed.and_then(|seconds| choice.within(study, seconds));
        cells.push(
            equal
                .map(|(steps, energy)| format!("{} (T = {steps})", number(energy)))
                .cell(),
        );
        Some(cells)
    };
    page.table(&header, study.bases.iter().filter_map(cells));
}

/// The errors of all spacings at the largest number of steps.
fn spacings(study: &BasisComparison, rows: &Rows<'_>, page: &mut Page) {
    let most = study.step_counts().last().copied().unwrap_or(0);
    page.paragraph(format!("All spacings at {most} steps."));
    let statistics =
        "first requested_spacing | median energy_thousandths | median nodes_per_particle | median wall_seconds";
    let mut table = Vec::new();
    for &dim in &study.dims {
        for basis in &study.bases {
            for &factor in &study.spacings {
                let here = rows.with("dim", dim).with("series", basis.to_string());
                let names = [dim.to_string(), basis.to_string(), factor.to_string()];
                table.push([&names[..], &here.with("spacing_factor", factor).cells(statistics)].concat());
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
        let lines = study.bases.iter().filter_map(|&basis| line_of(study, &here, basis));
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

fn line_of(study: &BasisComparison, here: &Rows<'_>, basis: Basis) -> Option<LineSeries> {
    let choice = Choice::of(study, here, basis)?;
    let mut line = LineSeries::named(basis.to_string());
    for steps in study.step_counts() {
        let runs = choice.with_steps(steps);
        if let Some(seconds) = runs.median(SECONDS) {
            line.push_median(seconds, &runs.values(ENERGY));
        }
    }
    Some(line)
}
