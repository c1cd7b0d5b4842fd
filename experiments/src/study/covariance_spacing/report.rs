//! The report of the study `covariance-spacing`.

use super::Row;
use super::configuration::{CovarianceSpacing, Series};
use crate::CommandError;
use crate::plots::{AxisKind, LinePlot, LineSeries, ReferenceLevel, line};
use crate::statistics::summarize;
use crate::study::definition::Report;
use crate::study::directory::StudyDirectory;
use crate::study::document::{Document, MISSING, number, optional_number};

/// The covariance errors of one dimension and spacing, over the seeds.
fn errors(rows: &[Row], series: &Series, spacing: f64) -> Vec<f64> {
    let here = |row: &&Row| row.dim == series.dim.get() && row.spacing == spacing;
    rows.iter()
        .filter(here)
        .filter_map(|row| row.covariance_error)
        .collect()
}

/// The largest error at the judged spacing, and whether it keeps its bound.
fn judgement(rows: &[Row], series: &Series) -> Option<(f64, f64, f64, bool)> {
    let (spacing, bound) = (series.judged_spacing?, series.bound?);
    let worst = errors(rows, series, spacing).into_iter().reduce(f64::max)?;
    Some((spacing, bound, worst, worst <= bound))
}

/// Tables and figure.
pub fn report(study: &CovarianceSpacing, rows: &[Row], directory: &StudyDirectory) -> Result<Report, CommandError> {
    let mut document = Document::new("Covariance error of resting particles against the grid spacing");
    document.paragraph(format!(
        "Target N(0, I), M = {} particles, {} seed(s), method `{}` without shifts of the grid and without a moment \
         correction. The error is the largest entry of |Ĉ − I| once the particles rest; h is in standard deviations. \
         Vanishing nodal forces mean exact moments; resting particles leave forces in the null space of the transfer.",
        study.particles,
        study.seeds.len(),
        study.method.label(),
    ));

    document.heading("Bounds");
    let mut verdicts = Vec::new();
    let mut table = Vec::new();
    for series in &study.series {
        if let Some((spacing, bound, worst, kept)) = judgement(rows, series) {
            verdicts.push(kept);
            let verdict = if kept { "kept" } else { "exceeded" };
            table.push(vec![
                series.dim.to_string(),
                spacing.to_string(),
                number(worst),
                number(bound),
                verdict.to_owned(),
            ]);
        }
    }
    let all_kept = !verdicts.is_empty() && verdicts.iter().all(|kept| *kept);
    document.table(&["d", "h", "largest error", "bound", "verdict"], &table);

    document.heading("Error against spacing");
    let curves = study
        .series
        .iter()
        .map(|series| curve(rows, series))
        .collect::<Result<Vec<_>, _>>()?;
    let mut bounds: Vec<f64> = study.series.iter().filter_map(|series| series.bound).collect();
    bounds.sort_by(f64::total_cmp);
    bounds.dedup();
    let plot = LinePlot {
        title: String::new(),
        x_label: "grid spacing h (standard deviations)".to_owned(),
        y_label: "covariance error max |Ĉ − I|".to_owned(),
        x_axis: AxisKind::Linear,
        y_axis: AxisKind::Logarithmic,
        series: curves,
        levels: bounds
            .iter()
            .map(|&value| ReferenceLevel {
                value,
                label: "bound".to_owned(),
            })
            .collect(),
    };
    let caption = "Covariance error of resting particles; medians over the seeds, bars from least to most.";
    document.figure(directory, "covariance-spacing.svg", caption, line(&plot))?;

    let mut table = Vec::new();
    for series in &study.series {
        for &spacing in &series.spacings {
            let errors = errors(rows, series, spacing);
            let median = summarize(&errors).ok().map(|summary| summary.median);
            let here = |row: &&Row| row.dim == series.dim.get() && row.spacing == spacing;
            let failed: Vec<&str> = rows
                .iter()
                .filter(here)
                .filter(|row| row.covariance_error.is_none())
                .map(|row| row.status.as_str())
                .collect();
            let nodes = rows.iter().find(here).and_then(|row| row.active_nodes);
            table.push(vec![
                series.dim.to_string(),
                spacing.to_string(),
                optional_number(median),
                nodes.map_or(MISSING.to_owned(), |count| count.to_string()),
                if failed.is_empty() {
                    MISSING.to_owned()
                } else {
                    failed.join(", ")
                },
            ]);
        }
    }
    document.table(&["d", "h", "median error", "active nodes", "failed"], &table);

    let verdict = if all_kept { "pass" } else { "fail" };
    Ok(Report {
        document,
        summary: vec![
            ("study", "covariance-spacing".to_owned()),
            ("verdict", verdict.to_owned()),
        ],
    })
}

fn curve(rows: &[Row], series: &Series) -> Result<LineSeries, CommandError> {
    let mut line = LineSeries {
        label: format!("d = {}", series.dim),
        ..LineSeries::default()
    };
    let mut spacings = series.spacings.clone();
    spacings.sort_by(f64::total_cmp);
    for spacing in spacings {
        let errors = errors(rows, series, spacing);
        if !errors.is_empty() {
            let summary = summarize(&errors)?;
            line.x.push(spacing);
            line.y.push(summary.median);
            line.bars.push((summary.minimum, summary.maximum));
        }
    }
    Ok(line)
}
