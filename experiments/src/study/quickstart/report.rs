//! The report of the study `quickstart`, whose figures are drawn from its raw files.

use parvi_files::pictures::trace_panels::{KINETIC_ENERGY, POTENTIAL_ENERGY, RESIDUAL, panels};
use parvi_files::pictures::{Beside, Known, contours};
use parvi_files::{particles_csv, table_file};

use super::{PICTURE, POSTERIOR, Quickstart, REFERENCE};
use crate::dispatch::on_target;
use crate::plots::{cloud, corner, histogram};
use crate::study::prelude::*;
use crate::study::reference::{MOMENTS, compared};

/// Tables, figures and verdict.
pub fn report(study: &Quickstart, rows: &Rows<'_>, directory: &StudyDirectory) -> Result<Page, CommandError> {
    let [target, shown] = [&study.posterior, &study.picture].map(|part| part.target.label());
    let mut page = directory.page(include_str!("report.md"), &[("target", &target), ("shown", &shown)]);
    let finished = |piece: &str| rows.with("case", piece).count(Row::finished) > 0;
    let particles = |piece: &str| particles_csv::read(&directory.raw_of(piece, "particles"));
    if finished(REFERENCE) && finished(POSTERIOR) {
        let own = particles(POSTERIOR)?;
        let moments = row_file::read(&directory.raw_of(REFERENCE, "moments"), MOMENTS)?;
        let axes = compared(&own, moments)?;
        page = verdict(study, &axes.iter().collect(), rows, page);
        page.section("Posterior moments", &[], &axes);
        page.heading("The posterior");
        let known = Known::Draws(particles(REFERENCE)?.to_rows());
        let coordinates = study.posterior.target.coordinate_names();
        let beside = Beside::new(&coordinates, &own, &known, "reference");
        page.drawing("posterior-corner.svg", beside.draw(corner));
        page.drawing("posterior-marginals.svg", beside.draw(histogram));
    } else {
        page.paragraph("The posterior or its reference is missing, so there is nothing to compare yet.");
        page = page.with("verdict", "incomplete");
    }
    if finished(PICTURE) {
        page.heading("A target for the eye");
        let (target, particles) = (&study.picture.target, particles(PICTURE)?);
        let known = on_target!(target, target, D => Ok(contours::<D>(target.as_ref(), 161)))?;
        let coordinates = target.coordinate_names();
        page.drawing(
            "picture.svg",
            Beside::new(&coordinates, &particles, &known, "").draw(cloud),
        );
    }
    page.heading("The way there");
    let mut runs = Vec::new();
    for (piece, part) in [(POSTERIOR, &study.posterior), (PICTURE, &study.picture)] {
        let steps = finished(piece).then(|| table_file::read(&directory.raw_of(piece, "trace")));
        let steps = steps.transpose()?.filter(|steps| !steps.is_empty());
        runs.extend(steps.map(|steps| (part.target.label(), steps)));
    }
    if !runs.is_empty() {
        let panels = panels([RESIDUAL, KINETIC_ENERGY, POTENTIAL_ENERGY], &runs);
        page.drawing("traces.svg", multiples(&MultiplesPlot::traces("", "step", panels)));
    }
    page.lines("runs", rows.iter());
    Ok(page)
}

/// Why nothing is decided.
const IMPRECISE: &str = ", since standard errors of the reference are above half of the bounds";
const HEAVY_TAIL: &str = ", since the tail of the reference's weights is too heavy for its standard errors to be relied on (Pareto k̂ above 0.7)";
const LARGEST_PARETO_K: f64 = 0.7;

/// Whether the particles' moments keep their bounds, axis by axis.
fn verdict(study: &Quickstart, axes: &Rows<'_>, rows: &Rows<'_>, mut page: Page) -> Page {
    let bounds = &study.bounds;
    let farthest = |column| axes.farthest(column).unwrap_or(f64::NAN);
    let [mean, deviation] = ["mean_error", "deviation_error"].map(farthest);
    let [reference, of_deviation] = ["reference_error", "reference_deviation_error"].map(farthest);
    let kept = [mean <= bounds.mean, deviation <= bounds.standard_deviation];
    let [means, deviations] = kept.map(|kept| if kept { "within" } else { "beyond" });
    // What is judged by has to be known twice as well.
    let is_precise = reference <= 0.5 * bounds.mean && of_deviation <= 0.5 * bounds.standard_deviation;
    let of_reference = rows.with("case", REFERENCE);
    let pareto_k = of_reference.first().and_then(|row| row.number("pareto_k"));
    let (verdict, why) = match kept {
        [true, true] => ("pass", ""),
        _ if !is_precise => ("undecided", IMPRECISE),
        _ if pareto_k.is_some_and(|k| k > LARGEST_PARETO_K) => ("undecided", HEAVY_TAIL),
        _ => ("fail", ""),
    };
    let line = Line::from(axes.clone())
        .with("verdict", format!("{verdict}{why}"))
        .with("means", means)
        .with("deviations", deviations)
        .with("deviation bound", (100.0 * bounds.standard_deviation).to_string());
    let size = rows.cell("fixed 0 effective_sample_size where case = reference");
    let tail = rows.cell("fixed 2 pareto_k where case = reference");
    page.part_of("verdict", line.with("size", size).with("tail", tail));
    page.with("largest_mean_error", format!("{mean:.6}"))
        .with("largest_sd_error", format!("{deviation:.6}"))
        .with("verdict", verdict)
}
