//! The report of the study `paper`.

use super::answers::answers;
use super::body::is_rival;
use super::table::{Findings, TIE, against, is_good, settings};
use super::{Paper, figure};
use crate::plots::dots;
use crate::study::prelude::*;

/// Tables and figures.
pub fn report(study: &Paper, rows: &Rows<'_>, directory: &StudyDirectory) -> Result<Page, CommandError> {
    let findings = Findings::new(study, rows);
    let all = findings.of(study.all_cases()?);
    let bodies = all.having(|row| !is_rival(row));

    let mut page = directory.page(include_str!("report.md"), &[]);
    page.heading("Failures");
    failures(&bodies, &mut page);
    page.heading("Ties and losses");
    against_rivals(&findings, &mut page)?;
    answers(&findings, &bodies, &mut page)?;
    page.heading("Figures");
    let (alpha, stiffness) = (findings.sweep("alpha")?, findings.sweep("youngs-modulus")?);
    let drawing = multiples(&figure::strength(&alpha, &stiffness));
    page.drawing("strength.svg", drawing);
    let base = findings.base()?;
    page.drawing("transient.svg", dots(&figure::transient(&base)));
    let at_rest = findings.sweep("material-at-rest")?;
    if !at_rest.is_empty() {
        page.drawing("laws.svg", dots(&figure::materials(&at_rest)));
    }
    let drawing = multiples(&figure::cost(&findings.sweep("cost")?));
    page.drawing("cost.svg", drawing);
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
    let good = rows.count(|row| !is_rival(row) && is_good(row));
    Ok(page
        .with("cases", rows.len())
        .with("diverged", rows.ended(Status::Diverged))
        .with("as_good_as_independent", good))
}

/// Bodies by variant and algorithm.
fn by_method<'a>(bodies: &Rows<'a>) -> Vec<(String, &'static str, Rows<'a>)> {
    let mut all = Vec::new();
    for (variant, here) in bodies.by("variant") {
        for method in ["algorithm 1", "algorithm 2"] {
            all.push((variant.clone(), method, here.with("method", method)));
        }
    }
    all.retain(|(.., here)| !here.is_empty());
    all
}

/// How many runs diverge, why and when.
fn failures(bodies: &Rows<'_>, page: &mut Page) {
    let reasons = ["not finite", "outside range", "turned inside out", "other"];
    let cells = |(variant, method, here): (String, &str, Rows<'_>)| {
        let failed = here.having(|row| !row.finished());
        let mut steps: Vec<usize> = failed.iter().filter_map(|row| row.count("failed_step")).collect();
        steps.sort_unstable();
        let share = format!("{:.1}", 100.0 * failed.len() as f64 / here.len() as f64);
        let mut cells = line(&[&variant, &method, &here.len(), &failed.len(), &share]);
        cells.extend(reasons.map(|reason| failed.with("reason", reason).len().to_string()));
        cells.extend(line(&[&steps.get(steps.len() / 2), &steps.last()]));
        cells
    };
    let names = reasons.join(" | ");
    let header = format!("variant | method | runs | diverged | % | {names} | median step | last step");
    page.table(header.as_str(), by_method(bodies).into_iter().map(cells));
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
            let counts = against(&here, &others, &["target", "seed", "particles"]);
            if counts.iter().sum::<usize>() > 0 {
                let counts = counts.map(|count| count.to_string());
                lines.push([line(&[&variant, &method, &rival]), counts.into()].concat());
            }
        }
    }
    page.table(
        "variant | method | rival | better | ties | worse | both diverged",
        &lines,
    );
    Ok(())
}
