//! The report of the study `evidence`.

use super::Evidence;
use crate::study::prelude::*;

/// Tables and figure.
pub fn report(study: &Evidence, rows: &Rows<'_>, directory: &StudyDirectory) -> Result<Page, CommandError> {
    let mut page = directory.page(include_str!("report.md"), &[]);
    let methods = || MethodSpecification::labels(&study.methods);
    page.section("All targets", &[], rows.lines("method", methods()));
    page.heading("Errors in standard errors");
    page.drawing("evidence.svg", multiples(&plot(study, rows)));
    for target in &study.targets {
        page.heading(&target.label());
        let here = rows.with("target", target.label());
        page.lines("All targets", here.lines("method", methods()));
    }
    let far = rows.having(|row| row.number("evidence_ratio").is_some_and(|ratio| ratio > 3.0));
    page.list_of("Errors beyond three standard errors", far.iter());
    Ok(rows.close(page).with("beyond_three_errors", far.len()))
}

/// Errors over standard errors in order of size, a panel per target and a line per method.
fn plot(study: &Evidence, rows: &Rows<'_>) -> MultiplesPlot {
    let panel = |here: &Rows<'_>| {
        let methods = MethodSpecification::labels(&study.methods);
        let lines = here.orders("method", methods, "evidence_ratio", None);
        MultiplesPanel::new("", lines).with_level(3.0, "three standard errors")
    };
    let targets = study.targets.iter().map(TargetSpecification::label);
    MultiplesPlot::logarithmic("share of the runs (%)", "error of log Z / its standard error")
        .over_linear()
        .with_panels(rows.panels(("", "target"), targets, panel))
}
