//! The report of the study `random-targets`.

use super::RandomTargets;
use super::configuration::KnownFrame;
use super::figure::plot;
use super::row::Row;
use crate::CommandError;
use crate::options::Dimension;
use crate::plots::multiples;
use crate::statistics::weighted_quantile;
use crate::study::attempt::Status;
use crate::study::definition::Report;
use crate::study::directory::StudyDirectory;
use crate::study::document::{Document, MISSING, optional_number};

/// Tables and figure.
pub fn report(study: &RandomTargets, rows: &[Row], directory: &StudyDirectory) -> Result<Report, CommandError> {
    let mut document = Document::new("Random targets");
    document.paragraph(format!(
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
    document.heading("Figure");
    let caption = "ED² relative to independent draws, in order of size.";
    document.figure(directory, "random-targets.svg", caption, multiples(&plot(study, rows)))?;
    for &dim in &study.dims {
        document.heading(&format!("d = {dim}"));
        table(study, rows, dim, &mut document);
    }
    lists(rows, &mut document);
    let count = |property: fn(&Row) -> bool| rows.iter().filter(|row| property(row)).count().to_string();
    let summary = vec![
        ("study", "random-targets".to_owned()),
        ("cases", rows.len().to_string()),
        ("failed", count(|row| row.status != Status::Finished)),
        ("claimed", count(Row::claims)),
        ("false_claims", count(Row::claims_falsely)),
    ];
    Ok(Report { document, summary })
}

/// A line per method.
fn table(study: &RandomTargets, rows: &[Row], dim: Dimension, document: &mut Document) {
    let runs = |label: &str| -> Vec<&Row> {
        let here = |row: &&Row| row.dim == dim.get() && row.method == label;
        rows.iter().filter(here).collect()
    };
    let first = [
        "method",
        "finished",
        "ED² median",
        "95 %",
        "worst",
        "evaluations",
        "time (s)",
        "error of log Z",
        "within 3 s.e.",
        "claims",
        "false",
    ];
    let mut header: Vec<String> = first.map(str::to_owned).to_vec();
    header.extend(
        study
            .methods
            .iter()
            .map(|method| format!("better than {}", method.label())),
    );
    let line = |label: &str| {
        let here = runs(label);
        let finished = here.iter().filter(|row| row.status == Status::Finished).count();
        let stated: Vec<bool> = here.iter().filter_map(|row| row.states_evidence()).collect();
        let count = |property: fn(&Row) -> bool| here.iter().filter(|row| property(row)).count();
        let mut line = vec![label.to_owned(), format!("{finished}/{}", here.len())];
        line.extend([0.5, 0.95, 1.0].map(|level| optional_number(quantile(&here, Row::ratio, level))));
        let deviation = |row: &Row| row.log_evidence_deviation.map(f64::abs);
        let medians: [fn(&Row) -> Option<f64>; 3] = [Row::evaluations, |row| row.wall_seconds, deviation];
        line.extend(medians.map(|quantity| optional_number(quantile(&here, quantity, 0.5))));
        line.push(share(stated.iter().filter(|within| **within).count(), stated.len()));
        line.extend([count(Row::claims), count(Row::claims_falsely)].map(|count| count.to_string()));
        line.extend(study.methods.iter().map(|other| match other.label() == label {
            true => MISSING.to_owned(),
            false => better(&here, &runs(other.label())),
        }));
        line
    };
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    let lines: Vec<Vec<String>> = study.methods.iter().map(|method| line(method.label())).collect();
    document.table(&header, &lines);
}

/// A quantile of a quantity over the runs that have it.
fn quantile(rows: &[&Row], quantity: fn(&Row) -> Option<f64>, level: f64) -> Option<f64> {
    let values: Vec<f64> = rows.iter().filter_map(|row| quantity(row)).collect();
    weighted_quantile(&values, None, &[level]).ok()?.first().copied()
}

/// The share of the targets on which the ED² of `rows` is smaller; a run without particles is infinitely far.
fn better(rows: &[&Row], others: &[&Row]) -> String {
    let far = |row: &Row| row.ratio().unwrap_or(f64::INFINITY);
    let pairs: Vec<(f64, f64)> = rows
        .iter()
        .filter_map(|row| {
            let other = others.iter().find(|other| other.target_seed == row.target_seed)?;
            Some((far(row), far(other)))
        })
        .collect();
    share(pairs.iter().filter(|(own, other)| own < other).count(), pairs.len())
}

fn share(count: usize, all: usize) -> String {
    match all {
        0 => MISSING.to_owned(),
        _ => format!("{:.0} %", 100.0 * count as f64 / all as f64),
    }
}

/// Names the false claims and the runs that gave nothing.
fn lists(rows: &[Row], document: &mut Document) {
    let false_claims: Vec<String> = rows
        .iter()
        .filter(|row| row.claims_falsely())
        .map(|row| format!("- `{}`: ED² {}", row.case, optional_number(row.ratio())))
        .collect();
    let failed: Vec<String> = rows
        .iter()
        .filter(|row| row.status != Status::Finished)
        .map(|row| format!("- `{}`: {}: {}", row.case, row.status.as_str(), row.reason))
        .collect();
    for (heading, lines) in [
        ("Claims that are false", false_claims),
        ("Runs that did not finish", failed),
    ] {
        if !lines.is_empty() {
            document.heading(heading);
            document.paragraph(lines.join("\n"));
        }
    }
}
