//! The report of the study `stability`.

use super::figure::{CELLS, plot};
use super::{Stability, diverged};
use crate::plots::heat_map;
use crate::study::prelude::*;

/// The most refusals of the calibrated sampler that the report names; results.csv has them all.
const MOST_NAMED: usize = 100;

/// Tables and figure.
pub fn report(_: &Stability, rows: &Rows<'_>, directory: &StudyDirectory) -> Result<Page, CommandError> {
    let mut page = directory.page(include_str!("report.md"), &[]);
    let told = |row: &Row| {
        let diverged = u64::from(diverged(row));
        row.clone().with("group", group(row)).with("diverged", diverged)
    };
    let rows: Vec<Row> = rows.iter().map(told).collect();
    let rows: &Rows<'_> = &rows.iter().collect();
    let (groups, here): (Vec<String>, Vec<Rows<'_>>) = rows.sorted("group").into_iter().unzip();
    page.section("Endings", &[], here);
    let reasons = rows.sorted("reason");
    match reasons.is_empty() {
        true => page.paragraph("No run ended with an error."),
        false => page.lines_over(
            "errors",
            &[each("group", &groups)],
            reasons.into_iter().map(|(_, here)| here),
        ),
    }
    page.heading("Where the paper's algorithms diverge");
    page.drawing("divergence.svg", heat_map(&plot(rows)));
    page.part("What decides", &[]);
    breakdowns(rows, &groups, &mut page);
    page.heading("Panics and numbers that are not finite");
    let faults = rows.having(|row| matches!(row.status(), Status::Panicked | Status::NotFinite));
    page.list_of("named", faults.iter().map(named));
    page.heading("Runs of mpm that diverged");
    let refused = rows.with("method", MethodName::Mpm.as_str()).having(diverged);
    if refused.len() > MOST_NAMED {
        page.part("most", &[("most", &MOST_NAMED), ("all", &refused.len())]);
    }
    page.list_of("named", refused.iter().take(MOST_NAMED).map(named));

    let page = rows.tell([Status::Finite, Status::Refused], page);
    Ok(rows.tell([Status::Panicked, Status::NotFinite], page))
}

/// The method, for the paper's algorithms with their guards.
fn group(row: &Row) -> String {
    match row.text("guards") {
        "" => row.text("method").to_owned(),
        guards => format!("{}, guards {guards}", row.text("method")),
    }
}

/// Shares of diverged runs, by one quantity at a time.
fn breakdowns(rows: &Rows<'_>, groups: &[String], page: &mut Page) {
    let mut shares = |quantity: &str, lines: Vec<Line<'_>>| {
        let repeated = [each("quantity", [quantity]), each("group", groups)];
        page.lines_over("shares", &repeated, lines);
    };
    for (name, range, column) in [
        ("frame / target's frame", [1e-3, 1e3], "scale"),
        ("time step / default", super::draw::TIME_STEPS, "time_step_factor"),
        ("spacing / default", super::draw::SPACINGS, "spacing_factor"),
        ("start sd", [0.1, 10.0], "start_sd"),
        ("M", [2.0, 2000.0], "particles"),
        ("friction, above 0", [0.01, 100.0], "friction"),
    ] {
        shares(name, rows.lines_in_cells(column, range, CELLS));
    }
    for (name, column) in [
        ("target", "target"),
        ("d", "dim"),
        ("basis", "basis"),
        ("score at", "score"),
        ("transfer", "transfer"),
        ("moment correction", "moment_correction"),
        ("elastic law", "material"),
    ] {
        let line = |(word, here)| Line::from(here).with("label", word);
        shares(name, rows.sorted(column).into_iter().map(line).collect());
    }
}

/// A case with what came of it.
fn named(row: &Row) -> Line<'_> {
    let what = match (row.status(), row.number("reach"), row.text("reason")) {
        (Status::Finite, Some(reach), _) => format!("escaped to {} target scales", number(reach)),
        (_, _, "") => row.text("message").to_owned(),
        (_, _, reason) => format!("{reason}: {}", row.text("message")),
    };
    Line::from(row).with("what", what)
}
