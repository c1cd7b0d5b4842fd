//! The report of the study `covariance-spacing`.

use super::{CovarianceSpacing, Series};
use crate::study::prelude::*;

/// What is judged.
const ERROR: &str = "covariance_error";

/// Tables and figure.
pub fn report(study: &CovarianceSpacing, rows: &Rows<'_>, directory: &StudyDirectory) -> Result<Page, CommandError> {
    let mut page = directory.page(include_str!("report.md"), &[]);

    page.heading("Bounds");
    let mut kept = Vec::new();
    let mut table = Vec::new();
    for Series {
        dim,
        judged_spacing,
        bound,
        ..
    } in &study.series
    {
        let Some((spacing, bound)) = judged_spacing.zip(*bound) else {
            continue;
        };
        if let Some(worst) = rows.with("dim", *dim).with("spacing", spacing).largest(ERROR) {
            kept.push(worst <= bound);
            let verdict = if worst <= bound { "kept" } else { "exceeded" };
            table.push(line(&[&dim.get(), &spacing.to_string(), &worst, &bound, &verdict]));
        }
    }
    page.table("d | h | largest error | bound | verdict", &table);

    page.heading("Error against spacing");
    page.drawing("covariance-spacing.svg", multiples(&plot(study, rows)));

    let mut table = Vec::new();
    for Series { dim, spacings, .. } in &study.series {
        for &spacing in spacings {
            let here = rows.with("dim", *dim).with("spacing", spacing);
            let failed = here.having(|row| row.number(ERROR).is_none());
            let failed: Vec<&str> = failed.iter().map(|row| row.status().as_str()).collect();
            let failed = (!failed.is_empty()).then(|| failed.join(", ")).cell();
            let names = vec![dim.to_string(), spacing.to_string()];
            let cells = here.cells("median covariance_error | first active_nodes");
            table.push([names, cells, vec![failed]].concat());
        }
    }
    page.table("d | h | median error | active nodes | failed", &table);

    let all_kept = !kept.is_empty() && !kept.contains(&false);
    Ok(page.with("verdict", if all_kept { "pass" } else { "fail" }))
}

/// The errors against the spacing, a line per dimension.
fn plot(study: &CovarianceSpacing, rows: &Rows<'_>) -> MultiplesPlot {
    let line = |Series { dim, .. }: &Series| {
        let here = rows.with("dim", *dim);
        here.curve(format!("d = {dim}"), "spacing", ERROR)
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
