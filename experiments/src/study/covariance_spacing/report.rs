//! The report of the study `covariance-spacing`.

use super::{CovarianceSpacing, Series};
use crate::study::prelude::*;

/// What is judged.
const ERROR: &str = "covariance_error";

/// Tables and figure.
pub fn report(study: &CovarianceSpacing, rows: &Rows<'_>, directory: &StudyDirectory) -> Result<Page, CommandError> {
    let mut page = directory.page(include_str!("report.md"), &[]);

    let judged = |series: &Series| {
        let (spacing, bound) = series.judged_spacing.zip(series.bound)?;
        let here = rows.with("dim", series.dim).with("spacing", spacing);
        let is_kept = here.largest(ERROR)? <= bound;
        let line = Line::from(here).with("bound", bound);
        Some((is_kept, line.with("verdict", if is_kept { "kept" } else { "exceeded" })))
    };
    let (kept, lines): (Vec<bool>, Vec<Line<'_>>) = study.series.iter().filter_map(judged).unzip();
    page.section("Bounds", &[], lines);
    page.part("Error against spacing", &[]);
    page.drawing("covariance-spacing.svg", multiples(&plot(study, rows)));

    let lines = |Series { dim, spacings, .. }: &Series| {
        let line = Line::from(rows.with("dim", *dim)).with("dim", dim.get());
        line.by("spacing", spacings.clone())
    };
    page.lines("Error against spacing", study.series.iter().flat_map(lines));

    let all_kept = !kept.is_empty() && !kept.contains(&false);
    Ok(page.with("verdict", if all_kept { "pass" } else { "fail" }))
}

/// The errors against the spacing, a line per dimension.
fn plot(study: &CovarianceSpacing, rows: &Rows<'_>) -> MultiplesPlot {
    let mut bounds: Vec<f64> = study.series.iter().filter_map(|series| series.bound).collect();
    bounds.sort_by(f64::total_cmp);
    bounds.dedup();
    let dims = study.series.iter().map(|series| series.dim);
    let panel = MultiplesPanel::new("", rows.curves(("d = ", "dim"), dims, "spacing", ERROR));
    let bounded = |panel: MultiplesPanel, bound: f64| panel.with_level(bound, "bound");
    let panel = bounds.into_iter().fold(panel, bounded);
    MultiplesPlot::logarithmic("grid spacing h (standard deviations)", "covariance error max |Ĉ − I|")
        .over_linear()
        .with_panels([panel])
}
