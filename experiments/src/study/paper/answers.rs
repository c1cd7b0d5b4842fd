//! Answers to the paper's open questions, from the rows.

use super::table::{Findings, RATIO, against, groups, is_good, settings};
use crate::statistics::fit_power_law_of;
use crate::study::prelude::*;

/// All answers, in the order of the paper's claims.
pub fn answers(findings: &Findings, bodies: &Rows<'_>, page: &mut Page) -> Result<(), CommandError> {
    page.heading("When does it work?");
    when(findings, bodies, page)?;
    page.heading("Which law suits?");
    laws(&findings.sweep("material")?, page);
    page.heading("Transient or steady?");
    transient(bodies, page);
    page.heading("Does annealing help?");
    annealing(&findings.sweep("schedule")?, page);
    page.heading("Do modes separate?");
    modes(&findings.base()?, &findings.rivals()?, page);
    page.heading("What does it cost?");
    cost(&findings.sweep("cost")?, page);
    Ok(())
}

/// The setting with the least median ED².
fn best<'a>(rows: &Rows<'a>) -> Option<(String, Rows<'a>)> {
    let ratio = |(_, rows): &(String, Rows<'_>)| rows.median_of_all(RATIO).unwrap_or(f64::INFINITY);
    groups(rows).into_iter().min_by(|a, b| ratio(a).total_cmp(&ratio(b)))
}

/// Per target: the base, the best of all settings, and the rivals.
fn when(findings: &Findings, bodies: &Rows<'_>, page: &mut Page) -> Result<(), CommandError> {
    let counts = |(variant, here): (String, Rows<'_>)| {
        let near = here.count(|row| row.is_within(RATIO, 10.0));
        line(&[
            &variant,
            &here.len(),
            &here.count(Row::finished),
            &near,
            &here.count(is_good),
        ])
    };
    page.paragraph("All runs: how many reach the end, and how many there have an ED² of at most 10 times, and at most once, that of independent draws.");
    let lines = bodies.by("variant").into_iter().map(counts);
    page.table("variant | runs | ended | ED² ≤ 10 | ED² ≤ 1", lines);
    let base = findings.base()?;
    let all_groups: Vec<_> = groups(&base).into_iter().chain(groups(&findings.rivals()?)).collect();
    let mut header = vec!["target", "start"];
    header.extend(all_groups.iter().map(|(label, _)| label.as_str()));
    header.extend(["best setting", "which"]);
    let targets = base.words("target");
    let mut at_least_as_good = 0;
    let mut lines = Vec::new();
    for target in &targets {
        let on = |rows: &Rows<'_>| rows.with("target", target.as_str()).cells("median of all final_ratio");
        let first = all_groups.first().map(|(_, rows)| rows.with("target", target.as_str()));
        let first = first.unwrap_or_default();
        let mut cells = vec![target.clone()];
        cells.extend(first.cells("median of all start_ratio"));
        cells.extend(all_groups.iter().flat_map(|(_, rows)| on(rows)));
        let size = first.first().and_then(|row| row.count("particles")).unwrap_or(0);
        let here = bodies.with("target", target.as_str()).with("particles", size);
        let (label, best) = best(&here).unzip();
        let best = best.unwrap_or_default();
        let is_as_good = best.median_of_all(RATIO).is_some_and(|ratio| ratio <= 1.0);
        at_least_as_good += usize::from(is_as_good);
        cells.extend(best.cells("median of all final_ratio"));
        cells.push(label.cell());
        lines.push(cells);
    }
    page.paragraph(format!(
        "Medians of ED² over the seeds, relative to independent draws: the base, the rivals, and the best setting of all, chosen in hindsight. That one is at least as good as \
         independent draws on {at_least_as_good} of {} targets.",
        targets.len(),
    ));
    page.table(&header, &lines);
    Ok(())
}

fn laws(rows: &Rows<'_>, page: &mut Page) {
    let Some((label, best)) = best(rows) else {
        page.paragraph("No run of the case `material`.");
        return;
    };
    page.paragraph(format!(
        "The least median over all targets is {} times independent draws: {label}.",
        best.cells("median of all final_ratio").concat()
    ));
    settings(rows, page);
}

fn transient(bodies: &Rows<'_>, page: &mut Page) {
    let cells = |(variant, here): (String, Rows<'_>)| {
        let seen = here.having(|row| row.count("best_step").is_some());
        let ended = seen.having(|row| row.number(RATIO).is_some());
        let counts = line(&[
            &variant,
            &seen.len(),
            &seen.count(|row| row.count("best_step") < row.count("steps")),
            &seen.count(|row| row.number("start_ratio") <= row.number("best_ratio")),
            &seen.count(|row| row.is_within("best_ratio", 1.0)),
        ]);
        [counts, ended.cells("median of all end_over_best")].concat()
    };
    page.paragraph(
        "Of the runs that were seen after their start: those that are best before their last step, those that are never better than their start, and those that have an ED² of at most 1 on the way; \
         and the final ED² over the least, the median of those that reach the end.",
    );
    let header = "variant | seen | best before the end | never better than the start | ≤ 1 on the way | end / least";
    page.table(header, bodies.by("variant").into_iter().map(cells));
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
        let [better, ties, worse, neither] = against(&here, &constant, &["target", "seed", "method", "variant"]);
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
    let cells = |(label, here): (String, Rows<'_>)| {
        let within = here.count(|row| row.is_within("final_mass", 0.05));
        [
            line(&[&label, &here.len(), &within]),
            here.cells("median of all final_mass"),
        ]
        .concat()
    };
    let (bodies, rivals) = (base.having(is_multimodal), rivals.having(is_multimodal));
    if bodies.is_empty() {
        page.paragraph("No run on a target with several modes reached its end.");
        return;
    }
    page.paragraph("Largest error of a mode's mass at the end, on the targets of the base with several modes; a run without particles is infinitely far.");
    let lines = groups(&bodies).into_iter().chain(groups(&rivals)).map(cells);
    page.table("setting | runs | within 0.05 | median", lines);
}

/// Powers of M, N and d in time and memory, beside the paper's.
fn cost(rows: &Rows<'_>, page: &mut Page) {
    let fit = |name: &str, column: &str| {
        let known = rows.having(|row| row.number("active_nodes").and(row.number(column)).is_some());
        let [particles, nodes, dims] = ["particles", "active_nodes", "dim"].map(|column| known.values(column));
        let law = fit_power_law_of(&[&particles, &nodes, &dims], &known.values(column)).ok();
        let exponent = |index: usize| law.as_ref().map(|law| exponent_text(law, index));
        let quality = law.as_ref().map(|law| law.r_squared);
        line(&[&name, &exponent(0), &exponent(1), &exponent(2), &quality])
    };
    page.paragraph(
        "Exponents of M, N and d in time per step and in what particles and grid hold, of the case `cost`: one fit of all three by least squares in logarithms, with 95 % intervals. N are \
         the nodes with mass: others do not exist here, where the paper counts kᵈ of a dense grid. A particle touches 3ᵈ nodes, which no power of d is.",
    );
    let lines = [
        fit("time per step", "seconds_per_step"),
        line(&[&"paper: O(M N d²)", &"1", &"1", &"2", &MISSING]),
        fit("memory", "storage_bytes"),
        line(&[&"paper: O((N + M) d + M d²)", &"≤ 1", &"≤ 1", &"1 to 2", &MISSING]),
    ];
    page.table("quantity | M | N | d | R²", &lines);
    settings(rows, page);
}
