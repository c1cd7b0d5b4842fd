//! The report of the study `evidence`.

use super::Evidence;
use crate::options::TargetSpecification;
use crate::plots::page::{Cell, Page, line, percent};
use crate::plots::{AxisKind, LineSeries, MultiplesPanel, MultiplesPlot, ReferenceLevel, multiples};
use crate::study::definition::Report;
use crate::study::run_row::{EVALUATIONS, Quantity, RunRow, SECONDS, median, report_of_runs, values};

/// |log Z − exact|.
const ERROR: Quantity = |row| row.log_evidence_deviation.map(f64::abs);
/// The same in standard errors of the method's own.
const RATIO: Quantity = |row| Some(ERROR(row)? / row.log_evidence_error?);

/// Tables and figure.
pub fn report(study: &Evidence, rows: &[RunRow]) -> Report {
    let mut page = Page::new("Evidence");
    page.paragraph(format!(
        "log Z = log ∫ p with M = {} particles, {} seeds from {} on, beside its known value; s.e. is the standard error that the method states. \
         An error that is normal and known exactly is within one, two, three of it in 68, 95, 99.7 % of the runs; one that rests on eight \
         populations in 65, 91, 98 %. Runs that state nothing are in no column but the first.",
        study.particles, study.run_seeds.count, study.run_seeds.first,
    ));
    page.heading("All targets");
    let all = |label: &str| rows.iter().filter(|row| row.method == label).collect::<Vec<_>>();
    let table = study
        .methods
        .iter()
        .map(|method| cells(method.label(), &all(method.label())));
    page.table(HEADER, table);
    page.heading("Errors in standard errors");
    let caption = "Errors of log Z in standard errors that the method states, in order of size.";
    page.figure("evidence.svg", caption, multiples(&plot(study, rows)));
    for target in &study.targets {
        page.heading(&target.label());
        let here = |label: &str| runs(rows, target, label);
        let table = study
            .methods
            .iter()
            .map(|method| cells(method.label(), &here(method.label())));
        page.table(HEADER, table);
    }
    let far = rows.iter().filter(|row| RATIO(row).is_some_and(|ratio| ratio > 3.0));
    let far: Vec<String> = far
        .map(|row| {
            format!(
                "- `{}`: {} of {}",
                row.case,
                ERROR(row).cell(),
                row.log_evidence_error.cell()
            )
        })
        .collect();
    page.list("Errors beyond three standard errors", &far, Some("None."));
    report_of_runs(page, rows).with("beyond_three_errors", far.len())
}

const HEADER: &str =
    "method | stated | median error | largest | median s.e. | within 1 | within 2 | within 3 | evaluations | time (s)";

/// A line of a table.
fn cells(label: &str, rows: &[&RunRow]) -> Vec<String> {
    let ratios = values(rows, RATIO);
    let within = |most: f64| percent(ratios.iter().filter(|ratio| **ratio <= most).count(), ratios.len());
    line(&[
        &label,
        &format!("{}/{}", ratios.len(), rows.len()),
        &median(rows, ERROR),
        &values(rows, ERROR).into_iter().reduce(f64::max),
        &median(rows, |row| row.log_evidence_error),
        &within(1.0),
        &within(2.0),
        &within(3.0),
        &median(rows, EVALUATIONS),
        &median(rows, SECONDS),
    ])
}

fn runs<'a>(rows: &'a [RunRow], target: &TargetSpecification, label: &str) -> Vec<&'a RunRow> {
    let here = |row: &&RunRow| row.target == target.label() && row.method == label;
    rows.iter().filter(here).collect()
}

/// Errors over standard errors in order of size, a panel per target and a line per method.
fn plot(study: &Evidence, rows: &[RunRow]) -> MultiplesPlot {
    let curve = |target: &TargetSpecification, label: &str| {
        let ratios = values(&runs(rows, target, label), RATIO);
        let count = ratios.len();
        LineSeries::in_order(label, ratios, count)
    };
    let panel = |target: &TargetSpecification| MultiplesPanel {
        title: target.label(),
        series: study
            .methods
            .iter()
            .map(|method| curve(target, method.label()))
            .collect(),
        levels: vec![ReferenceLevel::new(3.0, "three standard errors")],
        ..MultiplesPanel::default()
    };
    MultiplesPlot {
        x_axis: AxisKind::Linear,
        panels: study.targets.iter().map(panel).collect(),
        ..MultiplesPlot::logarithmic("share of the runs (%)", "error of log Z / its standard error")
    }
}
