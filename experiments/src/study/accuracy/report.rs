//! The report of the study `accuracy`.

use super::configuration::{Accuracy, Entry};
use super::figure::{best_exponent, plot};
use crate::CommandError;
use crate::options::{Dimension, MethodName};
use crate::plots::{exponent_text, multiples};
use crate::statistics::fit_power_law;
use crate::study::attempt::Status;
use crate::study::definition::Report;
use crate::study::directory::StudyDirectory;
use crate::study::document::{Document, MISSING, number, optional_number};
use crate::study::gaussian_runs::{ENERGY, ENERGY_ROOT, Quantity, Row, SECONDS, failures, largest, median};

/// Tables and figure.
pub fn report(study: &Accuracy, rows: &[Row], directory: &StudyDirectory) -> Result<Report, CommandError> {
    let mut document = Document::new("Accuracy against the number of particles");
    document.paragraph(format!(
        "Target N(0, I), {} seeds. ED² is the squared energy distance, exact in the expectation over the Gaussian; \
         independent draws have the expectation E‖Y − Y'‖/M.",
        study.seeds.len(),
    ));
    document.heading("Figure");
    let caption = "Energy distance against the number of particles, by dimension.";
    document.figure(directory, "accuracy.svg", caption, multiples(&plot(study, rows)))?;

    document.heading("Squared energy distance");
    document.paragraph(
        "ED² × 10³: the median over the seeds and, in brackets, the largest. Ratios compare medians with those of the \
         Sobol points.",
    );
    for &dim in &study.dims {
        document.paragraph(format!("**d = {dim}**"));
        energy_table(study, rows, dim, &mut document);
    }
    slopes(study, rows, &mut document);
    costs(study, rows, &mut document);
    failures(rows, &mut document);

    let failed = rows.iter().filter(|row| row.status != Status::Finished).count();
    let summary = vec![
        ("study", "accuracy".to_owned()),
        ("cases", rows.len().to_string()),
        ("failed", failed.to_string()),
    ];
    Ok(Report { document, summary })
}

/// The runs of one method at one size.
fn runs<'a>(rows: &'a [Row], dim: Dimension, particles: usize, label: &str) -> Vec<&'a Row> {
    rows.iter()
        .filter(|row| row.dim == dim.get() && row.particles == particles && row.series == label)
        .collect()
}

/// The numbers of particles, few first.
fn counts(study: &Accuracy) -> Vec<usize> {
    let mut counts: Vec<usize> = study.particles.iter().map(|count| count.get()).collect();
    counts.sort_unstable();
    counts
}

fn energy_table(study: &Accuracy, rows: &[Row], dim: Dimension, document: &mut Document) {
    let yardstick = study
        .methods
        .iter()
        .find(|entry| entry.method.name == MethodName::Sobol)
        .map(|entry| entry.method.label());
    let compared = |entry: &Entry| yardstick.filter(|label| *label != entry.method.label());
    let mut header = vec!["M".to_owned(), "i.i.d., expected".to_owned()];
    for entry in &study.methods {
        header.push(entry.method.label().to_owned());
        header.extend(compared(entry).map(|label| format!("{} / {label}", entry.method.label())));
    }
    let mut table = Vec::new();
    for particles in counts(study) {
        let expected = rows
            .iter()
            .find(|row| row.dim == dim.get())
            .map(|row| 1e3 * row.energy_level * row.particles as f64 / particles as f64);
        let mut line = vec![particles.to_string(), optional_number(expected)];
        for entry in &study.methods {
            let here = runs(rows, dim, particles, entry.method.label());
            let middle = median(&here, ENERGY);
            line.push(match (middle, largest(&here, ENERGY)) {
                (Some(middle), Some(most)) => format!("{} ({})", number(1e3 * middle), number(1e3 * most)),
                _ => MISSING.to_owned(),
            });
            line.extend(compared(entry).map(|label| {
                let bar = median(&runs(rows, dim, particles, label), ENERGY);
                optional_number(middle.zip(bar).map(|(value, bar)| value / bar))
            }));
        }
        table.push(line);
    }
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    document.table(&header, &table);
}

fn slopes(study: &Accuracy, rows: &[Row], document: &mut Document) {
    document.heading("Slopes");
    document.paragraph(
        "Exponents b of ED ∝ M^b: least squares in logarithms over the medians, with 95 % confidence intervals. No M points \
         can do better than the order M^(−(1 + 1/d)/2) of optimally spread ones; independent draws have −1/2.",
    );
    let mut header = vec!["d"];
    header.extend(study.methods.iter().map(|entry| entry.method.label()));
    header.extend(["best possible", "independent draws"]);
    let slope = |dim: Dimension, label: &str| {
        let medians = counts(study).into_iter().filter_map(|particles| {
            Some((
                particles as f64,
                median(&runs(rows, dim, particles, label), ENERGY_ROOT)?,
            ))
        });
        let (sizes, errors): (Vec<f64>, Vec<f64>) = medians.unzip();
        fit_power_law(&sizes, &errors).map_or(MISSING.to_owned(), |law| exponent_text(&law, 0))
    };
    let table: Vec<Vec<String>> = study
        .dims
        .iter()
        .map(|&dim| {
            let mut line = vec![dim.to_string()];
            line.extend(study.methods.iter().map(|entry| slope(dim, entry.method.label())));
            line.extend([best_exponent(dim), -0.5].map(|slope| number(slope).replace('-', "−")));
            line
        })
        .collect();
    document.table(&header, &table);
}

/// What the runs took: one table per quantity, a line per size.
fn costs(study: &Accuracy, rows: &[Row], document: &mut Document) {
    document.heading("Costs");
    let quantities: [(&str, Quantity); 3] = [
        ("Wall time of the sampler in seconds, medians over the seeds.", SECONDS),
        ("Score evaluations per particle.", |row| {
            Some(row.score_evaluations? as f64 / row.particles as f64)
        }),
        ("Active nodes in the last step.", |row| {
            row.active_nodes.map(|count| count as f64)
        }),
    ];
    for (name, quantity) in quantities {
        let having: Vec<&str> = study
            .methods
            .iter()
            .map(|entry| entry.method.label())
            .filter(|label| {
                rows.iter()
                    .any(|row| row.series == *label && quantity(row).is_some_and(|value| value > 0.0))
            })
            .collect();
        if having.is_empty() {
            continue;
        }
        let mut header = vec!["d", "M"];
        header.extend(&having);
        let mut table = Vec::new();
        for &dim in &study.dims {
            for particles in counts(study) {
                let mut line = vec![dim.to_string(), particles.to_string()];
                let value = |label: &&str| optional_number(median(&runs(rows, dim, particles, label), quantity));
                line.extend(having.iter().map(value));
                table.push(line);
            }
        }
        document.paragraph(name);
        document.table(&header, &table);
    }
}
