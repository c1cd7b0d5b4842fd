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
    // No better than independent draws.
    let false_claims = rows.false_claims("energy_ratio", 1.0);
    page.list_of("Claims that are false", false_claims.iter());
    let page = rows.close(page).with("claimed", rows.count(Row::claims));
    Ok(page.with("false_claims", false_claims.len()))
}

/// A line per method, of the runs in one dimension.
fn table(study: &RandomTargets, rows: &Rows<'_>, page: &mut Page) {
    let labels = || MethodSpecification::labels(&study.methods);
    let lines = rows.lines("method", labels()).into_iter().map(|line| {
        let here = line.rows.clone();
        let is_other = |label: &&str| here.first().is_some_and(|row| row.text("method") != *label);
        let than = |other| (format!("better {other}"), better(&here, &rows.with("method", other)));
        line.with_all(labels().filter(is_other).map(than))
    });
    page.lines_over("methods", &[each("other", labels())], lines);
}

/// The share of the targets on which the ED² of `rows` is smaller; a run without particles is infinitely far.
fn better(rows: &Rows<'_>, others: &Rows<'_>) -> Option<String> {
    let contest = rows.against(others, ("energy_ratio", &["target_seed"]), 1.0);
    percent(contest.better, contest.pairs())
}

/// ED² of every method in order of size, one panel per dimension.
fn plot(study: &RandomTargets, rows: &Rows<'_>) -> MultiplesPlot {
    let panel = |here: &Rows<'_>| {
        let methods = MethodSpecification::labels(&study.methods);
        let all = study.target_seeds.count.get();
        let lines = here.orders("method", methods, "energy_ratio", Some(all));
        MultiplesPanel::new("", lines).with_level(1.0, "independent draws")
    };
    MultiplesPlot::logarithmic("share of the targets (%)", "ED^{2} relative to independent draws")
        .over_linear()
        .with_panels(rows.panels(("d = ", "dim"), study.dims.clone(), panel))
        .with_note("Every method's targets are in the order of its own ED²; runs without particles are left out.")
}
