//! The report of the study `paper`.

use super::answers::answers;
use super::body::is_rival;
use super::table::{Findings, RATIO, TIE, is_good, settings};
use super::{Paper, figure};
use crate::plots::dots;
use crate::study::prelude::*;

/// Tables and figures.
pub fn report(study: &Paper, rows: &Rows<'_>, directory: &StudyDirectory) -> Result<Page, CommandError> {
    let findings = Findings::new(study, rows)?;
    let mut page = directory.page(include_str!("report.md"), &[]);
    failures(&findings.bodies, &mut page);
    page.part("Ties and losses", &[("tie", &TIE)]);
    against_rivals(study, &findings, &mut page);
    answers(&findings, &mut page);
    page.heading("Figures");
    let (alpha, stiffness) = (findings.sweep("alpha"), findings.sweep("youngs-modulus"));
    let drawing = multiples(&figure::strength(&alpha, &stiffness));
    page.drawing("strength.svg", drawing);
    page.drawing("transient.svg", dots(&figure::transient(&findings.base)));
    let at_rest = findings.sweep("material-at-rest");
    if !at_rest.is_empty() {
        page.drawing("laws.svg", dots(&figure::materials(&at_rest)));
    }
    let drawing = multiples(&figure::cost(&findings.sweep("cost")));
    page.drawing("cost.svg", drawing);
    page.heading("Base and rivals");
    settings(&findings.base, &mut page);
    settings(&findings.rivals, &mut page);
    for (name, rows) in &findings.sweeps {
        if !["material", "schedule", "cost"].contains(name) {
            page.heading(&format!("Case `{name}`"));
            settings(rows, &mut page);
        }
    }
    let good = rows.count(|row| !is_rival(row) && is_good(row));
    let page = rows.tell([Status::Diverged], page.with("cases", rows.len()));
    Ok(page.with("as_good_as_independent", good))
}

/// Bodies by variant and algorithm.
fn by_method<'a>(bodies: &Rows<'a>) -> Vec<(String, &'static str, Rows<'a>)> {
    let mut all = Vec::new();
    for (variant, here) in bodies.by("variant") {
        for method in ["algorithm 1", "algorithm 2"] {
            all.push((variant.clone(), method, here.with("method", method)));
        }
    }
    all.retain(|(.., here)| !here.is_empty());
    all
}

/// How many runs diverge, why and when.
fn failures(bodies: &Rows<'_>, page: &mut Page) {
    let lines = by_method(bodies).into_iter().map(|(variant, method, here)| {
        let failed = here.having(|row| !row.finished());
        let mut steps: Vec<usize> = failed.iter().filter_map(|row| row.count("failed_step")).collect();
        steps.sort_unstable();
        let share = format!("{:.1}", 100.0 * failed.len() as f64 / here.len() as f64);
        let line = Line::from(failed).with("variant", variant).with("method", method);
        let line = line.with("runs", here.len()).with("share", share);
        line.with("median", steps.get(steps.len() / 2))
            .with("last", steps.last())
    });
    page.section("Failures", &[], lines);
}

/// The base beside its rivals, run by run.
fn against_rivals(study: &Paper, findings: &Findings<'_>, page: &mut Page) {
    let mut lines = Vec::new();
    for (variant, method, here) in by_method(&findings.base) {
        for rival in MethodSpecification::labels(&study.rivals) {
            let others = findings.rivals.with("method", rival);
            let contest = here.against(&others, (RATIO, &["target", "seed", "particles"]), TIE);
            if contest.pairs() > 0 {
                let line = Line::default().with("variant", variant.as_str()).with("method", method);
                let line = line.with("rival", rival).with("better", contest.better);
                let line = line.with("ties", contest.ties).with("worse", contest.worse);
                lines.push(line.with("neither", contest.neither));
            }
        }
    }
    page.lines("Ties and losses", lines);
}
