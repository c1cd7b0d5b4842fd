//! The report of the study `paper`.

use super::answers::answers;
use super::body::is_rival;
use super::configuration::{BASE, RIVALS};
use super::table::{Findings, RATIO, TIE, is_good, settings};
use super::{Paper, figure};
use crate::plots::dots;
use crate::study::prelude::*;

/// Tables and figures.
pub fn report(study: &Paper, rows: &Rows<'_>, directory: &StudyDirectory) -> Result<Page, CommandError> {
    let held = rows.held();
    let findings = Findings::new(study, &held)?;
    let mut page = directory.page(include_str!("report.md"), &[]);
    page.section("Failures", &[], findings.bodies.lines_of(["variant", "method"]));
    page.part("Ties and losses", &[("tie", &TIE)]);
    against_rivals(study, &findings, &mut page);
    answers(&findings, &mut page);
    page.heading("Figures");
    let (alpha, stiffness) = (findings.of("alpha"), findings.of("youngs-modulus"));
    let drawing = multiples(&figure::strength(&alpha, &stiffness));
    page.drawing("strength.svg", drawing);
    page.drawing("transient.svg", dots(&figure::transient(&findings.of(BASE))));
    let at_rest = findings.of("material-at-rest");
    if !at_rest.is_empty() {
        page.drawing("laws.svg", dots(&figure::materials(&at_rest)));
    }
    let drawing = multiples(&figure::cost(&findings.of("cost")));
    page.drawing("cost.svg", drawing);
    page.heading("Base and rivals");
    page.lines("settings", settings(&findings.of(BASE)));
    page.lines("settings", settings(&findings.of(RIVALS)));
    for (name, rows) in findings.tables.iter().skip(2) {
        if !["material", "schedule", "cost"].contains(name) {
            page.heading(&format!("Case `{name}`"));
            page.lines("settings", settings(rows));
        }
    }
    rows.references(&mut page);
    let good = held.count(|row| !is_rival(row) && is_good(row));
    let page = rows.tell([Status::Diverged, Status::NoReference], page.with("cases", rows.len()));
    Ok(page.with("as_good_as_independent", good))
}

/// The base beside its rivals, run by run.
fn against_rivals(study: &Paper, findings: &Findings<'_>, page: &mut Page) {
    let (base, rivals) = (findings.of(BASE), findings.of(RIVALS));
    let mut lines = Vec::new();
    for line in base.lines_of(["variant", "method"]) {
        for rival in MethodSpecification::labels(&study.rivals) {
            let others = rivals.with("method", rival);
            let alike = ["target", "seed", "particles"];
            let contest = line.rows.against(&others, (RATIO, &alike), TIE);
            if contest.pairs() > 0 {
                lines.push(line.clone().with_contest(contest).with("rival", rival));
            }
        }
    }
    page.lines("Ties and losses", lines);
}
