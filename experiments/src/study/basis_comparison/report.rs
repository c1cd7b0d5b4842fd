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
    page.part("Spacings", &[("most", &most)]);
    let dims = rows.with("requested_steps", most).lines("dim", study.dims.clone());
    let bases = dims.iter().flat_map(|line| line.by("series", study.bases.clone()));
    let lines = bases.flat_map(|line| line.by("spacing_factor", study.spacings.clone()));
    page.lines("Spacings", lines);
    Ok(rows.close(page))
}

/// A line per basis, in one dimension.
fn best_table(study: &BasisComparison, here: &Rows<'_>, page: &mut Page) {
    let (Some(first), Some(&most)) = (study.bases.first(), study.step_counts().last()) else {
        return;
    };
    let longest = |choice: Choice<'_>| choice.with_steps(most).median(SECONDS);
    let allowed = Choice::of(study, here, *first).and_then(longest);
    let line = |&basis: &Basis| {
        let choice = Choice::of(study, here, basis)?;
        let edge = if choice.is_at_the_edge(study) { "*" } else { "" };
        let equal = allowed.and_then(|seconds| choice.within(study, seconds));
        let equal = equal.map(|(steps, energy)| format!("{} (T = {steps})", number(energy)));
        let line = Line::from(choice.runs).with("factor", format!("{}{edge}", choice.factor));
        Some(line.with("equal", equal))
    };
    let repeated = [each("T", study.step_counts()), each("first", [first])];
    page.lines_over("At the best spacing", &repeated, study.bases.iter().filter_map(line));
}

/// One panel per dimension, one line per basis.
fn plot(study: &BasisComparison, rows: &Rows<'_>) -> MultiplesPlot {
    let panel = |here: &Rows<'_>| {
        let expected = here.first().and_then(|row| row.number("energy_level"));
        let lines = study.bases.iter().filter_map(|&basis| line_of(study, here, basis));
        MultiplesPanel::new("", lines).with_level(expected, "expected of i.i.d. draws")
    };
    MultiplesPlot::logarithmic("wall time (s)", "ED² (standard deviations)")
        .with_panels(rows.panels(("d = ", "dim"), study.dims.clone(), panel))
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
