//! Answers to the paper's open questions, from the rows.

use super::body::Schedule;
use super::row::Row;
use super::table::{Finding, Findings, against, cell, groups, median, settings};
use crate::CommandError;
use crate::plots::exponent_text;
use crate::plots::page::{MISSING, Page, number};
use crate::statistics::fit_power_law_of;
use crate::study::attempt::Status;
use crate::study::each_once::each_once;

/// All answers, in the order of the paper's claims.
pub fn answers(findings: &Findings, bodies: &[Finding], page: &mut Page) -> Result<(), CommandError> {
    page.heading("When does it work?");
    when(findings, bodies, page)?;
    page.heading("Which law suits?");
    laws(&findings.sweep("material")?, page);
    page.heading("Transient or steady?");
    transient(bodies, page);
    page.heading("Does annealing help?");
    annealing(&findings.sweep("schedule")?, page);
    page.heading("Do modes separate?");
    modes(findings, page)?;
    page.heading("What does it cost?");
    cost(&findings.sweep("cost")?, page);
    Ok(())
}

/// The variants of bodies, in the order of the cases.
pub fn variants(bodies: &[Finding]) -> Vec<String> {
    each_once(bodies.iter().map(|(_, row)| row.variant.clone()))
}

/// Per target: the base, the best of all settings, and the rivals.
fn when(findings: &Findings, bodies: &[Finding], page: &mut Page) -> Result<(), CommandError> {
    let line = |variant: String| {
        let here: Vec<&Row> = bodies
            .iter()
            .map(|(_, row)| *row)
            .filter(|row| row.variant == variant)
            .collect();
        let within = |bound: f64| {
            here.iter()
                .filter(|row| row.ratio().is_some_and(|ratio| ratio <= bound))
                .count()
        };
        let ended = here.iter().filter(|row| row.status == Status::Finished).count();
        let counts = [here.len(), ended, within(10.0), within(1.0)];
        std::iter::once(variant)
            .chain(counts.map(|count| count.to_string()))
            .collect::<Vec<String>>()
    };
    page.paragraph("All runs: how many reach the end, and how many there have an ED² of at most 10 times, and at most once, that of independent draws.");
    let lines = variants(bodies).into_iter().map(line);
    page.table("variant | runs | ended | ED² ≤ 10 | ED² ≤ 1", lines);
    let base = findings.of(findings.study.base_cases()?);
    let rivals = findings.of(findings.study.rival_cases()?);
    let all_groups: Vec<(String, Vec<&Row>)> = groups(&base).into_iter().chain(groups(&rivals)).collect();
    let targets = each_once(base.iter().map(|(_, row)| row.target.as_str()));
    let mut header = vec!["target", "start"];
    header.extend(all_groups.iter().map(|(label, _)| label.as_str()));
    header.extend(["best setting", "which"]);
    let mut at_least_as_good = 0;
    let mut lines = Vec::new();
    for target in &targets {
        let here = |rows: &[&'_ Row]| {
            rows.iter()
                .copied()
                .filter(|row| row.target == *target)
                .cloned()
                .collect::<Vec<Row>>()
        };
        let mut line = vec![(*target).to_owned()];
        let first: Vec<Row> = all_groups.first().map_or(Vec::new(), |(_, rows)| here(rows));
        line.push(cell(median(&first, Row::start_ratio)));
        line.extend(all_groups.iter().map(|(_, rows)| cell(median(&here(rows), Row::ratio))));
        let size = first.first().map_or(0, |row| row.particles);
        let same = |(case, row): &&Finding| row.target == *target && case.particles == size;
        let candidates: Vec<Finding> = bodies.iter().filter(same).cloned().collect();
        let best = groups(&candidates)
            .into_iter()
            .filter_map(|(label, rows)| Some((median(rows, Row::ratio)?, label)));
        match best.min_by(|a, b| a.0.total_cmp(&b.0)) {
            Some((ratio, label)) => {
                at_least_as_good += usize::from(ratio <= 1.0);
                line.extend([cell(Some(ratio)), label]);
            }
            None => line.extend([MISSING.to_owned(), MISSING.to_owned()]),
        }
        lines.push(line);
    }
    page.paragraph(format!(
        "Medians of ED² over the seeds, relative to independent draws: the base, the rivals, and the best setting of all, chosen in hindsight. That one is at least as good as \
         independent draws on {at_least_as_good} of {} targets.",
        targets.len(),
    ));
    page.table(&header, &lines);
    Ok(())
}

fn laws(findings: &[Finding], page: &mut Page) {
    let ranked = groups(findings)
        .into_iter()
        .filter_map(|(label, rows)| Some((median(rows, Row::ratio)?, label)));
    if let Some((ratio, label)) = ranked.min_by(|a, b| a.0.total_cmp(&b.0)) {
        page.paragraph(format!(
            "The least median over all targets is {} times independent draws: {label}.",
            cell(Some(ratio))
        ));
        settings(findings, page);
    } else {
        page.paragraph("No run of the case `material`.");
    }
}

