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
    page.part("Requirements", &[("judged", &judged)]);
    let line = |class: Requirement| {
        let of_class = asked.iter().filter(|(requirement, _)| *requirement == class);
        let here: Rows<'_> = of_class.flat_map(|(_, runs)| runs.iter()).collect();
        let count = |chosen: Rows<'_>| {
            let met = chosen.count(|row| met(row, class));
            (!chosen.is_empty()).then(|| format!("{met}/{}", chosen.len()))
        };
        let from = |start: &StartLaw| (format!("from {start}"), count(here.having(|row| is_from(row, start))));
        let line = Line::from(here.clone())
            .with("class", class.class)
            .with("bound", class.bound);
        line.with("all", count(here.clone()))
            .with_all(study.starts.iter().map(from))
    };
    page.lines_over(
        "Requirements",
        &[each("start", &study.starts)],
        Requirement::ALL.map(line),
    );
}

/// A line per target: both distances of every method, and the errors and costs of the judged one.
fn start_table(
    study: &Catalogue,
    targets: &[TargetSpecification],
    rows: &Rows<'_>,
    page: &mut Page,
) -> Result<(), CommandError> {
    let mut lines = Vec::new();
    for target in targets {
        let here = Line::from(rows.with("target", target.label())).with("target", target.label());
        lines.push(here.with("bound", Requirement::of(target)?.bound));
    }
    page.part("from a start", &[]);
    let methods = study.methods.iter().map(MethodSpecification::label);
    let judged = study.judged().map(MethodSpecification::label);
    page.lines_over(
        "from a start",
        &[each("method", methods), each("judged", judged)],
        lines,
    );
    Ok(())
}
