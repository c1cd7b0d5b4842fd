//! The report of the study `spacing-particles`.

use super::curves::{gain, saturation};
use super::{Series, SpacingParticles};
use crate::statistics::fit_power_law;
use crate::study::prelude::*;

/// Tables and figure.
pub fn report(study: &SpacingParticles, rows: &Rows<'_>, directory: &StudyDirectory) -> Result<Page, CommandError> {
    let mut page = directory.page(include_str!("report.md"), &[]);
    page.heading("Figure");
    let drawing = multiples(&plot(study, rows));
    page.drawing("spacing-particles.svg", drawing);
    best_spacings(study, rows, &mut page);
    let part = "Where the error stops being the particles' and becomes the spacing's";
    page.part(part, &[]);
    for series in &study.series {
        page.paragraph(format!("**d = {}**: ED² × 10³ by number of particles.", series.dim));
        saturations(study, &rows.with("dim", series.dim), series, &mut page);
    }
    Ok(rows.close(page))
}

fn best_spacings(study: &SpacingParticles, rows: &Rows<'_>, page: &mut Page) {
    let mut table = Vec::new();
    let mut fits = Vec::new();
    for series in &study.series {
        let here = rows.with("dim", series.dim);
        let (mut counts, mut spacings) = (Vec::new(), Vec::new());
        let ends = series.sorted();
        for particles in study.counts() {
            let here = here.with("particles", particles);
            let best = here.best("requested_spacing", ends.clone(), |runs| runs.median(ENERGY));
            let Some((spacing, runs)) = best else { continue };
            let at_the_edge = ends.first() == Some(&spacing) || ends.last() == Some(&spacing);
            if !at_the_edge {
                counts.push(particles as f64);
                spacings.push(spacing);
            }
            let best = format!("{spacing}{}", if at_the_edge { "*" } else { "" });
            table.push(Line::from(runs).with("best", best));
        }
        let law = fit_power_law(&counts, &spacings).ok();
        let exponent = law.as_ref().map(|law| exponent_text(law, 0));
        let at_512 = law.map(|law| law.value(&[512.0]));
        let fit = Line::default().with("dim", series.dim.get()).with("exponent", exponent);
        fits.push(fit.with("at 512", at_512).with("points", counts.len()));
    }
    page.section("Best spacings", &[], table);
    page.section("fits", &[], fits);
}

/// One line per spacing: ED² by number of particles, and where it stops falling; of runs in one dimension.
fn saturations(study: &SpacingParticles, here: &Rows<'_>, series: &Series, page: &mut Page) {
    let counts = study.counts();
    let lines = here.lines("requested_spacing", series.sorted());
    let lines = lines.into_iter().map(|line| {
        let energy = |&particles: &usize| {
            let here = line.rows.with("particles", particles);
            Some((particles, here.median("energy_thousandths")?))
        };
        let known: Vec<(usize, f64)> = counts.iter().filter_map(energy).collect();
        let gain = gain(&known).map(|gain| number(gain).replace('-', "−"));
        line.with("gain", gain).with("end", saturation(&known))
    });
    page.lines_over("by number of particles", &[each("M", &counts)], lines);
}

/// One panel per dimension, one line per number of particles.
fn plot(study: &SpacingParticles, rows: &Rows<'_>) -> MultiplesPlot {
    let panel = |here: &Rows<'_>| {
        let (sizes, x) = (("M = ", "particles"), "requested_spacing");
        MultiplesPanel::new("", here.curves(sizes, study.counts(), x, "energy_root"))
    };
    let dims = study.series.iter().map(|series| series.dim);
    let y_label = "energy distance ED (standard deviations^{½})";
    MultiplesPlot::logarithmic("spacing h (standard deviations)", y_label)
        .with_panels(rows.panels(("d = ", "dim"), dims, panel))
        .with_note("Medians over the seeds; bars from the smallest to the largest.")
}
