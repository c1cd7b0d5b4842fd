//! The report of the study `stability`.

use super::Stability;
use super::figure::{cell, edges, plot};
use super::row::{Ending, Row};
use crate::options::MethodName;
use crate::plots::heat_map;
use crate::plots::page::{Cell, Page, number};
use crate::study::definition::Report;

/// The most refusals of the calibrated sampler that the report names; results.csv has them all.
const MOST_NAMED: usize = 100;

/// Tables and figure.
pub fn report(study: &Stability, rows: &[Row]) -> Report {
    let mut page = Page::new("Random configurations");
    page.paragraph(format!(
        "{} random configurations of seed {}: target, dimension, basis, spacing (0.1 to 10 times the default), time step (0.1 to 30 \
         times), start (mean 0 to 10, standard deviation 0.1 to 10), 2 to 2,000 particles, 5 to 100 steps, and the options of the \
         method (`mpm` without a survey), in a frame that is 10⁻³ to 10³ times as large as the target's and in half of the cases turned. A run diverged \
         if it ended with an error, or if a particle escaped: is ten times farther out than start and target together could explain.",
        study.cases, study.seed,
    ));
    let groups = groups(rows);
    endings(rows, &groups, &mut page);
    reasons(rows, &groups, &mut page);
    page.heading("Where the paper's algorithms diverge");
    let caption = "Share of diverged runs of Algorithms 1 and 2 over time step and spacing, guards off and on.";
    page.figure("divergence.svg", caption, heat_map(&plot(rows)));
    page.heading("What decides");
    page.paragraph("Diverged runs in percent of all, by one drawn quantity at a time.");
    breakdowns(rows, &groups, &mut page);
    let is_fault = |row: &&Row| matches!(row.ending, Ending::Panicked | Ending::NotFinite);
    let faults: Vec<String> = rows.iter().filter(is_fault).map(named).collect();
    page.list("Panics and numbers that are not finite", &faults, Some("None."));
    refusals(rows, &mut page);

    let count = |ending: Ending| rows.iter().filter(|row| row.ending == ending).count();
    Report::new(page)
        .with("finite", count(Ending::Finite))
        .with("refused", count(Ending::Refused))
        .with("panicked", count(Ending::Panicked))
        .with("not_finite", count(Ending::NotFinite))
}

/// The methods, the paper's ones with their guards, in alphabetical order.
fn groups(rows: &[Row]) -> Vec<String> {
    let mut groups: Vec<String> = rows.iter().map(Row::group).collect();
    groups.sort_unstable();
    groups.dedup();
    groups
}

fn of<'a>(rows: &'a [Row], group: &str) -> Vec<&'a Row> {
    rows.iter().filter(|row| row.group() == group).collect()
}

/// How the runs of each method ended.
fn endings(rows: &[Row], groups: &[String], page: &mut Page) {
    page.heading("Endings");
    let line = |group: &String| {
        let here = of(rows, group);
        let count = |choose: &dyn Fn(&Row) -> bool| here.iter().filter(|row| choose(row)).count();
        let ended = |ending: Ending| count(&|row| row.ending == ending).to_string();
        let diverged = count(&Row::diverged);
        vec![
            group.clone(),
            here.len().to_string(),
            ended(Ending::Finite),
            count(&|row| row.escaped).to_string(),
            ended(Ending::Refused),
            ended(Ending::Panicked),
            ended(Ending::NotFinite),
            format!("{:.1}", percent(diverged, here.len())),
        ]
    };
    let header =
        "method | runs | finite | of these escaped | typed error | panic | not finite, no error | diverged (%)";
    page.table(header, groups.iter().map(line));
}

fn percent(part: usize, all: usize) -> f64 {
    100.0 * part as f64 / all.max(1) as f64
}

/// How often each kind of error ended a run.
fn reasons(rows: &[Row], groups: &[String], page: &mut Page) {
    let mut reasons: Vec<&str> = rows.iter().map(|row| row.reason.as_str()).collect();
    reasons.retain(|reason| !reason.is_empty());
    reasons.sort_unstable();
    reasons.dedup();
    if reasons.is_empty() {
        page.paragraph("No run ended with an error.");
        return;
    }
    let line = |reason: &&str| {
        let mut line = vec![(*reason).to_owned()];
        line.extend(groups.iter().map(|group| {
            let count = of(rows, group).iter().filter(|row| row.reason == *reason).count();
            count.to_string()
        }));
        line
    };
    table("error", groups, reasons.iter().map(line).collect(), page);
}

