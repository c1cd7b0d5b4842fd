//! The report of the study `catalogue`.

use super::Catalogue;
use super::claims::{Claims, worst};
use super::figure::plot;
use super::requirement::Requirement;
use super::row::{ENERGY, Quantity, Row, SLICED};
use crate::CommandError;
use crate::options::TargetSpecification;
use crate::plots::dots;
use crate::statistics::summarize;
use crate::study::attempt::Status;
use crate::study::definition::Report;
use crate::study::directory::StudyDirectory;
use crate::study::document::{Document, MISSING, number, optional_number};
use crate::study::start_law::StartLaw;

/// Tables and figure.
pub fn report(study: &Catalogue, rows: &[Row], directory: &StudyDirectory) -> Result<Report, CommandError> {
    let mut document = Document::new("Defaults on every target");
    document.paragraph(format!(
        "M = {} particles, {} seeds, nothing set per target. ED² is the squared energy distance and SW₂ the sliced Wasserstein \
         distance over {} directions, both in coordinates in which the target has mean zero and unit covariance, exact or \
         against {} quasi-random points; relative to independent draws means ED² over its expectation E‖Y − Y'‖/M, and SW₂ \
         over the median of {} sets of M draws. Starts N(m, s²) are in target scales, the mean m in every coordinate.",
        study.particles,
        study.seeds.len(),
        study.directions,
        study.reference_points,
        study.draws,
    ));
    document.heading("Figure");
    let caption = "ED² relative to independent draws, by target and start, with the requirement.";
    document.figure(directory, "catalogue.svg", caption, dots(&plot(study, rows)?))?;

    let targets = study.all_targets()?;
    let judged = study.judged().map_or("", |method| method.label());
    let verdicts = verdicts(&targets, judged, rows)?;
    requirements(study, judged, &verdicts, &mut document);
    for start in &study.starts {
        document.heading(&format!("From N({}, {}²)", start.mean, start.standard_deviation));
        start_table(study, &targets, rows, *start, &mut document)?;
    }
    let claims = Claims::new(judged, rows);
    let labels: Vec<String> = targets.iter().map(TargetSpecification::label).collect();
    claims.write(&labels, &mut document);
    let missed: Vec<&Verdict<'_>> = verdicts.iter().filter(|verdict| !verdict.met()).collect();
    misses(&missed, &mut document);
    others(judged, rows, &mut document);

    let summary = vec![
        ("study", "catalogue".to_owned()),
        ("cases", rows.len().to_string()),
        ("judged", verdicts.len().to_string()),
        ("missed", missed.len().to_string()),
        ("claimed", claims.claimed().len().to_string()),
        ("false_claims", claims.false_claims().len().to_string()),
    ];
    Ok(Report { document, summary })
}

/// A run of the judged method beside what is asked of it.
struct Verdict<'a> {
    row: &'a Row,
    requirement: Requirement,
}

impl Verdict<'_> {
    fn met(&self) -> bool {
        ENERGY(self.row).is_some_and(|ratio| ratio <= self.requirement.bound())
    }
}

fn verdicts<'a>(
    targets: &[TargetSpecification],
    judged: &str,
    rows: &'a [Row],
) -> Result<Vec<Verdict<'a>>, CommandError> {
    let mut verdicts = Vec::new();
    for target in targets {
        let (label, requirement) = (target.label(), Requirement::of(target)?);
        let here = rows.iter().filter(|row| row.target == label && row.method == judged);
        verdicts.extend(here.map(|row| Verdict { row, requirement }));
    }
    Ok(verdicts)
}

/// The runs of a method on a target from a start; those without a start belong to every one.
pub fn runs<'a>(rows: &'a [Row], target: &str, method: &str, start: Option<StartLaw>) -> Vec<&'a Row> {
    rows.iter()
        .filter(|row| row.target == target && row.method == method)
        .filter(|row| row.start_mean.is_none() || is_from(row, start))
        .collect()
}

fn is_from(row: &Row, start: Option<StartLaw>) -> bool {
    let law = start.map(|law| (law.mean, law.standard_deviation));
    row.start_mean.zip(row.start_sd) == law
}

/// The median of a quantity over the runs that have it.
pub fn median(rows: &[&Row], quantity: Quantity) -> Option<f64> {
    let values: Vec<f64> = rows.iter().filter_map(|row| quantity(row)).collect();
    summarize(&values).ok().map(|summary| summary.median)
}

