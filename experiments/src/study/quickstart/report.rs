//! The report of the study `quickstart`.

use super::comparison::Comparison;
use super::{Case, Quickstart, figures, moments_file};
use crate::CommandError;
use crate::output::{particles_csv, table_file};
use crate::plots::page::{Cell, Page, line, number};
use crate::study::definition::Report;
use crate::study::directory::StudyDirectory;
use crate::study::run_row::RunRow;

/// Tables, figures and verdict.
pub fn report(study: &Quickstart, rows: &[RunRow], directory: &StudyDirectory) -> Result<Report, CommandError> {
    let mut page = Page::new("Quickstart: a posterior from real data");
    let mut summary = Vec::new();
    let finished = |case: Case| rows.iter().any(|row| row.case == case.name() && row.finished());

    if finished(Case::Reference) && finished(Case::Posterior) {
        let particles = particles_csv::read(&Case::Posterior.particles_file(directory))?;
        let comparison = Comparison::new(&particles, &table_file::read(&moments_file(directory))?);
        verdict(study, &comparison, rows, &mut page);
        summary.extend([
            ("largest_mean_error", format!("{:.6}", comparison.largest_mean_error())),
            (
                "largest_sd_error",
                format!("{:.6}", comparison.largest_deviation_error()),
            ),
            ("verdict", word(passes(study, &comparison)).to_owned()),
        ]);
        moments_table(&comparison, &mut page);
        page.heading("The posterior");
        figures::posterior(study, &particles, directory, &mut page)?;
    } else {
        page.paragraph("The posterior or its reference is missing, so there is nothing to compare yet.");
        summary.push(("verdict", "incomplete".to_owned()));
    }
    if finished(Case::Picture) {
        page.heading("A target for the eye");
        let particles = particles_csv::read(&Case::Picture.particles_file(directory))?;
        figures::picture(study, &particles, &mut page)?;
    }
    page.heading("The way there");
    figures::traces(study, directory, &mut page)?;
    runs_table(rows, &mut page);
    Ok(Report { page, summary })
}

fn passes(study: &Quickstart, comparison: &Comparison) -> bool {
    comparison.means_pass(&study.bounds) && comparison.deviations_pass(&study.bounds)
}

fn word(pass: bool) -> &'static str {
    if pass { "pass" } else { "fail" }
}

fn verdict(study: &Quickstart, comparison: &Comparison, rows: &[RunRow], page: &mut Page) {
    let bounds = &study.bounds;
    let within = |pass: bool| if pass { "within" } else { "beyond" };
    let size = rows
        .iter()
        .find(|row| row.case == Case::Reference.name())
        .and_then(|row| row.effective_sample_size);
    page.paragraph(format!(
        "**Verdict: {}.** The largest error of a posterior mean is {} posterior standard deviations, {} the bound of {}; the \
         largest error of a posterior standard deviation is {} %, {} the bound of {} %.",
        word(passes(study, comparison)),
        number(comparison.largest_mean_error()),
        within(comparison.means_pass(bounds)),
        bounds.mean,
        number(100.0 * comparison.largest_deviation_error()),
        within(comparison.deviations_pass(bounds)),
        100.0 * bounds.standard_deviation,
    ));
    page.paragraph(format!(
        "Posterior `{}`, {} particles by `{}`, seed {}. The reference is quasi-Monte-Carlo importance sampling with a Student t \
         proposal, {} points in {} independent scramblings (effective sample size {}); its standard errors come from the spread \
         between the scramblings and are at most {} posterior standard deviations for the means.",
        study.posterior.target.label(),
        study.posterior.particles,
        study.posterior.method.label(),
        study.seed,
        study.reference.points,
        study.reference.scramblings,
        size.map(|size| format!("{size:.0}")).cell(),
        number(comparison.largest_reference_error()),
    ));
}

fn moments_table(comparison: &Comparison, page: &mut Page) {
    page.heading("Posterior moments");
    let header = "coefficient | mean | reference mean | ± s.e. | error (sd) | sd | reference sd | ± s.e. | error (%)";
    let table: Vec<Vec<String>> = comparison
        .axes
        .iter()
        .map(|axis| {
            let reference = &axis.reference;
            vec![
                reference.name.clone(),
                format!("{:.5}", axis.mean),
                format!("{:.5}", reference.mean),
                format!("{:.1e}", reference.mean_standard_error),
                format!("{:+.4}", axis.mean_error),
                format!("{:.5}", axis.standard_deviation),
                format!("{:.5}", reference.standard_deviation),
                format!("{:.1e}", reference.standard_deviation_standard_error),
                format!("{:+.2}", 100.0 * axis.deviation_error),
            ]
        })
        .collect();
    page.table(header, &table);
}

fn runs_table(rows: &[RunRow], page: &mut Page) {
    let header = "case | status | target | method | M | steps | scores | densities | evaluations | residual | h | active nodes | time (s)";
    let line = |row: &RunRow| {
        let both = row.score_evaluations.zip(row.density_evaluations);
        line(&[
            &row.case,
            &row.ending(),
            &row.target,
            &row.method,
            &row.particles,
            &row.steps,
            &row.score_evaluations,
            &row.density_evaluations,
            &both.map(|(scores, densities)| scores + densities),
            &row.residual,
            &row.spacing,
            &row.active_nodes,
            &row.wall_seconds,
        ])
    };
    page.table(header, rows.iter().map(line));
}
