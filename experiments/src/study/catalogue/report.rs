//! The report of the study `catalogue`.

use super::claims::Claims;
use super::figure::plot;
use super::requirement::Requirement;
use super::{Catalogue, from_start, is_from};
use crate::plots::dots;
use crate::study::prelude::*;
use crate::study::start_law::StartLaw;

/// Tables and figure.
pub fn report(study: &Catalogue, rows: &Rows<'_>, directory: &StudyDirectory) -> Result<Page, CommandError> {
    let mut page = directory.page(include_str!("report.md"), &[]);
    page.heading("Figure");
    page.drawing("catalogue.svg", dots(&plot(study, rows)?));

    let targets = study.all_targets()?;
    let judged = study.judged().map_or("", MethodSpecification::label);
    let claims = Claims::new(rows.with("method", judged));
    let asked = |target: &TargetSpecification| {
        let runs = claims.runs.with("target", target.label());
        Ok((Requirement::of(target)?, runs))
    };
    let asked: Vec<Asked<'_>> = targets.iter().map(asked).collect::<Result<_, CommandError>>()?;
    requirements(study, judged, &asked, &mut page);
    for start in &study.starts {
        page.heading(&format!("From {start}"));
        start_table(study, &targets, &from_start(rows, start), &mut page)?;
    }
    let labels: Vec<String> = targets.iter().map(TargetSpecification::label).collect();
    claims.write(&labels, &mut page);
    let misses: Vec<String> = asked.iter().flat_map(misses).collect();
    page.list("Cases that miss their bound", &misses, Some("None."));
    let others = rows.having(|row| row.text("method") != judged).failures();
    page.list("Runs of other methods that did not finish", &others, None);

    let runs = asked.iter().map(|(_, runs)| runs.len());
    Ok(page
        .with("cases", rows.len())
        .with("judged", runs.sum::<usize>())
        .with("missed", misses.len())
        .with("claimed", claims.claimed().len())
        .with("false_claims", claims.false_claims().len()))
}

/// What is asked on a target, and the runs of the judged method.
type Asked<'a> = (Requirement, Rows<'a>);

/// Whether a run keeps what is asked.
fn met(row: &Row, requirement: Requirement) -> bool {
    row.is_within("energy_ratio", requirement.bound)
}

/// What is missed, as items of a list.
fn misses((requirement, runs): &Asked<'_>) -> Vec<String> {
    let miss = |row: &Row| match row.number("energy_ratio") {
        Some(ratio) => format!(
            "- `{}`: ED² {} of independent draws, at most {}",
            row.case(),
            number(ratio),
            requirement.bound
        ),
        None => row.failure(),
    };
    runs.having(|row| !met(row, *requirement)).iter().map(miss).collect()
}

/// How many cases meet what is asked, by class and by start.
fn requirements(study: &Catalogue, judged: &str, asked: &[Asked<'_>], page: &mut Page) {
    page.heading("Requirements");
    page.paragraph(format!(
        "What is asked of {judged}: ED² relative to independent draws at most the bound, in every case. A cell counts the cases \
         that meet it.",
    ));
    let mut header = "targets | bound".names();
    header.extend(study.starts.iter().map(StartLaw::to_string));
    header.extend("all | worst | worst case".names());
    let line = |class: Requirement| {
        let of_class = asked.iter().filter(|(requirement, _)| *requirement == class);
        let here: Rows<'_> = of_class.flat_map(|(_, runs)| runs.iter()).collect();
        let count = |chosen: Rows<'_>| {
            let met = chosen.count(|row| met(row, class));
            (!chosen.is_empty()).then(|| format!("{met}/{}", chosen.len())).cell()
        };
        let from = |start: &StartLaw| here.having(|row| is_from(row, start));
        let mut cells = line(&[&class.class, &class.bound]);
        cells.extend(study.starts.iter().map(|start| count(from(start))));
        cells.push(count(here.clone()));
        cells.extend(here.cells("largest energy_ratio | worst energy_ratio"));
        cells
    };
    page.table(&header, Requirement::ALL.map(line));
}

/// A line per target: both distances of every method, and the errors and costs of the judged one.
fn start_table(
    study: &Catalogue,
    targets: &[TargetSpecification],
    rows: &Rows<'_>,
    page: &mut Page,
) -> Result<(), CommandError> {
    let mut header = "target | bound".names();
    for method in &study.methods {
        header.extend(["ED²", "SW₂"].map(|error| format!("{error} {}", method.label())));
    }
    header.extend("finished | mean (sd) | sd (relative) | mode mass | residual | evaluations | time (s)".names());
    let errors = "median mean_error | median deviation_error | median mass_error | median residual";
    let mut table = Vec::new();
    for target in targets {
        let here = rows.with("target", target.label());
        let of = |method: &MethodSpecification| here.with("method", method.label());
        let mut cells = line(&[&target.label(), &Requirement::of(target)?.bound]);
        for method in &study.methods {
            cells.extend(of(method).cells("median energy_ratio | median sliced_ratio"));
        }
        let judged = study.judged().map(of).unwrap_or_default();
        cells.push(judged.finished());
        cells.extend(judged.cells(errors));
        cells.extend(judged.cells("median evaluations | median wall_seconds"));
        table.push(cells);
    }
    page.paragraph("Medians over the seeds; ED² and SW₂ relative to independent draws.");
    page.table(&header, &table);
    Ok(())
}
