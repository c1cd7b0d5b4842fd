//! The report of the study `quickstart`.

use std::fmt::Display;

use super::comparison::Comparison;
use super::{Piece, Quickstart, figures, reference};
use crate::output::particles_csv;
use crate::study::prelude::*;
use crate::study::row_file;

/// Tables, figures and verdict.
pub fn report(study: &Quickstart, rows: &Rows<'_>, directory: &StudyDirectory) -> Result<Page, CommandError> {
    let mut page = directory.page(include_str!("report.md"), &[]);
    let finished = |piece: Piece| rows.with("case", piece).count(Row::finished) > 0;
    let particles = |piece: Piece| particles_csv::read(&piece.file(directory, "particles"));
    if finished(Piece::Reference) && finished(Piece::Posterior) {
        let particles = particles(Piece::Posterior)?;
        let reference = row_file::read(&Piece::Reference.file(directory, "moments"), reference::COLUMNS)?;
        let comparison = Comparison::new(&particles, reference);
        page = verdict(study, &comparison, rows, page);
        page.part("Posterior moments", &[]);
        page.lines("Posterior moments", comparison.axes.iter().map(moments));
        page.heading("The posterior");
        figures::posterior(study, &particles, directory, &mut page)?;
    } else {
        page.paragraph("The posterior or its reference is missing, so there is nothing to compare yet.");
        page = page.with("verdict", "incomplete");
    }
    if finished(Piece::Picture) {
        page.heading("A target for the eye");
        figures::picture(study, &particles(Piece::Picture)?, &mut page)?;
    }
    page.heading("The way there");
    figures::traces(study, directory, &mut page)?;
    let lines = rows.iter().map(|row| {
        let both = row.count("score_evaluations").zip(row.count("density_evaluations"));
        let line = Line::from(row).with("ending", row.ending());
        line.with("both", both.map(|(scores, densities)| scores + densities))
    });
    page.lines("runs", lines);
    Ok(page)
}

fn verdict(study: &Quickstart, comparison: &Comparison, rows: &Rows<'_>, mut page: Page) -> Page {
    let bounds = &study.bounds;
    let kept = comparison.kept(bounds);
    let [means, deviations] = kept.map(|kept| if kept { "within" } else { "beyond" });
    let verdict = if kept == [true, true] { "pass" } else { "fail" };
    let reference = rows.with("case", Piece::Reference);
    let size = reference.first().and_then(|row| row.number("effective_sample_size"));
    let size = size.map(|size| format!("{size:.0}")).cell();
    let values: [(&str, &dyn Display); 9] = [
        ("verdict", &verdict),
        ("mean error", &number(comparison.mean_error)),
        ("means", &means),
        ("deviation error", &number(100.0 * comparison.deviation_error)),
        ("deviations", &deviations),
        ("deviation bound", &(100.0 * bounds.standard_deviation)),
        ("target", &study.posterior.target.label()),
        ("size", &size),
        ("reference error", &number(comparison.reference_error)),
    ];
    page.part("verdict", &values);
    page.with("largest_mean_error", format!("{:.6}", comparison.mean_error))
        .with("largest_sd_error", format!("{:.6}", comparison.deviation_error))
        .with("verdict", verdict)
}

/// The moments of a coordinate, with as many digits as it takes to compare them.
fn moments(row: &Row) -> Line<'_> {
    let number = |column: &str| row.number(column).unwrap_or(f64::NAN);
    let error = |column: &str| format!("{:.1e}", number(column));
    let values = ["own_mean", "mean", "own_deviation", "standard_deviation"];
    let digits = values.map(|column| (column.to_owned(), format!("{:.5}", number(column))));
    Line::from(row)
        .with_all(digits)
        .with("mean s.e.", error("mean_standard_error"))
        .with("mean off", format!("{:+.4}", number("mean_error")))
        .with("deviation s.e.", error("standard_deviation_standard_error"))
        .with("percent off", format!("{:+.2}", 100.0 * number("deviation_error")))
}
