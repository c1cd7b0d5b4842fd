//! The report of the study `accuracy`.

use super::configuration::Accuracy;
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

/// Methods that a figure can tell apart; where there are more, the tables have to do.
const MOST_LINES: usize = 8;

/// Tables and figure.
pub fn report(study: &Accuracy, rows: &[Row], directory: &StudyDirectory) -> Result<Report, CommandError> {
    let mut document = Document::new("Accuracy against the number of particles");
    document.paragraph(format!(
        "Target N(0, I), {} seeds. ED² is the squared energy distance, exact in the expectation over the Gaussian; \
         independent draws have the expectation E‖Y − Y'‖/M. Methods that move particles start from scrambled Sobol points of \
         N(0, I), on other scramblings than the yardstick's, unless their options say otherwise.",
        study.seeds.len(),
    ));
    if study.methods.len() <= MOST_LINES {
        document.heading("Figure");
        let caption = "Energy distance against the number of particles, by dimension.";
        document.figure(directory, "accuracy.svg", caption, multiples(&plot(study, rows)))?;
    }

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

/// A line per method, a column or two per size.
fn energy_table(study: &Accuracy, rows: &[Row], dim: Dimension, document: &mut Document) {
    let yardstick = study
        .methods
        .iter()
        .find(|entry| entry.method.name == MethodName::Sobol)
        .map(|entry| entry.method.label());
    let counts = counts(study);
    let mut header = vec!["method".to_owned()];
    for particles in &counts {
        header.push(format!("M = {particles}"));
        header.extend(yardstick.map(|label| format!("/ {label}")));
    }
    let mut independent = vec!["i.i.d., expected".to_owned()];
    for &particles in &counts {
        let expected = rows
            .iter()
            .find(|row| row.dim == dim.get())
            .map(|row| row.energy_level * row.particles as f64 / particles as f64);
        independent.push(optional_number(expected.map(|value| 1e3 * value)));
        independent.extend(yardstick.map(|label| relative(expected, &runs(rows, dim, particles, label))));
    }
    let mut table = vec![independent];
    for entry in &study.methods {
        let mut line = vec![entry.method.label().to_owned()];
        for &particles in &counts {
            let here = runs(rows, dim, particles, entry.method.label());
            let middle = median(&here, ENERGY);
            line.push(match (middle, largest(&here, ENERGY)) {
                (Some(middle), Some(most)) => format!("{} ({})", number(1e3 * middle), number(1e3 * most)),
                _ => MISSING.to_owned(),
            });
            line.extend(yardstick.map(|label| relative(middle, &runs(rows, dim, particles, label))));
        }
        table.push(line);
    }
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    document.table(&header, &table);
}

/// `value` over the median ED² of the yardstick's runs.
fn relative(value: Option<f64>, yardstick: &[&Row]) -> String {
    let ratio = value.zip(median(yardstick, ENERGY)).map(|(value, bar)| value / bar);
    optional_number(ratio)
}

/// A line per method, a column per dimension.
fn slopes(study: &Accuracy, rows: &[Row], document: &mut Document) {
    document.heading("Slopes");
    document.paragraph(
        "Exponents b of ED ∝ M^b: least squares in logarithms over the medians, with 95 % confidence intervals. No M points \
         can do better than the order M^(−(1 + 1/d)/2) of optimally spread ones; independent draws have −1/2.",
    );
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
    let line = |name: &str, cell: &dyn Fn(Dimension) -> String| {
        let mut line = vec![name.to_owned()];
        line.extend(study.dims.iter().map(|&dim| cell(dim)));
        line
    };
    let exact = |slope: f64| number(slope).replace('-', "−");
    let mut table = vec![
        line("best possible", &|dim| exact(best_exponent(dim))),
        line("independent draws", &|_| exact(-0.5)),
    ];
    for entry in &study.methods {
        let label = entry.method.label();
        table.push(line(label, &|dim| slope(dim, label)));
    }
    table_by_dimension(document, &["method"], &study.dims, &table);
}

/// What the runs took: a line per method and size, a column per dimension.
fn costs(study: &Accuracy, rows: &[Row], document: &mut Document) {
    document.heading("Costs");
    let quantities: [(&str, Quantity); 3] = [
        ("Wall time of the sampler in seconds, medians over the seeds.", SECONDS),
        (
            "Evaluations per particle, of the score and of the log density.",
            |row| Some((row.score_evaluations? + row.density_evaluations?) as f64 / row.particles as f64),
        ),
        ("Active nodes in the last step.", |row| {
            row.active_nodes.map(|count| count as f64)
        }),
    ];
    for (name, quantity) in quantities {
        let mut table = Vec::new();
        for entry in &study.methods {
            for particles in counts(study) {
                let value = |&dim: &Dimension| median(&runs(rows, dim, particles, entry.method.label()), quantity);
                let values: Vec<Option<f64>> = study.dims.iter().map(value).collect();
                if values.iter().flatten().any(|&value| value > 0.0) {
                    let mut line = vec![entry.method.label().to_owned(), particles.to_string()];
                    line.extend(values.into_iter().map(optional_number));
                    table.push(line);
                }
            }
        }
        if !table.is_empty() {
            document.paragraph(name);
            table_by_dimension(document, &["method", "M"], &study.dims, &table);
        }
    }
}

/// A table whose last columns are the dimensions.
fn table_by_dimension(document: &mut Document, first: &[&str], dims: &[Dimension], table: &[Vec<String>]) {
    let dims: Vec<String> = dims.iter().map(|dim| format!("d = {dim}")).collect();
    let header: Vec<&str> = first.iter().copied().chain(dims.iter().map(String::as_str)).collect();
    document.table(&header, table);
}
