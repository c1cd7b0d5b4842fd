//! The report of the study `paper`.

use super::answers::answers;
use super::table::{Findings, TIE, against, is_good, settings};
use super::{Paper, figure};
use crate::plots::dots;
use crate::study::prelude::*;

/// Tables and figures.
pub fn report(study: &Paper, rows: &Rows<'_>) -> Result<Report, CommandError> {
    let findings = Findings::new(study, rows);
    let all = findings.of(study.all_cases()?);
    let bodies = all.having(|row| !row.text("variant").is_empty());
    let mut page = Page::new("What Algorithms 1 and 2 of the MPM-ParVI paper reach");
    page.paragraph(format!(
        "Huang, arXiv 2407.20287, has no experiments; these are some. `as written`: the target's own coordinates, the force of Eq. 3, no guard. `guards on, frame`: this project's defaults. \
         The start is N({}, {}²) in every coordinate of the body. ED² is the squared energy distance from the target over its expectation E‖Y − Y'‖/M for M independent draws, so these have 1; \
         `on the way` is the least ED² among every {}th step after the start. A run ends, and has diverged, where something is not finite or a mean or standard deviation is off by more than {} \
         standard deviations. Medians take a run without particles for infinitely far, ∞. Mean and sd are the largest errors in standard deviations. Evaluations are of the score: each node once.",
        study.start_mean, study.start_sd, study.look_every, study.reach,
    ));
    page.heading("Failures");
    failures(&bodies, &mut page);
    page.heading("Ties and losses");
    against_rivals(&findings, &mut page)?;
    answers(&findings, &bodies, &mut page)?;
    page.heading("Figures");
    let (alpha, stiffness) = (findings.sweep("alpha")?, findings.sweep("youngs-modulus")?);
    let caption = "ED² at the end over the factor α of the force and over Young's modulus E.";
    let drawing = multiples(&figure::strength(&alpha, &stiffness));
    page.figure("strength.svg", caption, drawing);
    let caption = "The base: start, best configuration on the way, and end.";
    let base = findings.base()?;
    page.figure("transient.svg", caption, dots(&figure::transient(&base)));
    let at_rest = findings.sweep("material-at-rest")?;
    if !at_rest.is_empty() {
        let caption = "What bodies of every law rest as, with friction and a force per mass: the isothermal gas has the target for its rest state, and `mpm` moves it freed from F.";
        page.figure("laws.svg", caption, dots(&figure::materials(&at_rest)));
    }
    let caption = "Time per step over the number of particles.";
    let drawing = multiples(&figure::cost(&findings.sweep("cost")?));
    page.figure("cost.svg", caption, drawing);
    page.heading("Base and rivals");
    settings(&base, &mut page);
    settings(&findings.rivals()?, &mut page);
    for sweep in &study.sweeps {
        let name = sweep.name.as_deref().unwrap_or_default();
        if !["material", "schedule", "cost"].contains(&name) {
            page.heading(&format!("Case `{name}`"));
            settings(&findings.sweep(name)?, &mut page);
        }
    }
    Ok(Report::new(page)
        .with("cases", rows.len())
        .with("diverged", rows.count(|row| row.status() == Status::Diverged))
        .with(
            "as_good_as_independent",
            rows.count(|row| !row.text("variant").is_empty() && is_good(row)),
        ))
}

/// Bodies by variant and algorithm.
fn by_method<'a>(bodies: &Rows<'a>) -> Vec<(&'a str, &'static str, Rows<'a>)> {
    let of = |variant: &'a str| {
        let here = bodies.with("variant", variant);
        ["algorithm 1", "algorithm 2"].map(|method| (variant, method, here.with("method", method)))
    };
    bodies.words("variant").into_iter().flat_map(of).collect()
}

/// How many runs diverge, why and when.
fn failures(bodies: &Rows<'_>, page: &mut Page) {
    let reasons = ["not finite", "outside range", "turned inside out", "other"];
    let mut lines = Vec::new();
    for (variant, method, here) in by_method(bodies) {
        let failed = here.having(|row| !row.finished());
        let mut steps: Vec<usize> = failed.iter().filter_map(|row| row.count("failed_step")).collect();
        steps.sort_unstable();
        let share = 100.0 * failed.len() as f64 / here.len().max(1) as f64;
        let share = format!("{share:.1}");
        let mut cells = line(&[&variant, &method, &here.len(), &failed.len(), &share]);
        cells.extend(reasons.map(|reason| failed.with("reason", reason).len().to_string()));
        cells.extend(line(&[&steps.get(steps.len() / 2), &steps.last()]));
        if !here.is_empty() {
            lines.push(cells);
        }
    }
    let reasons = reasons.join(" | ");
    let header = format!("variant | method | runs | diverged | % | {reasons} | median step | last step");
    page.table(header.as_str(), &lines);
}

/// The base beside its rivals, run by run.
fn against_rivals(findings: &Findings, page: &mut Page) -> Result<(), CommandError> {
    let (base, rivals) = (findings.base()?, findings.rivals()?);
    page.paragraph(format!(
        "Runs of the base beside those of a rival on the same target with the same seed: better, tie (ED² within a factor of {TIE}), worse. A run that diverged is worse than one that did not.",
    ));
    let mut lines = Vec::new();
    for (variant, method, here) in by_method(&base) {
        for rival in findings.study.rivals.iter().map(MethodSpecification::label) {
            let others = rivals.with("method", rival);
            let same = |row: &Row, other: &Row| {
                let alike = |column: &str| row.value(column) == other.value(column);
                ["target", "seed", "particles"].into_iter().all(alike)
            };
            let pairs = here
                .iter()
                .filter_map(|row| Some((row, others.iter().find(|other| same(row, other))?)));
            let counts = against(pairs);
            if counts.iter().sum::<usize>() > 0 {
                let mut cells = line(&[&variant, &method, &rival]);
                cells.extend(counts.map(|count| count.to_string()));
                lines.push(cells);
            }
        }
    }
    page.table(
        "variant | method | rival | better | ties | worse | both diverged",
        &lines,
    );
    Ok(())
}
