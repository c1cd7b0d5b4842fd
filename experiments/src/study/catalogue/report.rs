//! The report of the study `catalogue`.

use super::Catalogue;
use super::claims::{self, LARGEST_ERROR};
use super::figure::plot;
use super::requirement::Requirement;
use crate::plots::dots;
use crate::study::prelude::*;
use crate::study::start_law::StartLaw;

/// Tables and figure.
pub fn report(study: &Catalogue, rows: &Rows<'_>, directory: &StudyDirectory) -> Result<Page, CommandError> {
    let mut page = directory.page(include_str!("report.md"), &[]);
    page.heading("Figure");
    let targets = study.asked()?;
    page.drawing("catalogue.svg", dots(&plot(study, &targets, rows)));

    let judged = study.judged();
    let judged_runs = rows.with("method", judged);
    let of = |(target, asked): &(String, Requirement)| (*asked, judged_runs.with("target", target.as_str()));
    let asked: Vec<Asked<'_>> = targets.iter().map(of).collect();
    requirements(study, judged, &asked, &mut page);
    for start in &study.starts {
        page.heading(&format!("From {start}"));
        start_table(study, &targets, &start.runs(rows), &mut page);
    }
    let labels = targets.iter().map(|(target, _)| target.as_str());
    claims::write(&judged_runs, labels, &mut page);
    let misses: Vec<String> = asked.iter().flat_map(misses).collect();
    page.list("Cases that miss their bound", &misses, Some("None."));
    let others = rows.having(|row| row.text("method") != judged).failures();
    page.list("Runs of other methods that did not finish", &others, None);

    let runs = asked.iter().map(|(_, runs)| runs.len());
    let page = page.with("cases", rows.len()).with("judged", runs.sum::<usize>());
    let page = page.with("missed", misses.len());
    let page = page.with("claimed", judged_runs.count(Row::claims));
    Ok(page.with(
        "false_claims",
        judged_runs.false_claims("larger_error", LARGEST_ERROR).len(),
    ))
}

/// What is asked on a target, and the runs of the judged method.
type Asked<'a> = (Requirement, Rows<'a>);

/// Whether a run keeps what is asked.
fn met(row: &Row, requirement: Requirement) -> bool {
    row.is_within("energy_ratio", requirement.bound)
}

/// What is missed, as items of a list.
fn misses((requirement, runs): &Asked<'_>) -> Vec<String> {
    let miss = |row: &Row| match row.number("energy_ratio").map(number) {
        Some(ratio) => {
            let (case, bound) = (row.case(), requirement.bound);
            format!("- `{case}`: ED² {ratio} of independent draws, at most {bound}")
        }
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
        let from = |start: &StartLaw| (format!("from {start}"), count(here.having(|row| start.is_of(row))));
        let line = Line::from(here.clone()).with("class", class.class);
        let line = line.with("bound", class.bound).with("all", count(here.clone()));
        line.with_all(study.starts.iter().map(from))
    };
    let starts = [each("start", &study.starts)];
    page.lines_over("Requirements", &starts, Requirement::ALL.map(line));
}

/// A line per target: both distances of every method, and the errors and costs of the judged one.
fn start_table(study: &Catalogue, targets: &[(String, Requirement)], rows: &Rows<'_>, page: &mut Page) {
    let line = |(target, asked): &(String, Requirement)| {
        let here = Line::from(rows.with("target", target.as_str())).with("target", target);
        here.with("bound", asked.bound)
    };
    page.part("from a start", &[]);
    let methods = MethodSpecification::labels(&study.methods);
    let repeated = [each("method", methods), each("judged", [study.judged()])];
    page.lines_over("from a start", &repeated, targets.iter().map(line));
}
