//! The report of the study `quickstart`.

use super::comparison::{AxisComparison, Comparison};
use super::{Piece, Quickstart, figures};
use crate::output::{particles_csv, table_file};
use crate::study::prelude::*;

/// Tables, figures and verdict.
pub fn report(study: &Quickstart, rows: &Rows<'_>, directory: &StudyDirectory) -> Result<Report, CommandError> {
    let mut page = Page::new("Quickstart: a posterior from real data");
    let mut summary = Vec::new();
    let finished = |piece: Piece| rows.with("case", piece.name()).count(Row::finished) > 0;
    let particles = |piece: Piece| particles_csv::read(&piece.file(directory, "particles"));
    if finished(Piece::Reference) && finished(Piece::Posterior) {
        let particles = particles(Piece::Posterior)?;
        let reference = table_file::read(&Piece::Reference.file(directory, "moments"))?;
        let comparison = Comparison::new(&particles, &reference);
        verdict(study, &comparison, rows, &mut page);
        let number = |number: f64| format!("{number:.6}");
        summary.extend([
            ("largest_mean_error", number(comparison.largest_mean_error())),
            ("largest_sd_error", number(comparison.largest_deviation_error())),
            ("verdict", word(passes(study, &comparison)).to_owned()),
        ]);
        moments_table(&comparison, &mut page);
        page.heading("The posterior");
        figures::posterior(study, &particles, directory, &mut page)?;
    } else {
        page.paragraph("The posterior or its reference is missing, so there is nothing to compare yet.");
        summary.push(("verdict", "incomplete".to_owned()));
    }
    if finished(Piece::Picture) {
        page.heading("A target for the eye");
        figures::picture(study, &particles(Piece::Picture)?, &mut page)?;
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

fn verdict(study: &Quickstart, comparison: &Comparison, rows: &Rows<'_>, page: &mut Page) {
    let bounds = &study.bounds;
    let within = |pass: bool| if pass { "within" } else { "beyond" };
    let reference = rows.with("case", Piece::Reference.name());
    let size = reference.first().and_then(|row| row.number("effective_sample_size"));
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
    let line = |axis: &AxisComparison| {
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
    };
    page.table(header, comparison.axes.iter().map(line));
}

fn runs_table(rows: &Rows<'_>, page: &mut Page) {
    let header = "case | status | target | method | M | steps | scores | densities | evaluations | residual | h | active nodes | time (s)";
    let line = |row: &Row| {
        let both = row.count("score_evaluations").zip(row.count("density_evaluations"));
        let evaluations = both.map(|(scores, densities)| scores + densities);
        let mut cells = line(&[&row.case(), &row.ending()]);
        cells.extend(row.cells("target | method | particles | steps | score_evaluations | density_evaluations"));
        cells.push(evaluations.cell());
        cells.extend(row.cells("residual | spacing | active_nodes | wall_seconds"));
        cells
    };
    page.table(header, rows.iter().map(line));
}
