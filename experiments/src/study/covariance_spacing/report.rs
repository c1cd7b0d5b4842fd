//! The report of the study `covariance-spacing`.

use super::{CovarianceSpacing, Series};
use crate::study::prelude::*;

/// What is judged.
const ERROR: &str = "covariance_error";

/// The runs of one dimension and spacing, one per seed.
fn runs<'a>(rows: &Rows<'a>, series: &Series, spacing: f64) -> Rows<'a> {
    rows.with("dim", series.dim).with("spacing", spacing)
}

/// Tables and figure.
pub fn report(study: &CovarianceSpacing, rows: &Rows<'_>) -> Report {
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
    let mut all_kept = None;
    let mut table = Vec::new();
    for series in &study.series {
        let judged = series.judged_spacing.zip(series.bound);
        let worst = |spacing| runs(rows, series, spacing).largest(ERROR);
        if let Some((spacing, bound, worst)) =
            judged.and_then(|(spacing, bound)| Some((spacing, bound, worst(spacing)?)))
        {
            let kept = worst <= bound;
            all_kept = Some(kept && all_kept != Some(false));
            let verdict = if kept { "kept" } else { "exceeded" };
            table.push(line(&[
                &series.dim.get(),
                &spacing.to_string(),
                &worst,
                &bound,
                &verdict,
            ]));
        }
    }
    page.table("d | h | largest error | bound | verdict", &table);

    page.heading("Error against spacing");
    let caption = "Covariance error of resting particles; medians over the seeds, bars from least to most.";
    page.figure("covariance-spacing.svg", caption, multiples(&plot(study, rows)));

    let mut table = Vec::new();
    for series in &study.series {
        for &spacing in &series.spacings {
            let here = runs(rows, series, spacing);
            let failed = here.having(|row| row.number(ERROR).is_none());
            let failed: Vec<&str> = failed.iter().map(|row| row.status().as_str()).collect();
            let failed = (!failed.is_empty()).then(|| failed.join(", "));
            let nodes = here.first().and_then(|row| row.count("active_nodes"));
            table.push(line(&[
                &series.dim.get(),
                &spacing.to_string(),
                &here.median(ERROR),
                &nodes,
                &failed,
            ]));
        }
    }
    page.table("d | h | median error | active nodes | failed", &table);

    let verdict = if all_kept == Some(true) { "pass" } else { "fail" };
    Report::new(page).with("verdict", verdict)
}

/// The errors against the spacing, a line per dimension.
fn plot(study: &CovarianceSpacing, rows: &Rows<'_>) -> MultiplesPlot {
    let line = |series: &Series| {
        let mut spacings = series.spacings.clone();
        spacings.sort_by(f64::total_cmp);
        let points = spacings
            .into_iter()
            .map(|spacing| (spacing, runs(rows, series, spacing)));
        curve(format!("d = {}", series.dim), points, ERROR)
    };
    let mut bounds: Vec<f64> = study.series.iter().filter_map(|series| series.bound).collect();
    bounds.sort_by(f64::total_cmp);
    bounds.dedup();
    let panel = MultiplesPanel::new("", study.series.iter().map(line));
    let panel = bounds
        .into_iter()
        .fold(panel, |panel, bound| panel.with_level(bound, "bound"));
    MultiplesPlot::logarithmic("grid spacing h (standard deviations)", "covariance error max |Ĉ − I|")
        .over_linear()
        .with_panels([panel])
}