fn transient(bodies: &[Finding], page: &mut Page) {
    let line = |variant: String| {
        let here = bodies.iter().map(|(_, row)| *row).filter(|row| row.variant == variant);
        let seen: Vec<&Row> = here.filter(|row| row.best_step.is_some()).collect();
        let earlier = seen
            .iter()
            .filter(|row| row.best_step.is_some_and(|step| step < row.steps))
            .count();
        let never = seen.iter().filter(|row| row.start_ratio() <= row.best_ratio()).count();
        let ended: Vec<&Row> = seen.iter().filter(|row| row.ratio().is_some()).copied().collect();
        let good = seen
            .iter()
            .filter(|row| row.best_ratio().is_some_and(|ratio| ratio <= 1.0))
            .count();
        let gain = median(ended.iter().copied(), |row| Some(row.ratio()? / row.best_ratio()?));
        let counts = [seen.len(), earlier, never, good].map(|count| count.to_string());
        [vec![variant], counts.to_vec(), vec![cell(gain)]].concat()
    };
    page.paragraph(
        "Of the runs that were seen after their start: those that are best before their last step, those that are never better than their start, and those that have an ED² of at most 1 on the way; \
         and the final ED² over the least, the median of those that reach the end.",
    );
    let header = "variant | seen | best before the end | never better than the start | ≤ 1 on the way | end / least";
    page.table(header, variants(bodies).into_iter().map(line));
}

fn annealing(findings: &[Finding], page: &mut Page) {
    let constant = |finding: &&Finding| matches!(finding.0.body.schedule, Schedule::Constant { .. });
    let Some((first, _)) = findings.iter().find(constant) else {
        page.paragraph("No run of the case `schedule` with a constant α.");
        return;
    };
    let same = |one: &Finding, other: &Finding| {
        let (a, b) = (&one.0.body, &other.0.body);
        one.1.target == other.1.target
            && one.1.seed == other.1.seed
            && a.algorithm == b.algorithm
            && a.variant == b.variant
    };
    let mut schedules = each_once(findings.iter().map(|(case, _)| case.body.schedule));
    schedules.retain(|schedule| *schedule != first.body.schedule);
    let of = |schedule: Schedule| findings.iter().filter(move |(case, _)| case.body.schedule == schedule);
    for schedule in schedules {
        let pairs =
            of(schedule).filter_map(|one| Some((one.1, of(first.body.schedule).find(|other| same(one, other))?.1)));
        let name = of(schedule).next().map_or("", |(_, row)| row.schedule.as_str());
        let [better, ties, worse, neither] = against(pairs);
        page.paragraph(format!(
            "- α {name}: better than the constant one in {better} runs, as good in {ties}, worse in {worse}; in {neither} both diverged."
        ));
    }
    settings(findings, page);
}

fn modes(findings: &Findings, page: &mut Page) -> Result<(), CommandError> {
    let mut all = findings.of(findings.study.base_cases()?);
    all.extend(findings.of(findings.study.rival_cases()?));
    let targets: Vec<String> = all
        .iter()
        .filter(|(_, row)| row.final_mass.is_some())
        .map(|(_, row)| row.target.clone())
        .collect();
    let multimodal: Vec<Finding> = all
        .into_iter()
        .filter(|(_, row)| targets.contains(&row.target))
        .collect();
    let line = |(label, rows): (String, Vec<&Row>)| {
        let reached = rows
            .iter()
            .filter(|row| row.final_mass.is_some_and(|error| error <= 0.05))
            .count();
        vec![
            label,
            rows.len().to_string(),
            reached.to_string(),
            cell(median(rows, |row| row.final_mass)),
        ]
    };
    let (bodies, rivals): (Vec<Finding>, Vec<Finding>) =
        multimodal.into_iter().partition(|(case, _)| case.rival.is_none());
    if bodies.is_empty() {
        page.paragraph("No run on a target with several modes reached its end.");
        return Ok(());
    }
    page.paragraph("Largest error of a mode's mass at the end, on the targets of the base with several modes; a run without particles is infinitely far.");
    let lines = groups(&bodies).into_iter().chain(groups(&rivals)).map(line);
    page.table("setting | runs | within 0.05 | median", lines);
    Ok(())
}

/// Powers of M, N and d in time and memory, beside the paper's.
fn cost(findings: &[Finding], page: &mut Page) {
    let fit = |quantity: fn(&Row) -> Option<f64>| {
        let mut columns: [Vec<f64>; 4] = Default::default();
        for (_, row) in findings {
            if let (Some(nodes), Some(value)) = (row.active_nodes, quantity(row)) {
                for (column, value) in
                    columns
                        .iter_mut()
                        .zip([row.particles as f64, nodes as f64, row.dim as f64, value])
                {
                    column.push(value);
                }
            }
        }
        let [particles, nodes, dims, values] = &columns;
        let law = fit_power_law_of(&[particles, nodes, dims], values).ok();
        let exponents = [0, 1, 2].map(|index| law.as_ref().map_or(MISSING.to_owned(), |law| exponent_text(law, index)));
        let quality = law.map_or(MISSING.to_owned(), |law| number(law.r_squared));
        exponents.into_iter().chain([quality]).collect::<Vec<String>>()
    };
    let named = |name: &str, cells: Vec<String>| [vec![name.to_owned()], cells].concat();
    let paper = |cells: [&str; 3]| cells.iter().copied().chain([MISSING]).map(str::to_owned).collect();
    page.paragraph(
        "Exponents of M, N and d in time per step and in what particles and grid hold, of the case `cost`: one fit of all three by least squares in logarithms, with 95 % intervals. N are \
         the nodes with mass: others do not exist here, where the paper counts kᵈ of a dense grid. A particle touches 3ᵈ nodes, which no power of d is.",
    );
    let lines = [
        named("time per step", fit(|row| Some(row.wall_seconds? / row.steps as f64))),
        named("paper: O(M N d²)", paper(["1", "1", "2"])),
        named("memory", fit(|row| row.storage_bytes.map(|bytes| bytes as f64))),
        named("paper: O((N + M) d + M d²)", paper(["≤ 1", "≤ 1", "1 to 2"])),
    ];
    page.table("quantity | M | N | d | R²", &lines);
    settings(findings, page);
}
