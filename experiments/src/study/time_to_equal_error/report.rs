//! The report of the study `time-to-equal-error`.

use super::TimeToEqualError;
use super::figure::plot;
use super::row::Row;
use super::search::Ending;
use crate::CommandError;
use crate::options::{MethodName, MethodSpecification};
use crate::plots::page::{MISSING, Page, line, number};
use crate::plots::time_error;
use crate::study::definition::Report;
use crate::study::directory::StudyDirectory;

/// Tables and figure.
pub fn report(study: &TimeToEqualError, rows: &[Row], directory: &StudyDirectory) -> Result<Report, CommandError> {
    let label = study.method.label();
    let mut page = Page::new("Wall time to equal error");
    page.paragraph(format!(
        "The median over {} seeds of the squared energy distance of M particles of `{label}` is what its rivals have to reach, in \
         coordinates in which the target has mean zero and unit covariance, exact or against {} quasi-random points. All run on the \
         same threads{}; every time is that of the sampler alone, a warm-up included. A chain gets {} draws, then twice as many, up to \
         {}, all of which count; other particles as many as `{label}`, with {} steps, then twice as many, up to {}. A rival is stopped \
         once a run takes {} times as long as `{label}`.",
        study.seeds.len(),
        study.reference_points,
        study
            .threads
            .map_or(String::new(), |threads| format!(" (at most {threads})")),
        study.draws.doubling().first,
        study.draws.doubling().last,
        study.steps.doubling().first,
        study.steps.doubling().last,
        number(study.largest_ratio),
    ));
    page.heading("What a particle is worth");
    page.paragraph(format!(
        "ED² of independent draws is E‖Y − Y'‖/n in expectation; a particle of `{label}` is worth as many draws as that takes to \
         equal its ED², divided by M."
    ));
    worth(study, rows, &mut page);
    for rival in &study.rivals {
        page.heading(&format!("Against {}", rival.label()));
        against(study, rows, rival, &mut page);
    }
    page.heading("Figure");
    let caption = "ED² against wall time: a point per M, per number of draws or per number of steps.";
    let plot = plot(study, rows, directory)?;
    page.figure("time-to-equal-error.svg", caption, time_error(&plot));

    let rivals = || rows.iter().filter(|row| row.method != label);
    let count = |ending: Ending| rivals().filter(|row| row.ending == ending).count();
    Ok(Report::new(page)
        .with("reached", count(Ending::Reached))
        .with("out_of_time", count(Ending::OutOfTime))
        .with("out_of_sizes", count(Ending::OutOfSizes))
        .with("unsupported", count(Ending::Unsupported)))
}

/// The row of a method for a target and M.
fn find<'a>(rows: &'a [Row], target: &str, particles: usize, method: &str) -> Option<&'a Row> {
    rows.iter()
        .find(|row| row.target == target && row.particles == particles && row.method == method)
}

/// Every target with every M.
fn comparisons(study: &TimeToEqualError) -> impl Iterator<Item = (String, usize)> {
    let sizes = study.particles.iter().map(|particles| particles.get());
    study
        .targets
        .iter()
        .flat_map(move |target| sizes.clone().map(|particles| (target.label(), particles)))
}

fn worth(study: &TimeToEqualError, rows: &[Row], page: &mut Page) {
    let line = |(target, particles): (String, usize)| {
        let row = find(rows, &target, particles, study.method.label());
        let levels = row.and_then(Row::levels);
        line(&[
            &target,
            &particles,
            &row.and_then(|row| row.energy_distance_squared),
            &levels,
            &levels.map(f64::recip),
            &row.and_then(Row::evaluations),
            &row.and_then(|row| row.wall_seconds),
        ])
    };
    let header = "target | M | ED² | ED² / i.i.d. | draws per particle | evaluations | time (s)";
    page.table(header, comparisons(study).map(line));
}

/// One line per target and M: what the rival needs, and how many times longer that takes.
fn against(study: &TimeToEqualError, rows: &[Row], rival: &MethodSpecification, page: &mut Page) {
    let label = study.method.label();
    let size = if rival.name.iterates() { "steps" } else { "draws" };
    let its = rival.label();
    let header =
        format!("target | M | {size} | ED² / goal | evaluations | {label} (s) | {its} (s) | {its} / {label} | ending");
    let mut table = Vec::new();
    let mut reasons = Vec::new();
    for (target, particles) in comparisons(study) {
        let own = find(rows, &target, particles, label).and_then(|row| row.wall_seconds);
        let row = find(rows, &target, particles, rival.label());
        if let Some(row) = row.filter(|row| row.ending == Ending::Unsupported) {
            reasons.push(format!("- {target}, M = {particles}: {}.", row.reason));
        }
        let over_goal = row.and_then(|row| Some(row.energy_distance_squared? / row.goal?));
        table.push(line(&[
            &target,
            &particles,
            &sizes(row),
            &over_goal,
            &row.and_then(Row::evaluations),
            &own,
            &row.and_then(|row| row.wall_seconds),
            &ratios(row, own),
            &row.map(|row| in_words(row.ending)),
        ]));
    }
    page.paragraph(match rival.name {
        MethodName::Iid => "Draws are what the expectation asks for; their ED² is not measured.".to_owned(),
        _ => format!(
            "The {size} lie between the last number that missed and the first that reached the error; the ratio of times is stated \
             for both."
        ),
    });
    page.table(header.as_str(), &table);
    if !reasons.is_empty() {
        page.paragraph(reasons.join("\n"));
    }
}

fn sizes(row: Option<&Row>) -> String {
    let Some((row, size)) = row.and_then(|row| Some((row, row.size?))) else {
        return MISSING.to_owned();
    };
    match (row.ending, row.missed_size) {
        (Ending::Reached, Some(missed)) => format!("{missed} to {size}"),
        (Ending::Reached, None) => size.to_string(),
        _ => format!("> {size}"),
    }
}

/// The times relative to the method's.
fn ratios(row: Option<&Row>, own: Option<f64>) -> String {
    let ratio = |seconds: Option<f64>| seconds.zip(own).map(|(seconds, own)| seconds / own);
    let Some((row, last)) = row.and_then(|row| Some((row, ratio(row.wall_seconds)?))) else {
        return MISSING.to_owned();
    };
    match (row.ending, ratio(row.wall_seconds_missed)) {
        (Ending::Reached, Some(missed)) => format!("{} to {}", number(missed), number(last)),
        (Ending::Reached, None) => number(last),
        _ => format!("> {}", number(last)),
    }
}

fn in_words(ending: Ending) -> &'static str {
    match ending {
        Ending::Reached => "reached",
        Ending::OutOfTime => "out of time",
        Ending::OutOfSizes => "largest number missed",
        Ending::Unsupported => "unsupported",
    }
}
