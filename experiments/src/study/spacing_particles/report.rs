//! The report of the study `spacing-particles`.

use super::configuration::{Series, SpacingParticles};
use super::curves::{Saturation, best, gain, runs, saturation};
use crate::CommandError;
use crate::plots::{AxisKind, LineSeries, MultiplesPanel, MultiplesPlot, exponent_text, multiples};
use crate::statistics::{fit_power_law, summarize};
use crate::study::attempt::Status;
use crate::study::definition::Report;
use crate::study::directory::StudyDirectory;
use crate::study::document::{Document, MISSING, number, optional_number};
use crate::study::gaussian_runs::{ENERGY, ENERGY_ROOT, NODES_PER_PARTICLE, Row, failures, median, values};

/// Tables and figure.
pub fn report(study: &SpacingParticles, rows: &[Row], directory: &StudyDirectory) -> Result<Report, CommandError> {
    let mut document = Document::new("Spacing and number of particles together");
    document.paragraph(format!(
        "Target N(0, I), method `{}`, {} seeds; medians over the seeds. ED² is the squared energy distance, exact in the \
         expectation over the Gaussian; spacings h are in standard deviations.",
        study.method.label(),
        study.seeds.len(),
    ));
    document.heading("Figure");
    let caption = "Energy distance against the spacing, by dimension and number of particles.";
    document.figure(
        directory,
        "spacing-particles.svg",
        caption,
        multiples(&plot(study, rows)),
    )?;
    best_spacings(study, rows, &mut document);
    document.heading("Where the error stops being the particles' and becomes the spacing's");
    document.paragraph(
        "For each spacing the number of particles beyond which more do not help: to the next one, ED² falls by less than a \
         tenth. The exponent b of ED² ∝ M^b between the two largest numbers of particles tells how far from that end they \
         are: b = −1 is the gain of independent draws, b = −(1 + 1/d) the best possible one, b = 0 none.",
    );
    for series in &study.series {
        document.paragraph(format!("**d = {}**: ED² × 10³ by number of particles.", series.dim));
        saturations(study, rows, series, &mut document);
    }
    failures(rows, &mut document);

    let failed = rows.iter().filter(|row| row.status != Status::Finished).count();
    let summary = vec![
        ("study", "spacing-particles".to_owned()),
        ("cases", rows.len().to_string()),
        ("failed", failed.to_string()),
    ];
    Ok(Report { document, summary })
}

fn best_spacings(study: &SpacingParticles, rows: &[Row], document: &mut Document) {
    document.heading("Best spacings");
    document.paragraph("An asterisk marks a best spacing at the edge of the scan, which the fits below leave out.");
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
            table.push(vec![
                series.dim.to_string(),
                particles.to_string(),
                format!("{spacing}{}", if at_the_edge { "*" } else { "" }),
                number(1e3 * energy),
                optional_number(median(&here, NODES_PER_PARTICLE)),
            ]);
        }
        let law = fit_power_law(&counts, &spacings);
        fits.push(vec![
            series.dim.to_string(),
            law.as_ref().map_or(MISSING.to_owned(), |law| exponent_text(law, 0)),
            optional_number(law.ok().map(|law| law.value(&[512.0]))),
            counts.len().to_string(),
        ]);
    }
    document.table(&["d", "M", "best h", "ED² × 10³", "active nodes / M"], &table);
    document.paragraph("Power laws of the best spacing, h ∝ M^b, with 95 % confidence intervals.");
    document.table(&["d", "b", "h at M = 512", "points"], &fits);
}

/// One line per spacing: ED² by number of particles, and where it stops falling.
fn saturations(study: &SpacingParticles, rows: &[Row], series: &Series, document: &mut Document) {
    let labels: Vec<String> = study.counts().iter().map(|count| format!("M = {count}")).collect();
    let mut header = vec!["h"];
    header.extend(labels.iter().map(String::as_str));
    header.extend(["b at the end", "more particles do not help"]);
    let mut table = Vec::new();
    for spacing in series.sorted() {
        let energy = |particles: usize| median(&runs(rows, series.dim, particles, spacing), ENERGY);
        let known: Vec<(usize, f64)> = study
            .counts()
            .into_iter()
            .filter_map(|particles| Some((particles, energy(particles)?)))
            .collect();
        let mut line = vec![spacing.to_string()];
        line.extend(
            study
                .counts()
                .into_iter()
                .map(|particles| optional_number(energy(particles).map(|e| 1e3 * e))),
        );
        let gain = gain(&known).map_or(MISSING.to_owned(), |gain| number(gain).replace('-', "−"));
        line.push(gain);
        line.push(match saturation(&known) {
            Some(Saturation::Beyond(particles)) => format!("beyond {particles}"),
            Some(Saturation::NotUpTo(particles)) => format!("they do up to {particles}"),
            None => MISSING.to_owned(),
        });
        table.push(line);
    }
    document.table(&header, &table);
}

/// One panel per dimension, one line per number of particles.
fn plot(study: &SpacingParticles, rows: &[Row]) -> MultiplesPlot {
    let panel = |series: &Series| MultiplesPanel {
        title: format!("d = {}", series.dim),
        series: study
            .counts()
            .into_iter()
            .map(|particles| curve(rows, series, particles))
            .collect(),
        ..MultiplesPanel::default()
    };
    MultiplesPlot {
        title: String::new(),
        x_label: "spacing h (standard deviations)".to_owned(),
        y_label: "energy distance ED (standard deviations^{½})".to_owned(),
        x_axis: AxisKind::Logarithmic,
        y_axis: AxisKind::Logarithmic,
        panels: study.series.iter().map(panel).collect(),
        notes: vec!["Medians over the seeds; bars from the smallest to the largest.".to_owned()],
    }
}

fn curve(rows: &[Row], series: &Series, particles: usize) -> LineSeries {
    let mut line = LineSeries {
        label: format!("M = {particles}"),
        ..LineSeries::default()
    };
    for spacing in series.sorted() {
        let here = runs(rows, series.dim, particles, spacing);
        if let Ok(summary) = summarize(&values(&here, ENERGY_ROOT)) {
            line.x.push(spacing);
            line.y.push(summary.median);
            line.bars.push((summary.minimum, summary.maximum));
        }
    }
    line
}
