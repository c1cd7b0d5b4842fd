//! The report of the study `spacing-particles`.

use super::curves::{Saturation, best, gain, saturation};
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
    page.part(
        "Where the error stops being the particles' and becomes the spacing's",
        &[],
    );
    for series in &study.series {
        page.paragraph(format!("**d = {}**: ED² × 10³ by number of particles.", series.dim));
        saturations(study, &rows.with("dim", series.dim), series, &mut page);
    }
    Ok(rows.close(page))
}

fn best_spacings(study: &SpacingParticles, rows: &Rows<'_>, page: &mut Page) {
    page.part("Best spacings", &[]);
    let mut table = Vec::new();
    let mut fits = Vec::new();
    for series in &study.series {
        let here = rows.with("dim", series.dim);
        let (mut counts, mut spacings) = (Vec::new(), Vec::new());
        for particles in study.counts() {
            let Some((spacing, runs)) = best(&here, series, particles) else {
                continue;
            };
            let ends = series.sorted();
            let at_the_edge = ends.first() == Some(&spacing) || ends.last() == Some(&spacing);
            if !at_the_edge {
                counts.push(particles as f64);
                spacings.push(spacing);
            }
            let named = format!("{spacing}{}", if at_the_edge { "*" } else { "" });
            let names = line(&[&series.dim.get(), &particles, &named]);
            table.push(
                [
                    names,
                    runs.cells("median energy_thousandths | median nodes_per_particle"),
                ]
                .concat(),
            );
        }
        let law = fit_power_law(&counts, &spacings).ok();
        let exponent = law.as_ref().map(|law| exponent_text(law, 0));
        let at_512 = law.map(|law| law.value(&[512.0]));
        fits.push(line(&[&series.dim.get(), &exponent, &at_512, &counts.len()]));
    }
    page.table("d | M | best h | ED² × 10³ | active nodes / M", &table);
    page.paragraph("Power laws of the best spacing, h ∝ M^b, with 95 % confidence intervals.");
    page.table("d | b | h at M = 512 | points", &fits);
}

/// One line per spacing: ED² by number of particles, and where it stops falling; of runs in one dimension.
fn saturations(study: &SpacingParticles, here: &Rows<'_>, series: &Series, page: &mut Page) {
    let mut header = vec!["h".to_owned()];
    header.extend(study.counts().iter().map(|count| format!("M = {count}")));
    header.extend("b at the end | more particles do not help".names());
    let mut table = Vec::new();
    for spacing in series.sorted() {
        let here = here.with("requested_spacing", spacing);
        let energy = |particles: &usize| here.with("particles", *particles).median("energy_thousandths");
        let counts = study.counts();
        let energies: Vec<Option<f64>> = counts.iter().map(energy).collect();
        let pairs = counts.into_iter().zip(&energies);
        let known: Vec<(usize, f64)> = pairs.filter_map(|(count, energy)| Some((count, (*energy)?))).collect();
        let mut line = vec![spacing.to_string()];
        line.extend(energies.iter().map(Cell::cell));
        line.push(gain(&known).map(|gain| number(gain).replace('-', "−")).cell());
        line.push(match saturation(&known) {
            Some(Saturation::Beyond(particles)) => format!("beyond {particles}"),
            Some(Saturation::NotUpTo(particles)) => format!("they do up to {particles}"),
            None => MISSING.to_owned(),
        });
        table.push(line);
    }
    page.table(&header, &table);
}

/// One panel per dimension, one line per number of particles.
fn plot(study: &SpacingParticles, rows: &Rows<'_>) -> MultiplesPlot {
    let panel = |Series { dim, .. }: &Series| {
        let here = rows.with("dim", *dim);
        let line = |particles: usize| {
            let here = here.with("particles", particles);
            here.curve(format!("M = {particles}"), "requested_spacing", "energy_root")
        };
        MultiplesPanel::new(format!("d = {dim}"), study.counts().into_iter().map(line))
    };
    let y_label = "energy distance ED (standard deviations^{½})";
    MultiplesPlot::logarithmic("spacing h (standard deviations)", y_label)
        .with_panels(study.series.iter().map(panel))
        .with_note("Medians over the seeds; bars from the smallest to the largest.")
}
