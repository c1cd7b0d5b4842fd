//! Answers to the paper's open questions, from the rows.

use super::configuration::{BASE, RIVALS};
use super::table::{Findings, RATIO, TIE, groups, settings};
use crate::statistics::fit_power_law_of;
use crate::study::prelude::*;

/// All answers, in the order of the paper's claims.
pub fn answers(findings: &Findings<'_>, page: &mut Page) {
    let bodies = &findings.bodies;
    page.section("When does it work?", &[], bodies.lines_of(["variant"]));
    targets(findings, page);
    page.heading("Which law suits?");
    laws(&findings.of("material"), page);
    page.section("Transient or steady?", &[], bodies.lines_of(["variant"]));
    page.heading("Does annealing help?");
    annealing(&findings.of("schedule"), page);
    page.heading("Do modes separate?");
    modes(&findings.of(BASE), &findings.of(RIVALS), page);
    cost(&findings.of("cost"), page);
}

/// The setting with the least median ED².
fn best<'a>(rows: &Rows<'a>) -> Option<(String, Rows<'a>)> {
    let ratio = |(_, rows): &(String, Rows<'_>)| rows.median_of_all(RATIO).unwrap_or(f64::INFINITY);
    groups(rows).into_iter().min_by(|a, b| ratio(a).total_cmp(&ratio(b)))
}

/// Per target: the base, the best of all settings, and the rivals.
fn targets<'a>(findings: &Findings<'a>, page: &mut Page) {
    let (base, rivals) = (findings.of(BASE), findings.of(RIVALS));
    let known: Vec<_> = groups(&base).into_iter().chain(groups(&rivals)).collect();
    let median = "median of all final_ratio";
    let mut good = 0;
    let line = |(target, here): (String, Rows<'a>)| {
        let medians = known.iter().map(|(label, rows)| {
            let here = rows.with("target", target.as_str());
            (format!("median {label}"), here.cell(median))
        });
        let size = here.first().and_then(|row| row.count("particles"));
        let all = findings.bodies.with("target", target.as_str()).with("particles", size);
        let (which, best) = best(&all).unzip();
        let best = best.unwrap_or_default();
        good += usize::from(best.median_of_all(RATIO).is_some_and(|ratio| ratio <= 1.0));
        let line = Line::from(here.with("particles", size)).with_all(medians);
        line.with("target", target)
            .with("best", best.cell(median))
            .with("which", which)
    };
    let lines: Vec<Line<'_>> = base.by("target").into_iter().map(line).collect();
    page.part("targets", &[("good", &good), ("all", &lines.len())]);
    let labels = known.iter().map(|(label, _)| label);
    let repeated = [each("variant", base.words("variant")), each("setting", labels)];
    page.lines_over("targets", &repeated, lines);
}

fn laws(rows: &Rows<'_>, page: &mut Page) {
    let Some((label, best)) = best(rows) else {
        page.paragraph("No run of the case `material`.");
        return;
    };
    page.part_of("least", Line::from(best).with("setting", label));
    page.lines("settings", settings(rows));
}

fn annealing(rows: &Rows<'_>, page: &mut Page) {
    let mut schedules = rows.by("schedule");
    let constant = |(_, here): &(String, Rows<'_>)| here.iter().all(|row| row.number("alpha").is_some());
    let Some(place) = schedules.iter().position(constant) else {
        page.paragraph("No run of the case `schedule` with a constant α.");
        return;
    };
    let (_, constant) = schedules.remove(place);
    for (schedule, here) in schedules {
        let contest = here.against(&constant, (RATIO, &["target", "seed", "method", "variant"]), TIE);
        page.part_of(
            "annealed",
            Line::default().with_contest(contest).with("schedule", schedule),
        );
    }
    page.lines("settings", settings(rows));
}

fn modes(base: &Rows<'_>, rivals: &Rows<'_>, page: &mut Page) {
    let all: Rows<'_> = base.iter().chain(rivals.iter()).collect();
    let targets = all.having(|row| row.number("final_mass").is_some()).words("target");
    let is_multimodal = |row: &Row| targets.iter().any(|target| target == row.text("target"));
    let (bodies, rivals) = (base.having(is_multimodal), rivals.having(is_multimodal));
    match bodies.is_empty() {
        true => page.paragraph("No run on a target with several modes reached its end."),
        false => page.section("modes", &[], [settings(&bodies), settings(&rivals)].concat()),
    }
}

/// Powers of M, N and d in time and memory, beside the paper's.
fn cost(rows: &Rows<'_>, page: &mut Page) {
    let fit = |line: Line<'static>, (name, column): (&str, &str)| {
        let known = rows.having(|row| row.number("active_nodes").and(row.number(column)).is_some());
        let sizes = ["particles", "active_nodes", "dim"].map(|size| known.values(size));
        let law = fit_power_law_of(&sizes.each_ref().map(Vec::as_slice), &known.values(column)).ok();
        let power = |(index, size)| {
            (
                format!("{name} {size}"),
                law.as_ref().map(|law| exponent_text(law, index)),
            )
        };
        let line = line.with_all(["M", "N", "d"].into_iter().enumerate().map(power));
        line.with(format!("{name} R²"), law.as_ref().map(|law| law.r_squared))
    };
    let quantities = [("time", "seconds_per_step"), ("memory", "storage_bytes")];
    let line = quantities.into_iter().fold(Line::default(), fit);
    page.section("What does it cost?", &[], [line]);
    page.lines("settings", settings(rows));
}
