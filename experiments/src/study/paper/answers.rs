//! Answers to the paper's open questions, from the rows.

use super::table::{Findings, RATIO, TIE, groups, settings};
use crate::statistics::fit_power_law_of;
use crate::study::prelude::*;

/// All answers, in the order of the paper's claims.
pub fn answers(findings: &Findings<'_>, page: &mut Page) {
    when(findings, page);
    page.heading("Which law suits?");
    laws(&findings.sweep("material"), page);
    transient(&findings.bodies, page);
    page.heading("Does annealing help?");
    annealing(&findings.sweep("schedule"), page);
    page.heading("Do modes separate?");
    modes(&findings.base, &findings.rivals, page);
    cost(&findings.sweep("cost"), page);
}

/// The setting with the least median ED².
fn best<'a>(rows: &Rows<'a>) -> Option<(String, Rows<'a>)> {
    let ratio = |(_, rows): &(String, Rows<'_>)| rows.median_of_all(RATIO).unwrap_or(f64::INFINITY);
    groups(rows).into_iter().min_by(|a, b| ratio(a).total_cmp(&ratio(b)))
}

/// Per target: the base, the best of all settings, and the rivals.
fn when(findings: &Findings<'_>, page: &mut Page) {
    let (base, bodies) = (&findings.base, &findings.bodies);
    let variants = bodies.lines("variant", bodies.words("variant"));
    page.section("When does it work?", &[], variants);
    let all_groups = groups(base).into_iter().chain(groups(&findings.rivals));
    let all_groups: Vec<_> = all_groups.collect();
    let targets = base.words("target");
    let mut at_least_as_good = 0;
    let mut lines = Vec::new();
    for target in &targets {
        let medians = all_groups.iter().map(|(label, rows)| {
            let here = rows.with("target", target.as_str());
            (format!("median {label}"), here.cell("median of all final_ratio"))
        });
        let here = base.with("target", target.as_str());
        let size = here.first().and_then(|row| row.count("particles")).unwrap_or(0);
        let (label, best) = best(&bodies.with("target", target.as_str()).with("particles", size)).unzip();
        let best = best.unwrap_or_default();
        at_least_as_good += usize::from(best.median_of_all(RATIO).is_some_and(|ratio| ratio <= 1.0));
        let line = Line::from(here.with("particles", size))
            .with("target", target.as_str())
            .with_all(medians);
        let line = line.with("best", best.cell("median of all final_ratio"));
        lines.push(line.with("which", label));
    }
    let values: [(&str, &dyn Display); 2] = [("good", &at_least_as_good), ("all", &targets.len())];
    page.part("targets", &values);
    let labels = all_groups.iter().map(|(label, _)| label);
    let repeated = [each("variant", base.words("variant")), each("setting", labels)];
    page.lines_over("targets", &repeated, lines);
}

fn laws(rows: &Rows<'_>, page: &mut Page) {
    let Some((label, best)) = best(rows) else {
        page.paragraph("No run of the case `material`.");
        return;
    };
    let least = best.cell("median of all final_ratio");
    let least = format!("The least median over all targets is {least} times independent draws");
    page.paragraph(format!("{least}: {label}."));
    settings(rows, page);
}

fn transient(bodies: &Rows<'_>, page: &mut Page) {
    let lines = bodies.by("variant").into_iter().map(|(variant, here)| {
        let seen = here.having(|row| row.count("best_step").is_some());
        let early = seen.count(|row| row.count("best_step") < row.count("steps"));
        let never = seen.count(|row| row.number("start_ratio") <= row.number("best_ratio"));
        let line = Line::from(seen).with("variant", variant);
        line.with("early", early).with("never", never)
    });
    page.section("Transient or steady?", &[], lines);
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
        let alike = ["target", "seed", "method", "variant"];
        let contest = here.against(&constant, (RATIO, &alike), TIE);
        let [better, ties, worse, neither] = [contest.better, contest.ties, contest.worse, contest.neither];
        page.paragraph(format!(
            "- α {schedule}: better than the constant one in {better} runs, as good in {ties}, worse in {worse}; in {neither} both diverged."
        ));
    }
    settings(rows, page);
}

fn modes(base: &Rows<'_>, rivals: &Rows<'_>, page: &mut Page) {
    let all: Rows<'_> = base.iter().chain(rivals.iter()).collect();
    let targets = all.having(|row| row.number("final_mass").is_some()).words("target");
    let is_multimodal = |row: &Row| targets.iter().any(|target| target == row.text("target"));
    let (bodies, rivals) = (base.having(is_multimodal), rivals.having(is_multimodal));
    if bodies.is_empty() {
        page.paragraph("No run on a target with several modes reached its end.");
        return;
    }
    let all = groups(&bodies).into_iter().chain(groups(&rivals));
    let lines = all.map(|(label, here)| Line::from(here).with("setting", label));
    page.section("modes", &[], lines);
}

/// Powers of M, N and d in time and memory, beside the paper's.
fn cost(rows: &Rows<'_>, page: &mut Page) {
    let fit = |name: &str, column: &str| {
        let known = rows.having(|row| row.number("active_nodes").and(row.number(column)).is_some());
        let [particles, nodes, dims] = ["particles", "active_nodes", "dim"].map(|column| known.values(column));
        let law = fit_power_law_of(&[&particles, &nodes, &dims], &known.values(column)).ok();
        let exponent = |index: usize| law.as_ref().map(|law| exponent_text(law, index));
        let line = Line::default().with("quantity", name).with("M", exponent(0));
        let line = line.with("N", exponent(1)).with("d", exponent(2));
        line.with("quality", law.as_ref().map(|law| law.r_squared))
    };
    let paper = |name: &str, [particles, nodes, dims]: [&str; 3]| {
        let line = Line::default().with("quantity", name).with("M", particles);
        line.with("N", nodes).with("d", dims)
    };
    let lines = [
        fit("time per step", "seconds_per_step"),
        paper("paper: O(M N d²)", ["1", "1", "2"]),
        fit("memory", "storage_bytes"),
        paper("paper: O((N + M) d + M d²)", ["≤ 1", "≤ 1", "1 to 2"]),
    ];
    page.section("What does it cost?", &[], lines);
    settings(rows, page);
}
