//! The report of the study `quickstart`.

use super::comparison::compared;
use super::{PICTURE, POSTERIOR, Quickstart, REFERENCE, figures, file, reference};
use crate::output::particles_csv;
use crate::study::prelude::*;

/// Tables, figures and verdict.
pub fn report(study: &Quickstart, rows: &Rows<'_>, directory: &StudyDirectory) -> Result<Page, CommandError> {
    let mut page = directory.page(include_str!("report.md"), &[]);
    let finished = |piece: &str| rows.with("case", piece).count(Row::finished) > 0;
    let particles = |piece: &str| particles_csv::read(&file(directory, piece, "particles"));
    if finished(REFERENCE) && finished(POSTERIOR) {
        let particles = particles(POSTERIOR)?;
        let reference = row_file::read(&file(directory, REFERENCE, "moments"), reference::COLUMNS)?;
        let axes = compared(&particles, reference);
        page = verdict(study, &axes.iter().collect(), rows, page);
        page.section("Posterior moments", &[], &axes);
        page.heading("The posterior");
        figures::posterior(study, &particles, directory, &mut page)?;
    } else {
        page.paragraph("The posterior or its reference is missing, so there is nothing to compare yet.");
        page = page.with("verdict", "incomplete");
    }
    if finished(PICTURE) {
        page.heading("A target for the eye");
        figures::picture(study, &particles(PICTURE)?, &mut page)?;
    }
    page.heading("The way there");
    figures::traces(study, directory, &mut page)?;
    page.lines("runs", rows.iter());
    Ok(page)
}

/// Whether the particles' moments keep their bounds, axis by axis.
fn verdict(study: &Quickstart, axes: &Rows<'_>, rows: &Rows<'_>, mut page: Page) -> Page {
    let bounds = &study.bounds;
    let [mean, deviation, reference] = ["mean_error", "deviation_error", "reference_error"]
        .map(|column| axes.values(column).into_iter().map(f64::abs).fold(0.0, f64::max));
    let pairs = [(mean, bounds.mean), (deviation, bounds.standard_deviation)];
    let kept = pairs.map(|(error, bound)| !axes.is_empty() && error <= bound);
    let [means, deviations] = kept.map(|kept| if kept { "within" } else { "beyond" });
    let verdict = if kept == [true, true] { "pass" } else { "fail" };
    let runs = rows.with("case", REFERENCE);
    let values: [(&str, &dyn Display); 9] = [
        ("verdict", &verdict),
        ("mean error", &number(mean)),
        ("means", &means),
        ("deviation error", &number(100.0 * deviation)),
        ("deviations", &deviations),
        ("deviation bound", &(100.0 * bounds.standard_deviation)),
        ("target", &study.posterior.target.label()),
        ("size", &runs.cell("fixed 0 effective_sample_size")),
        ("reference error", &number(reference)),
    ];
    page.part("verdict", &values);
    page.with("largest_mean_error", format!("{mean:.6}"))
        .with("largest_sd_error", format!("{deviation:.6}"))
        .with("verdict", verdict)
}