/// Shares of diverged runs, by one quantity at a time.
fn breakdowns(rows: &[Row], groups: &[String], page: &mut Page) {
    type Number = fn(&Row) -> Option<f64>;
    type Word = fn(&Row) -> Option<String>;
    let numbers: [(&str, [f64; 2], Number); 6] = [
        ("frame / target's frame", [1e-3, 1e3], |row| Some(row.scale)),
        ("time step / default", super::draw::TIME_STEPS, |row| {
            Some(row.time_step_factor)
        }),
        ("spacing / default", super::draw::SPACINGS, |row| {
            Some(row.spacing_factor)
        }),
        ("start sd", [0.1, 10.0], |row| row.start_sd),
        ("M", [2.0, 2000.0], |row| Some(row.particles as f64)),
        ("friction, above 0", [0.01, 100.0], |row| row.friction),
    ];
    for (name, range, quantity) in numbers {
        let edges = edges(range);
        let lines = edges.windows(2).enumerate().map(|(bin, ends)| {
            let label = format!("{} to {}", number(ends[0]), number(ends[1]));
            let chosen = |row: &Row| quantity(row).and_then(|value| cell(&edges, value)) == Some(bin);
            shares(label, rows, groups, &chosen)
        });
        table(name, groups, lines.collect(), page);
    }
    let words: [(&str, Word); 7] = [
        ("target", |row| Some(row.target.clone())),
        ("d", |row| Some(row.dim.to_string())),
        ("basis", |row| Some(row.basis.to_string())),
        ("score at", |row| row.score.map(|score| score.to_string())),
        ("transfer", |row| row.transfer.map(|transfer| transfer.to_string())),
        ("moment correction", |row| {
            row.moment_correction.map(|word| word.to_string())
        }),
        ("elastic law", |row| row.material.map(|material| material.to_string())),
    ];
    for (name, word) in words {
        let mut values: Vec<String> = rows.iter().filter_map(word).collect();
        values.sort_unstable();
        values.dedup();
        let line = |value: &String| shares(value.clone(), rows, groups, &|row| word(row).as_ref() == Some(value));
        table(name, groups, values.iter().map(line).collect(), page);
    }
}

/// A line: the share of diverged runs of each method among those chosen.
fn shares(label: String, rows: &[Row], groups: &[String], chosen: &dyn Fn(&Row) -> bool) -> Vec<String> {
    let mut line = vec![label];
    line.extend(groups.iter().map(|group| {
        let here: Vec<&Row> = of(rows, group).into_iter().filter(|row| chosen(row)).collect();
        let diverged = here.iter().filter(|row| row.diverged()).count();
        let share = (!here.is_empty()).then(|| format!("{:.1}", percent(diverged, here.len())));
        share.cell()
    }));
    line
}

fn table(name: &str, groups: &[String], lines: Vec<Vec<String>>, page: &mut Page) {
    page.table(format!("{name} | {}", groups.join(" | ")).as_str(), lines);
}

/// Names the runs of the calibrated sampler that diverged.
fn refusals(rows: &[Row], page: &mut Page) {
    page.heading("Runs of mpm that diverged");
    let diverged: Vec<&Row> = rows
        .iter()
        .filter(|row| row.method == MethodName::Mpm && row.diverged())
        .collect();
    if diverged.is_empty() {
        page.paragraph("None.");
        return;
    }
    if diverged.len() > MOST_NAMED {
        page.paragraph(format!(
            "The first {MOST_NAMED} of {}; results.csv has them all.",
            diverged.len()
        ));
    }
    let lines: Vec<String> = diverged.into_iter().take(MOST_NAMED).map(named).collect();
    page.paragraph(lines.join("\n"));
}

/// A case with what was drawn for it.
fn named(row: &Row) -> String {
    let what = match (row.ending, row.reach) {
        (Ending::Finite, Some(reach)) => format!("escaped to {} target scales", number(reach)),
        _ if row.reason.is_empty() => row.message.clone(),
        _ => format!("{}: {}", row.reason, row.message),
    };
    format!(
        "- `{}`: {} on {} (d = {}), {}, M = {}, frame × {}, start N({}, {}²), spacing × {}, time step × {}: {what}",
        row.case,
        row.group(),
        row.target,
        row.dim,
        row.basis,
        row.particles,
        number(row.scale),
        row.start_mean.cell(),
        row.start_sd.cell(),
        number(row.spacing_factor),
        number(row.time_step_factor),
    )
}