/// How many cases meet what is asked, by class and by start.
fn requirements(study: &Catalogue, judged: &str, verdicts: &[Verdict<'_>], document: &mut Document) {
    document.heading("Requirements");
    document.paragraph(format!(
        "What is asked of {judged}: ED² relative to independent draws at most the bound, in every case. A cell counts the cases \
         that meet it.",
    ));
    let mut header = vec!["targets".to_owned(), "bound".to_owned()];
    header.extend(
        study
            .starts
            .iter()
            .map(|start| format!("N({}, {}²)", start.mean, start.standard_deviation)),
    );
    header.extend(["all".to_owned(), "worst".to_owned(), "worst case".to_owned()]);
    let count = |here: &[&Verdict<'_>]| {
        let met = here.iter().filter(|verdict| verdict.met()).count();
        if here.is_empty() {
            MISSING.to_owned()
        } else {
            format!("{met}/{}", here.len())
        }
    };
    let mut table = Vec::new();
    for class in Requirement::ALL {
        let here: Vec<&Verdict<'_>> = verdicts.iter().filter(|verdict| verdict.requirement == class).collect();
        let mut line = vec![class.in_words().to_owned(), number(class.bound())];
        for start in &study.starts {
            let from = here
                .iter()
                .copied()
                .filter(|verdict| is_from(verdict.row, Some(*start)));
            line.push(count(&from.collect::<Vec<_>>()));
        }
        line.push(count(&here));
        let rows: Vec<&Row> = here.iter().map(|verdict| verdict.row).collect();
        let (value, case) = worst(&rows, ENERGY).map_or((MISSING.to_owned(), MISSING.to_owned()), |(value, case)| {
            (number(value), format!("`{case}`"))
        });
        line.extend([value, case]);
        table.push(line);
    }
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    document.table(&header, &table);
}

/// A line per target: both distances of every method, and the errors and costs of the judged one.
fn start_table(
    study: &Catalogue,
    targets: &[TargetSpecification],
    rows: &[Row],
    start: StartLaw,
    document: &mut Document,
) -> Result<(), CommandError> {
    let mut header = vec!["target".to_owned(), "bound".to_owned()];
    for method in &study.methods {
        header.push(format!("ED² {}", method.label()));
        header.push(format!("SW₂ {}", method.label()));
    }
    let details = [
        "finished",
        "mean (sd)",
        "sd (relative)",
        "mode mass",
        "residual",
        "evaluations",
        "time (s)",
    ];
    header.extend(details.map(str::to_owned));
    let mut table = Vec::new();
    for target in targets {
        let label = target.label();
        let mut line = vec![label.clone(), number(Requirement::of(target)?.bound())];
        for method in &study.methods {
            let here = runs(rows, &label, method.label(), Some(start));
            line.extend([ENERGY, SLICED].map(|quantity| optional_number(median(&here, quantity))));
        }
        let judged = study.judged().map_or("", |method| method.label());
        let here = runs(rows, &label, judged, Some(start));
        let finished = here.iter().filter(|row| row.status == Status::Finished).count();
        line.push(format!("{finished}/{}", here.len()));
        let quantities: [Quantity; 6] = [
            |row| row.mean_error,
            |row| row.deviation_error,
            |row| row.mass_error,
            |row| row.residual,
            Row::evaluations,
            |row| row.wall_seconds,
        ];
        line.extend(quantities.map(|quantity| optional_number(median(&here, quantity))));
        table.push(line);
    }
    document.paragraph("Medians over the seeds; ED² and SW₂ relative to independent draws.");
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    document.table(&header, &table);
    Ok(())
}

/// Names every case that misses its bound.
fn misses(missed: &[&Verdict<'_>], document: &mut Document) {
    document.heading("Cases that miss their bound");
    if missed.is_empty() {
        document.paragraph("None.");
        return;
    }
    let line = |verdict: &&Verdict<'_>| {
        let row = verdict.row;
        let found = match ENERGY(row) {
            Some(ratio) => format!(
                "ED² {} of independent draws, at most {}",
                number(ratio),
                verdict.requirement.bound()
            ),
            None => format!("{}: {}", row.status.as_str(), row.reason),
        };
        format!("- `{}`: {found}", row.case)
    };
    document.paragraph(missed.iter().map(line).collect::<Vec<_>>().join("\n"));
}

/// Names the runs of the other methods that gave nothing.
fn others(judged: &str, rows: &[Row], document: &mut Document) {
    let failed: Vec<String> = rows
        .iter()
        .filter(|row| row.status != Status::Finished && row.method != judged)
        .map(|row| format!("- `{}`: {}: {}", row.case, row.status.as_str(), row.reason))
        .collect();
    if !failed.is_empty() {
        document.heading("Runs of other methods that did not finish");
        document.paragraph(failed.join("\n"));
    }
}
