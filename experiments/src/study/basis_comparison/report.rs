//! The report of the study `basis-comparison`.

use super::choice::{Choice, runs};
use super::configuration::BasisComparison;
use crate::CommandError;
use crate::options::{Basis, Dimension};
use crate::plots::{AxisKind, LineSeries, MultiplesPanel, MultiplesPlot, ReferenceLevel, multiples};
use crate::statistics::summarize;
use crate::study::attempt::Status;
use crate::study::definition::Report;
use crate::study::directory::StudyDirectory;
use crate::study::document::{Document, MISSING, number, optional_number};
use crate::study::gaussian_runs::{ENERGY, NODES_PER_PARTICLE, Row, SECONDS, failures, median, values};

/// Tables and figure.
pub fn report(study: &BasisComparison, rows: &[Row], directory: &StudyDirectory) -> Result<Report, CommandError> {
    let mut document = Document::new("Bases at equal time");
    document.paragraph(format!(
        "Target N(0, I), M = {} particles, method `{}`, {} seeds; medians over the seeds. ED² is the squared energy distance, \
         exact in the expectation over the Gaussian. Spacings h, in standard deviations, are multiples of each basis's own \
         default; the best is the one with the lowest ED² at {} steps.",
        study.particles,
        study.method.label(),
        study.seeds.len(),
        study.step_counts().last().copied().unwrap_or(0),
    ));
    document.heading("Figure");
    let caption =
        "Squared energy distance ED² against wall time at each basis's best spacing, a point per number of steps.";
    document.figure(
        directory,
        "basis-comparison.svg",
        caption,
        multiples(&plot(study, rows)),
    )?;
    document.heading("At the best spacing");
    if let Some(first) = study.bases.first() {
        document.paragraph(format!(
            "ED² × 10³ and wall time per number of steps T; in the last column ED² × 10³ at the largest T of that basis that \
             takes no longer than the largest T of `{first}`. An asterisk marks a best spacing at the edge of the scan.",
        ));
    }
    for &dim in &study.dims {
        document.paragraph(format!("**d = {dim}**"));
        best_table(study, rows, dim, &mut document);
    }
    document.heading("Spacings");
    spacings(study, rows, &mut document);
    failures(rows, &mut document);

    let failed = rows.iter().filter(|row| row.status != Status::Finished).count();
    let summary = vec![
        ("study", "basis-comparison".to_owned()),
        ("cases", rows.len().to_string()),
        ("failed", failed.to_string()),
    ];
    Ok(Report { document, summary })
}

fn best_table(study: &BasisComparison, rows: &[Row], dim: Dimension, document: &mut Document) {
    let allowed = study
        .bases
        .first()
        .and_then(|&basis| Choice::of(study, rows, dim, basis)?.longest());
    let mut header = ["basis", "best h", "h / default"].map(str::to_owned).to_vec();
    for steps in study.step_counts() {
        header.extend([format!("ED², T = {steps}"), format!("time (s), T = {steps}")]);
    }
    let first = study.bases.first().map_or(String::new(), Basis::to_string);
    header.push(format!("ED² in the time of {first}"));
    let mut table = Vec::new();
    for &basis in &study.bases {
        let Some(choice) = Choice::of(study, rows, dim, basis) else {
            continue;
        };
        let edge = if choice.is_at_the_edge(study) { "*" } else { "" };
        let mut line = vec![
            basis.to_string(),
            optional_number(choice.spacing()),
            format!("{}{edge}", choice.factor),
        ];
        for steps in study.step_counts() {
            let here = runs(rows, dim, basis, choice.factor, steps);
            line.push(optional_number(median(&here, ENERGY).map(|energy| 1e3 * energy)));
            line.push(optional_number(median(&here, SECONDS)));
        }
        let equal = allowed.and_then(|seconds| choice.within(seconds));
        line.push(equal.map_or(MISSING.to_owned(), |(steps, energy)| {
            format!("{} (T = {steps})", number(1e3 * energy))
        }));
        table.push(line);
    }
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    document.table(&header, &table);
}

/// The errors of all spacings at the largest number of steps.
fn spacings(study: &BasisComparison, rows: &[Row], document: &mut Document) {
    let Some(&most) = study.step_counts().last() else {
        return;
    };
    document.paragraph(format!("All spacings at {most} steps."));
    let header = [
        "d",
        "basis",
        "h / default",
        "h",
        "ED² × 10³",
        "active nodes / M",
        "time (s)",
    ];
    let mut table = Vec::new();
    for &dim in &study.dims {
        for &basis in &study.bases {
            for &factor in &study.spacings {
                let here = runs(rows, dim, basis, factor, most);
                table.push(vec![
                    dim.to_string(),
                    basis.to_string(),
                    factor.to_string(),
                    optional_number(here.first().and_then(|row| row.requested_spacing)),
                    optional_number(median(&here, ENERGY).map(|energy| 1e3 * energy)),
                    optional_number(median(&here, NODES_PER_PARTICLE)),
                    optional_number(median(&here, SECONDS)),
                ]);
            }
        }
    }
    document.table(&header, &table);
}

/// One panel per dimension, one line per basis.
fn plot(study: &BasisComparison, rows: &[Row]) -> MultiplesPlot {
    let panel = |dim: Dimension| {
        let level = rows.iter().find(|row| row.dim == dim.get()).map(|row| row.energy_level);
        MultiplesPanel {
            title: format!("d = {dim}"),
            series: study
                .bases
                .iter()
                .filter_map(|&basis| curve(study, rows, dim, basis))
                .collect(),
            guides: Vec::new(),
            levels: level
                .map(|value| ReferenceLevel {
                    value,
                    label: "expected of i.i.d. draws".to_owned(),
                })
                .into_iter()
                .collect(),
        }
    };
    MultiplesPlot {
        title: String::new(),
        x_label: "wall time (s)".to_owned(),
        y_label: "ED² (standard deviations)".to_owned(),
        x_axis: AxisKind::Logarithmic,
        y_axis: AxisKind::Logarithmic,
        panels: study.dims.iter().map(|&dim| panel(dim)).collect(),
        notes: vec!["Medians over the seeds; bars from the smallest to the largest ED².".to_owned()],
    }
}

fn curve(study: &BasisComparison, rows: &[Row], dim: Dimension, basis: Basis) -> Option<LineSeries> {
    let choice = Choice::of(study, rows, dim, basis)?;
    let mut line = LineSeries {
        label: basis.to_string(),
        ..LineSeries::default()
    };
    for (_, runs) in &choice.by_steps {
        if let (Some(time), Ok(energy)) = (median(runs, SECONDS), summarize(&values(runs, ENERGY))) {
            line.x.push(time);
            line.y.push(energy.median);
            line.bars.push((energy.minimum, energy.maximum));
        }
    }
    Some(line)
}
