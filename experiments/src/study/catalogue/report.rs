//! The report of the study `catalogue`.

use super::figure::plot;
use super::requirement::Requirement;
use super::{Catalogue, claims};
use crate::plots::dots;
use crate::study::prelude::*;
use crate::study::start_law::StartLaw;

/// Tables and figure.
pub fn report(study: &Catalogue, rows: &Rows<'_>, directory: &StudyDirectory) -> Result<Page, CommandError> {
    let mut page = directory.page(include_str!("report.md"), &[]);
    page.heading("Figure");
    let targets = study.asked()?;
    page.drawing("catalogue.svg", dots(&plot(study, &targets, rows)));

    let told: Vec<Row> = rows.iter().map(|row| told(study, &targets, row)).collect();
    let rows: &Rows<'_> = &told.iter().collect();
    let judged = rows.held().with("method", study.judged());
    page.part("Requirements", &[("judged", &study.judged())]);
    let line = |Requirement { class, bound }: Requirement| {
        let here = Line::from(judged.with("class", class)).with("class", class);
        here.with("bound", bound)
    };
    let starts = [each("start", &study.starts)];
    page.lines_over("Requirements", &starts, Requirement::ALL.map(line));
    rows.references(&mut page);
    let rows: &Rows<'_> = &rows.held();
    for start in &study.starts {
        page.heading(&format!("From {start}"));
        start_table(study, &targets, &start.runs(rows), &mut page);
    }
    claims::write(&judged, targets.iter().map(|(target, _)| target.as_str()), &mut page);
    let misses = judged.with("met", "no");
    page.list_of("Cases that miss their bound", misses.iter());
    let others = rows.having(|row| row.text("method") != study.judged()).failures();
    page.list("Runs of other methods that did not finish", &others, None);

    let page = page.with("cases", rows.len()).with("judged", judged.len());
    let page = page.with("missed", misses.len());
    let page = page.with("claimed", judged.count(Row::claims));
    Ok(page.with("false_claims", claims::false_claims(&judged).len()))
}

/// A row with what is asked of it, whether it keeps that, and its start.
fn told(study: &Catalogue, targets: &[(String, Requirement)], row: &Row) -> Row {
    let asked = targets.iter().find(|(target, _)| target == row.text("target"));
    let asked = asked.map(|(_, asked)| *asked);
    let is_met = asked.is_some_and(|asked| row.is_within("certain_ratio", asked.bound));
    let start = study.starts.iter().find(|start| start.is_of(row));
    row.clone()
        .with("class", asked.map(|asked| asked.class))
        .with("bound", asked.map(|asked| asked.bound))
        .with("met", if is_met { "yes" } else { "no" })
        .with("start", start.map(StartLaw::to_string))
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
