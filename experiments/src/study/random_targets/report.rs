//! The report of the study `random-targets`.

use super::figure::plot;
use super::{KnownFrame, RandomTargets};
use crate::options::Dimension;
use crate::plots::multiples;
use crate::plots::page::{Cell, Header, MISSING, Page, percent};
use crate::statistics::weighted_quantile;
use crate::study::definition::Report;
use crate::study::run_row::{ENERGY_RATIO, EVALUATIONS, Quantity, RunRow, SECONDS, report_of_runs};

/// Tables and figure.
pub fn report(study: &RandomTargets, rows: &[RunRow]) -> Report {
    let mut page = Page::new("Random targets");
    page.paragraph(format!(
        "M = {} particles on {} random targets per dimension, of seeds from {} on; the methods {}. ED² is the squared energy distance \
         from {} quasi-random draws, in standard deviations per axis, over its expectation E‖Y − Y'‖/M for M independent draws. \
         Evaluations are those of the score and of the log density at a point together. A claim is the outcome `converged`, and \
         false where ED² is above 1. `better than` counts the targets on which \
         ED² is smaller; equal ones count for neither.",
        study.particles,
        study.target_seeds.count,
        study.target_seeds.first,
        match study.frame {
            KnownFrame::Identity => "know nothing of place and scale (frame: identity)",
            KnownFrame::Own => "get the target's rough frame",
        },
        study.reference_points,
    ));
    page.heading("Figure");
    let caption = "ED² relative to independent draws, in order of size.";
    page.figure("random-targets.svg", caption, multiples(&plot(study, rows)));
    for &dim in &study.dims {
        page.heading(&format!("d = {dim}"));
        table(study, rows, dim, &mut page);
    }
    let false_claims = rows.iter().filter(|row| claims_falsely(row));
    let false_claims: Vec<String> = false_claims
        .map(|row| format!("- `{}`: ED² {}", row.case, ENERGY_RATIO(row).cell()))
        .collect();
    page.list("Claims that are false", &false_claims, None);
    report_of_runs(page, rows)
        .with("claimed", rows.iter().filter(|row| row.claims()).count())
        .with("false_claims", false_claims.len())
}

/// Whether log Z is within three of its standard errors; `None` where the method does not state it.
fn states_evidence(row: &RunRow) -> Option<bool> {
    Some(row.log_evidence_deviation?.abs() <= 3.0 * row.log_evidence_error?)
}

/// Whether a run claims to stand for the target and is no better than independent draws.
fn claims_falsely(row: &RunRow) -> bool {
    row.claims() && ENERGY_RATIO(row).is_none_or(|ratio| ratio > 1.0)
}

/// A line per method.
fn table(study: &RandomTargets, rows: &[RunRow], dim: Dimension, page: &mut Page) {
    let runs = |label: &str| -> Vec<&RunRow> {
        let here = |row: &&RunRow| row.dim == dim.get() && row.method == label;
        rows.iter().filter(here).collect()
    };
    let first = "method | finished | ED² median | 95 % | worst | evaluations | time (s) | error of log Z | within 3 s.e. | claims | false";
    let mut header = first.names();
    header.extend(
        study
            .methods
            .iter()
            .map(|method| format!("better than {}", method.label())),
    );
    let line = |label: &str| {
        let here = runs(label);
        let finished = here.iter().filter(|row| row.finished()).count();
        let stated: Vec<bool> = here.iter().filter_map(|row| states_evidence(row)).collect();
        let count = |property: fn(&RunRow) -> bool| here.iter().filter(|row| property(row)).count();
        let mut line = vec![label.to_owned(), format!("{finished}/{}", here.len())];
        line.extend([0.5, 0.95, 1.0].map(|level| quantile(&here, ENERGY_RATIO, level).cell()));
        let deviation = |row: &RunRow| row.log_evidence_deviation.map(f64::abs);
        let medians: [Quantity; 3] = [EVALUATIONS, SECONDS, deviation];
        line.extend(medians.map(|quantity| quantile(&here, quantity, 0.5).cell()));
        line.push(percent(stated.iter().filter(|within| **within).count(), stated.len()).cell());
        line.extend([count(RunRow::claims), count(claims_falsely)].map(|count| count.to_string()));
        line.extend(study.methods.iter().map(|other| match other.label() == label {
            true => MISSING.to_owned(),
            false => better(&here, &runs(other.label())),
        }));
        line
    };
    page.table(&header, study.methods.iter().map(|method| line(method.label())));
}

/// A quantile of a quantity over the runs that have it.
fn quantile(rows: &[&RunRow], quantity: Quantity, level: f64) -> Option<f64> {
    let values: Vec<f64> = rows.iter().filter_map(|row| quantity(row)).collect();
    weighted_quantile(&values, None, &[level]).ok()?.first().copied()
}

/// The share of the targets on which the ED² of `rows` is smaller; a run without particles is infinitely far.
fn better(rows: &[&RunRow], others: &[&RunRow]) -> String {
    let far = |row: &RunRow| ENERGY_RATIO(row).unwrap_or(f64::INFINITY);
    let pairs: Vec<(f64, f64)> = rows
        .iter()
        .filter_map(|row| {
            let other = others.iter().find(|other| other.target_seed == row.target_seed)?;
            Some((far(row), far(other)))
        })
        .collect();
    percent(pairs.iter().filter(|(own, other)| own < other).count(), pairs.len()).cell()
}
