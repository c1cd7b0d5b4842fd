//! Answers to the paper's open questions, from the rows.

use super::table::{BEST_RATIO, Findings, RATIO, START_RATIO, against, cell, groups, median, settings};
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
fn best(rows: &Rows<'_>) -> Option<(f64, String)> {
    let ranked = groups(rows).into_iter();
    let ranked = ranked.filter_map(|(label, rows)| Some((median(&rows, RATIO)?, label)));
    ranked.min_by(|a, b| a.0.total_cmp(&b.0))
}

/// Per target: the base, the best of all settings, and the rivals.
fn when(findings: &Findings, bodies: &Rows<'_>, page: &mut Page) -> Result<(), CommandError> {
    let counts = |variant: &str| {
        let here = bodies.with("variant", variant);
        let within = |bound: f64| here.count(|row| RATIO(row).is_some_and(|ratio| ratio <= bound));
        line(&[
            &variant,
            &here.len(),
            &here.count(Row::finished),
            &within(10.0),
            &within(1.0),
        ])
    };
    page.paragraph("All runs: how many reach the end, and how many there have an ED² of at most 10 times, and at most once, that of independent draws.");
    let lines = bodies.words("variant").into_iter().map(counts);
    page.table("variant | runs | ended | ED² ≤ 10 | ED² ≤ 1", lines);
    let base = findings.base()?;
    let all_groups: Vec<_> = groups(&base).into_iter().chain(groups(&findings.rivals()?)).collect();
    let targets = base.words("target");
    let mut header = vec!["target", "start"];
    header.extend(all_groups.iter().map(|(label, _)| label.as_str()));
    header.extend(["best setting", "which"]);
    let mut at_least_as_good = 0;
    let mut lines = Vec::new();
    for target in &targets {
        let here: Vec<Rows<'_>> = all_groups
            .iter()
            .map(|(_, rows)| rows.with("target", *target))
            .collect();
        let first = here.first().cloned().unwrap_or_default();
        let mut cells = line(&[target, &cell(median(&first, START_RATIO))]);
        cells.extend(here.iter().map(|rows| cell(median(rows, RATIO))));
        let size = first.first().and_then(|row| row.count("particles")).unwrap_or(0);
        let best = best(&bodies.with("target", *target).with("particles", size));
        at_least_as_good += usize::from(best.as_ref().is_some_and(|(ratio, _)| *ratio <= 1.0));
        cells.push(cell(best.as_ref().map(|(ratio, _)| *ratio)));
        cells.push(best.map(|(_, label)| label).cell());
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
    if let Some((ratio, label)) = best(rows) {
        page.paragraph(format!(
            "The least median over all targets is {} times independent draws: {label}.",
            cell(Some(ratio))
        ));
        settings(rows, page);
    } else {
        page.paragraph("No run of the case `material`.");
    }
}

fn transient(bodies: &Rows<'_>, page: &mut Page) {
    let cells = |variant: &str| {
        let of_variant = bodies.with("variant", variant);
        let seen = of_variant.having(|row| row.count("best_step").is_some());
        let ended = seen.having(|row| RATIO(row).is_some());
        line(&[
            &variant,
            &seen.len(),
            &seen.count(|row| row.count("best_step") < row.count("steps")),
            &seen.count(|row| START_RATIO(row) <= BEST_RATIO(row)),
            &seen.count(|row| BEST_RATIO(row).is_some_and(|ratio| ratio <= 1.0)),
            &cell(median(&ended, |row: &Row| Some(RATIO(row)? / BEST_RATIO(row)?))),
        ])
    };
    page.paragraph(
        "Of the runs that were seen after their start: those that are best before their last step, those that are never better than their start, and those that have an ED² of at most 1 on the way; \
         and the final ED² over the least, the median of those that reach the end.",
    );
    let header = "variant | seen | best before the end | never better than the start | ≤ 1 on the way | end / least";
    page.table(header, bodies.words("variant").into_iter().map(cells));
}

fn annealing(rows: &Rows<'_>, page: &mut Page) {
    // A constant α is stated as a number.
    let is_constant = |schedule: &&str| schedule.parse::<f64>().is_ok();
    let schedules = rows.words("schedule");
    let Some(constant) = schedules.iter().copied().find(is_constant) else {
        page.paragraph("No run of the case `schedule` with a constant α.");
        return;
    };
    let others = rows.with("schedule", constant);
    for schedule in schedules.into_iter().filter(|schedule| *schedule != constant) {
        let same = |row: &Row, other: &Row| {
            let alike = |column: &str| row.value(column) == other.value(column);
            ["target", "seed", "method", "variant"].into_iter().all(alike)
        };
        let here = rows.with("schedule", schedule);
        let pairs = here
            .iter()
            .filter_map(|row| Some((row, others.iter().find(|other| same(row, other))?)));
        let [better, ties, worse, neither] = against(pairs);
        page.paragraph(format!(
            "- α {schedule}: better than the constant one in {better} runs, as good in {ties}, worse in {worse}; in {neither} both diverged."
        ));
    }
    settings(rows, page);
}

fn modes(base: &Rows<'_>, rivals: &Rows<'_>, page: &mut Page) {
    let has_modes = |row: &Row| row.number("final_mass").is_some();
    let known = [base.having(has_modes), rivals.having(has_modes)];
    let targets: Vec<&str> = known.iter().flat_map(|rows| rows.words("target")).collect();
    let is_multimodal = |row: &Row| targets.contains(&row.text("target"));
    let cells = |(label, rows): (String, Rows<'_>)| {
        let within = rows.count(|row| row.number("final_mass").is_some_and(|error| error <= 0.05));
        line(&[&label, &rows.len(), &within, &cell(median(&rows, "final_mass"))])
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
    let fit = |name: &str, quantity: Computed| {
        let known = rows.having(|row| row.number("active_nodes").is_some() && quantity(row).is_some());
        let [particles, nodes, dims] = ["particles", "active_nodes", "dim"].map(|column| known.values(column));
        let law = fit_power_law_of(&[&particles, &nodes, &dims], &known.values(quantity)).ok();
        let exponent = |index: usize| law.as_ref().map(|law| exponent_text(law, index));
        let quality = law.as_ref().map(|law| law.r_squared);
        line(&[&name, &exponent(0), &exponent(1), &exponent(2), &quality])
    };
    page.paragraph(
        "Exponents of M, N and d in time per step and in what particles and grid hold, of the case `cost`: one fit of all three by least squares in logarithms, with 95 % intervals. N are \
         the nodes with mass: others do not exist here, where the paper counts kᵈ of a dense grid. A particle touches 3ᵈ nodes, which no power of d is.",
    );
    let lines = [
        fit("time per step", |row| Some(row.number(SECONDS)? / row.number("steps")?)),
        line(&[&"paper: O(M N d²)", &"1", &"1", &"2", &MISSING]),
        fit("memory", |row| row.number("storage_bytes")),
        line(&[&"paper: O((N + M) d + M d²)", &"≤ 1", &"≤ 1", &"1 to 2", &MISSING]),
    ];
    page.table("quantity | M | N | d | R²", &lines);
    settings(rows, page);
}
