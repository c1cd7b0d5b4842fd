//! The report of the study `spacing-particles`.

use super::curves::{Saturation, best, gain, runs, saturation};
use super::{Series, SpacingParticles};
use crate::statistics::fit_power_law;
use crate::study::prelude::*;

/// Tables and figure.
pub fn report(study: &SpacingParticles, rows: &Rows<'_>) -> Report {
    let mut page = Page::new("Spacing and number of particles together");
    page.paragraph(format!(
        "Target N(0, I), method `{}`, {} seeds; medians over the seeds. ED² is the squared energy distance, exact in the \
         expectation over the Gaussian; spacings h are in standard deviations.",
        study.method.label(),
        study.seeds.len(),
    ));
    page.heading("Figure");
    let caption = "Energy distance against the spacing, by dimension and number of particles.";
    let drawing = multiples(&plot(study, rows));
    page.figure("spacing-particles.svg", caption, drawing);
    best_spacings(study, rows, &mut page);
    page.heading("Where the error stops being the particles' and becomes the spacing's");
    page.paragraph(
        "For each spacing the number of particles beyond which more do not help: to the next one, ED² falls by less than a \
         tenth. The exponent b of ED² ∝ M^b between the two largest numbers of particles tells how far from that end they \
         are: b = −1 is the gain of independent draws, b = −(1 + 1/d) the best possible one, b = 0 none.",
    );
    for series in &study.series {
        page.paragraph(format!("**d = {}**: ED² × 10³ by number of particles.", series.dim));
        saturations(study, rows, series, &mut page);
    }
    rows.report(page)
}

fn best_spacings(study: &SpacingParticles, rows: &Rows<'_>, page: &mut Page) {
    page.heading("Best spacings");
    page.paragraph("An asterisk marks a best spacing at the edge of the scan, which the fits below leave out.");
    let mut table = Vec::new();
    let mut fits = Vec::new();
    for series in &study.series {
        let (mut counts, mut spacings) = (Vec::new(), Vec::new());
        for particles in study.counts() {
            let Some((spacing, energy)) = best(rows, series, particles) else {
                continue;
            };
            let ends = series.sorted();
            let at_the_edge = ends.first() == Some(&spacing) || ends.last() == Some(&spacing);
            if !at_the_edge {
                counts.push(particles as f64);
                spacings.push(spacing);
            }
            let here = runs(rows, series.dim, particles, spacing);
            let named = format!("{spacing}{}", if at_the_edge { "*" } else { "" });
            let nodes = here.median(NODES_PER_PARTICLE);
            table.push(line(&[&series.dim.get(), &particles, &named, &(1e3 * energy), &nodes]));
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

/// One line per spacing: ED² by number of particles, and where it stops falling.
fn saturations(study: &SpacingParticles, rows: &Rows<'_>, series: &Series, page: &mut Page) {
    let mut header = vec!["h".to_owned()];
    header.extend(study.counts().iter().map(|count| format!("M = {count}")));
    header.extend(["b at the end", "more particles do not help"].map(str::to_owned));
    let mut table = Vec::new();
    for spacing in series.sorted() {
        let energy = |particles: usize| runs(rows, series.dim, particles, spacing).median(ENERGY);
        let counts = study.counts().into_iter();
        let known = counts.filter_map(|particles| Some((particles, energy(particles)?)));
        let known: Vec<(usize, f64)> = known.collect();
        let mut line = vec![spacing.to_string()];
        let energies = study.counts().into_iter().map(energy);
        line.extend(energies.map(|energy| energy.map(|e| 1e3 * e).cell()));
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
    let line = |series: &Series, particles: usize| {
        let spacings = series.sorted().into_iter();
        let points = spacings.map(|spacing| (spacing, runs(rows, series.dim, particles, spacing)));
        curve(format!("M = {particles}"), points, ENERGY_ROOT)
    };
    let panel = |series: &Series| {
        let lines = study.counts().into_iter().map(|count| line(series, count));
        MultiplesPanel::new(format!("d = {}", series.dim), lines)
    };
    let (x_label, y_label) = (
        "spacing h (standard deviations)",
        "energy distance ED (standard deviations^{½})",
    );
    MultiplesPlot::logarithmic(x_label, y_label)
        .with_panels(study.series.iter().map(panel))
        .with_note("Medians over the seeds; bars from the smallest to the largest.")
}
