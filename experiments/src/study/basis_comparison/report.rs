//! The report of the study `basis-comparison`.

use super::BasisComparison;
use super::choice::Choice;
use crate::study::prelude::*;

/// Tables and figure.
pub fn report(study: &BasisComparison, rows: &Rows<'_>, directory: &StudyDirectory) -> Result<Page, CommandError> {
    let most = study.step_counts().last().copied().unwrap_or(0);
    let mut page = directory.page(include_str!("report.md"), &[("most", &most)]);
    page.heading("Figure");
    let drawing = multiples(&plot(study, rows));
    page.drawing("basis-comparison.svg", drawing);
    let first = study.bases.first().map(Basis::to_string).unwrap_or_default();
    page.part("At the best spacing", &[("first", &first)]);
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
