//! The report of the study `covariance-spacing`.

use super::{CovarianceSpacing, Series};
use crate::plots::page::{Cell, MISSING, Page, line};
use crate::plots::{AxisKind, MultiplesPanel, MultiplesPlot, ReferenceLevel, multiples};
use crate::study::definition::Report;
use crate::study::run_row::{RunRow, curve, median, values};

/// The runs of one dimension and spacing, one per seed.
fn runs<'a>(rows: &'a [RunRow], series: &Series, spacing: f64) -> Vec<&'a RunRow> {
    let here = |row: &&RunRow| row.dim == series.dim.get() && row.spacing == Some(spacing);
    rows.iter().filter(here).collect()
}

/// The largest error at the judged spacing, and whether it keeps its bound.
fn judgement(rows: &[RunRow], series: &Series) -> Option<(f64, f64, f64, bool)> {
    let (spacing, bound) = (series.judged_spacing?, series.bound?);
    let errors = values(&runs(rows, series, spacing), |row| row.covariance_error);
    let worst = errors.into_iter().reduce(f64::max)?;
    Some((spacing, bound, worst, worst <= bound))
}

/// Tables and figure.
pub fn report(study: &CovarianceSpacing, rows: &[RunRow]) -> Report {
    let mut page = Page::new("Covariance error of resting particles against the grid spacing");
    page.paragraph(format!(
        "Target N(0, I), M = {} particles, {} seed(s), method `{}` without shifts of the grid and without a moment \
         correction. The error is the largest entry of |Ĉ − I| once the particles rest; h is in standard deviations. \
         Vanishing nodal forces mean exact moments; resting particles leave forces in the null space of the transfer.",
        study.particles,
        study.seeds.len(),
        study.method.label(),
    ));

    page.heading("Bounds");
    let mut verdicts = Vec::new();
    let mut table = Vec::new();
    for series in &study.series {
        if let Some((spacing, bound, worst, kept)) = judgement(rows, series) {
            verdicts.push(kept);
            let verdict = if kept { "kept" } else { "exceeded" };
            table.push(vec![
                series.dim.to_string(),
                spacing.to_string(),
                worst.cell(),
                bound.cell(),
                verdict.to_owned(),
            ]);
        }
    }
    let all_kept = !verdicts.is_empty() && verdicts.iter().all(|kept| *kept);
    page.table("d | h | largest error | bound | verdict", &table);

    page.heading("Error against spacing");
    let caption = "Covariance error of resting particles; medians over the seeds, bars from least to most.";
    page.figure("covariance-spacing.svg", caption, multiples(&plot(study, rows)));

    let mut table = Vec::new();
    for series in &study.series {
        for &spacing in &series.spacings {
            let here = runs(rows, series, spacing);
            let failed = here.iter().filter(|row| row.covariance_error.is_none());
            let failed: Vec<&str> = failed.map(|row| row.status.as_str()).collect();
            let error = median(&here, |row| row.covariance_error);
            let nodes = here.first().and_then(|row| row.active_nodes);
            let failed = if failed.is_empty() {
                MISSING.to_owned()
            } else {
                failed.join(", ")
            };
            table.push(line(&[
                &series.dim.get(),
                &spacing.to_string(),
                &error,
                &nodes,
                &failed,
            ]));
        }
    }
    page.table("d | h | median error | active nodes | failed", &table);

    let verdict = if all_kept { "pass" } else { "fail" };
    Report::new(page).with("verdict", verdict)
}

/// The errors against the spacing, a line per dimension.
fn plot(study: &CovarianceSpacing, rows: &[RunRow]) -> MultiplesPlot {
    let line = |series: &Series| {
        let mut spacings = series.spacings.clone();
        spacings.sort_by(f64::total_cmp);
        let points = spacings
            .into_iter()
            .map(|spacing| (spacing, runs(rows, series, spacing)));
        curve(format!("d = {}", series.dim), points, |row| row.covariance_error)
    };
    let mut bounds: Vec<f64> = study.series.iter().filter_map(|series| series.bound).collect();
    bounds.sort_by(f64::total_cmp);
    bounds.dedup();
    let level = |value| ReferenceLevel::new(value, "bound");
    MultiplesPlot {
        x_axis: AxisKind::Linear,
        panels: vec![MultiplesPanel {
            series: study.series.iter().map(line).collect(),
            levels: bounds.into_iter().map(level).collect(),
            ..MultiplesPanel::default()
        }],
        ..MultiplesPlot::logarithmic("grid spacing h (standard deviations)", "covariance error max |Ĉ − I|")
    }
}
