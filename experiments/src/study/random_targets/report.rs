//! The report of the study `random-targets`.

use super::{KnownFrame, RandomTargets};
use crate::study::prelude::*;

/// Tables and figure.
pub fn report(study: &RandomTargets, rows: &Rows<'_>, directory: &StudyDirectory) -> Result<Page, CommandError> {
    let known = match study.frame {
        KnownFrame::Identity => "know nothing of place and scale (frame: identity)",
        KnownFrame::Own => "get the target's rough frame",
    };
    let mut page = directory.page(include_str!("report.md"), &[("known", &known)]);
    page.heading("Figure");
    page.drawing("random-targets.svg", multiples(&plot(study, rows)));
    for &dim in &study.dims {
        page.heading(&format!("d = {dim}"));
        table(study, &rows.with("dim", dim), &mut page);
    }
    let false_claim = |row: &Row| format!("- `{}`: ED² {}", row.case(), row.value("energy_ratio").cell());
    let false_claims: Vec<String> = rows.having(claims_falsely).iter().map(false_claim).collect();
    page.list("Claims that are false", &false_claims, None);
    Ok(rows
        .close(page)
        .with("claimed", rows.count(Row::claims))
        .with("false_claims", false_claims.len()))
}

/// Whether a run claims to stand for the target and is no better than independent draws.
fn claims_falsely(row: &Row) -> bool {
    row.claims() && !row.is_within("energy_ratio", 1.0)
}

/// A line per method, of the runs in one dimension.
fn table(study: &RandomTargets, rows: &Rows<'_>, page: &mut Page) {
    let first = "method | finished | ED² median | 95 % | worst | evaluations | time (s) | error of log Z | within 3 s.e. | claims | false";
    let labels = || study.methods.iter().map(MethodSpecification::label);
    let mut header = first.names();
    header.extend(labels().map(|label| format!("better than {label}")));
    let cells = |label: &str| {
        let here = rows.with("method", label);
        // log Z in its standard errors, where the method states both.
        let stated = here.having(|row| row.number("evidence_ratio").is_some());
        let within = percent(stated.count(|row| row.is_within("evidence_ratio", 3.0)), stated.len());
        let others = labels().map(|other| (other != label).then(|| better(&here, &rows.with("method", other))));
        let mut cells = line(&[&label, &here.finished()]);
        cells.extend(here.cells("quantile 0.5 energy_ratio | quantile 0.95 energy_ratio | quantile 1 energy_ratio"));
        cells.extend(
            here.cells("quantile 0.5 evaluations | quantile 0.5 wall_seconds | quantile 0.5 evidence_deviation"),
        );
        cells.extend(line(&[&within, &here.count(Row::claims), &here.count(claims_falsely)]));
        cells.extend(others.map(|other| other.cell()));
        cells
    };
    page.table(&header, labels().map(cells));
}

/// The share of the targets on which the ED² of `rows` is smaller; a run without particles is infinitely far.
fn better(rows: &Rows<'_>, others: &Rows<'_>) -> String {
    let far = |row: &Row| row.number("energy_ratio").unwrap_or(f64::INFINITY);
    let pair = |row: &Row| {
        let same = |other: &&Row| other.value("target_seed") == row.value("target_seed");
        Some((far(row), far(others.iter().find(same)?)))
    };
    let pairs: Vec<(f64, f64)> = rows.iter().filter_map(pair).collect();
    percent(pairs.iter().filter(|(own, other)| own < other).count(), pairs.len()).cell()
}

/// ED² of every method in order of size, one panel per dimension.
fn plot(study: &RandomTargets, rows: &Rows<'_>) -> MultiplesPlot {
    let panel = |dim: &Dimension| {
        let here = rows.with("dim", *dim);
        let line = |method: &MethodSpecification| {
            let ratios = here.with("method", method.label()).values("energy_ratio");
            LineSeries::in_order(method.label(), ratios, study.target_seeds.count.get())
        };
        let lines = study.methods.iter().map(line);
        MultiplesPanel::new(format!("d = {dim}"), lines).with_level(1.0, "independent draws")
    };
    MultiplesPlot::logarithmic("share of the targets (%)", "ED^{2} relative to independent draws")
        .over_linear()
        .with_panels(study.dims.iter().map(panel))
        .with_note("Every method's targets are in the order of its own ED²; runs without particles are left out.")
}
