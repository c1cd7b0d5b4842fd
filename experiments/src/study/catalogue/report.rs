//! The report of the study `catalogue`.

use super::claims::Claims;
use super::figure::plot;
use super::requirement::Requirement;
use super::{Catalogue, from_start, is_from};
use crate::plots::dots;
use crate::study::prelude::*;
use crate::study::start_law::StartLaw;

/// Tables and figure.
pub fn report(study: &Catalogue, rows: &Rows<'_>) -> Result<Report, CommandError> {
    let mut page = Page::new("Defaults on every target");
    page.paragraph(format!(
        "M = {} particles, {} seeds, nothing set per target. ED² is the squared energy distance and SW₂ the sliced Wasserstein \
         distance over {} directions, both in coordinates in which the target has mean zero and unit covariance, exact or \
         against {} quasi-random points; relative to independent draws means ED² over its expectation E‖Y − Y'‖/M, and SW₂ \
         over the median of {} sets of M draws. Starts N(m, s²) are in target scales, the mean m in every coordinate.",
        study.particles,
        study.seeds.len(),
        study.directions,
        study.reference_points,
        study.draws,
    ));
    page.heading("Figure");
    let caption = "ED² relative to independent draws, by target and start, with the requirement.";
    page.figure("catalogue.svg", caption, dots(&plot(study, rows)?));

    let targets = study.all_targets()?;
    let judged = study.judged().map_or("", MethodSpecification::label);
    let runs = rows.with("method", judged);
    let verdicts = verdicts(&targets, &runs)?;
    requirements(study, judged, &verdicts, &mut page);
    for start in &study.starts {
        page.heading(&format!("From {start}"));
        start_table(study, &targets, rows, start, &mut page)?;
    }
    let claims = Claims::new(runs);
    let labels: Vec<String> = targets.iter().map(TargetSpecification::label).collect();
    claims.write(&labels, &mut page);
    let missed = verdicts.iter().filter(|verdict| !verdict.met());
    let misses: Vec<String> = missed.map(Verdict::miss).collect();
    page.list("Cases that miss their bound", &misses, Some("None."));
    let others = rows.having(|row| row.text("method") != judged).failures();
    page.list("Runs of other methods that did not finish", &others, None);

    Ok(Report::new(page)
        .with("cases", rows.len())
        .with("judged", verdicts.len())
        .with("missed", misses.len())
        .with("claimed", claims.claimed().len())
        .with("false_claims", claims.false_claims().len()))
}

/// A run of the judged method beside what is asked of it.
struct Verdict<'a> {
    row: &'a Row,
    requirement: Requirement,
}

impl Verdict<'_> {
    fn met(&self) -> bool {
        ENERGY_RATIO(self.row).is_some_and(|ratio| ratio <= self.requirement.bound)
    }

    /// What is missed, as an item of a list.
    fn miss(&self) -> String {
        match ENERGY_RATIO(self.row) {
            Some(ratio) => format!(
                "- `{}`: ED² {} of independent draws, at most {}",
                self.row.case(),
                number(ratio),
                self.requirement.bound
            ),
            None => self.row.failure(),
        }
    }
}

fn verdicts<'a>(targets: &[TargetSpecification], runs: &Rows<'a>) -> Result<Vec<Verdict<'a>>, CommandError> {
    let mut verdicts = Vec::new();
    for target in targets {
        let requirement = Requirement::of(target)?;
        let here = runs.with("target", target.label());
        verdicts.extend(here.iter().map(|row| Verdict { row, requirement }));
    }
    Ok(verdicts)
}

/// How many cases meet what is asked, by class and by start.
fn requirements(study: &Catalogue, judged: &str, verdicts: &[Verdict<'_>], page: &mut Page) {
    page.heading("Requirements");
    page.paragraph(format!(
        "What is asked of {judged}: ED² relative to independent draws at most the bound, in every case. A cell counts the cases \
         that meet it.",
    ));
    let mut header = "targets | bound".names();
    header.extend(study.starts.iter().map(StartLaw::to_string));
    header.extend("all | worst | worst case".names());
    let line = |class: Requirement| {
        let here = || verdicts.iter().filter(move |verdict| verdict.requirement == class);
        let count = |chosen: &dyn Fn(&Row) -> bool| {
            let all = here().filter(|verdict| chosen(verdict.row)).count();
            let met = here().filter(|verdict| chosen(verdict.row) && verdict.met()).count();
            (all > 0).then(|| format!("{met}/{all}")).cell()
        };
        let mut cells = line(&[&class.class, &class.bound]);
        cells.extend(study.starts.iter().map(|start| count(&|row| is_from(row, start))));
        cells.push(count(&|_| true));
        let worst = here()
            .map(|verdict| verdict.row)
            .collect::<Rows<'_>>()
            .worst(ENERGY_RATIO);
        cells.push(worst.map(|(value, _)| value).cell());
        cells.push(worst.map(|(_, row)| format!("`{}`", row.case())).cell());
        cells
    };
    page.table(&header, Requirement::ALL.map(line));
}

/// A line per target: both distances of every method, and the errors and costs of the judged one.
fn start_table(
    study: &Catalogue,
    targets: &[TargetSpecification],
    rows: &Rows<'_>,
    start: &StartLaw,
    page: &mut Page,
) -> Result<(), CommandError> {
    let mut header = "target | bound".names();
    for method in &study.methods {
        header.extend(["ED²", "SW₂"].map(|error| format!("{error} {}", method.label())));
    }
    header.extend("finished | mean (sd) | sd (relative) | mode mass | residual | evaluations | time (s)".names());
    let rows = from_start(rows, start);
    let mut table = Vec::new();
    for target in targets {
        let here = rows.with("target", target.label());
        let of = |method: &MethodSpecification| here.with("method", method.label());
        let mut cells = line(&[&target.label(), &Requirement::of(target)?.bound]);
        for method in &study.methods {
            cells.extend(of(method).medians(&[&ENERGY_RATIO, &SLICED_RATIO]));
        }
        let judged = study.judged().map(of).unwrap_or_default();
        cells.push(judged.finished());
        cells.extend(judged.medians(&[
            &"mean_error",
            &"deviation_error",
            &"mass_error",
            &"residual",
            &EVALUATIONS,
            &SECONDS,
        ]));
        table.push(cells);
    }
    page.paragraph("Medians over the seeds; ED² and SW₂ relative to independent draws.");
    page.table(&header, &table);
    Ok(())
}
