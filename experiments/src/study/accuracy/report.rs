//! The report of the study `accuracy`.

use super::figure::{best_exponent, plot};
use super::{Accuracy, expected};
use crate::study::prelude::*;

/// Methods that a figure can tell apart; where there are more, the tables have to do.
const MOST_LINES: usize = 8;

/// Tables and figure.
pub fn report(study: &Accuracy, rows: &Rows<'_>) -> Report {
    let mut page = Page::new("Accuracy against the number of particles");
    page.paragraph(format!(
        "Target N(0, I), {} seeds. ED² is the squared energy distance, exact in the expectation over the Gaussian; \
         independent draws have the expectation E‖Y − Y'‖/M. Methods that move particles start from scrambled Sobol points of \
         N(0, I), on other scramblings than the yardstick's, unless their options say otherwise.",
        study.seeds.len(),
    ));
    if study.methods.len() <= MOST_LINES {
        page.heading("Figure");
        let caption = "Energy distance against the number of particles, by dimension.";
        page.figure("accuracy.svg", caption, multiples(&plot(study, rows)));
    }
    page.heading("Squared energy distance");
    page.paragraph(
        "ED² × 10³: the median over the seeds and, in brackets, the largest. Ratios compare medians with those of the \
         Sobol points.",
    );
    for &dim in &study.dims {
        page.paragraph(format!("**d = {dim}**"));
        energy_table(study, rows, dim, &mut page);
    }
    slopes(study, rows, &mut page);
    costs(study, rows, &mut page);
    rows.report(page)
}

/// A line per method, a column or two per size.
fn energy_table(study: &Accuracy, rows: &Rows<'_>, dim: Dimension, page: &mut Page) {
    let sobol = |entry: &&super::Entry| entry.method.name == MethodName::Sobol;
    let yardstick = study.methods.iter().find(sobol).map(|entry| entry.method.label());
    let here = rows.with("dim", dim);
    // Over the median ED² of the yardstick's runs, where there is one.
    let relative = |value: Option<f64>, particles: usize| {
        let runs = |label: &str| here.with("particles", particles).with("series", label);
        yardstick.map(|label| {
            value
                .zip(runs(label).median(ENERGY))
                .map(|(value, level)| value / level)
                .cell()
        })
    };
    let mut header = vec!["method".to_owned()];
    let mut independent = vec!["i.i.d., expected".to_owned()];
    for particles in ascending(&study.particles) {
        header.push(format!("M = {particles}"));
        header.extend(yardstick.map(|label| format!("/ {label}")));
        let expected = expected(rows, dim, particles as f64);
        independent.push(expected.map(|value| 1e3 * value).cell());
        independent.extend(relative(expected, particles));
    }
    let mut table = vec![independent];
    for label in study.labels() {
        let mut line = vec![label.to_owned()];
        for (particles, runs) in study.by_size(rows, dim, label) {
            let middle = runs.median(ENERGY);
            let both = middle.zip(runs.largest(ENERGY));
            line.push(
                both.map(|(middle, most)| format!("{} ({})", number(1e3 * middle), number(1e3 * most)))
                    .cell(),
            );
            line.extend(relative(middle, particles));
        }
        table.push(line);
    }
    page.table(&header, &table);
}

/// A line per method, a column per dimension.
fn slopes(study: &Accuracy, rows: &Rows<'_>, page: &mut Page) {
    page.heading("Slopes");
    page.paragraph(
        "Exponents b of ED ∝ M^b: least squares in logarithms over the medians, with 95 % confidence intervals. No M points \
         can do better than the order M^(−(1 + 1/d)/2) of optimally spread ones; independent draws have −1/2.",
    );
    let slope = |dim: Dimension, label: &str| {
        let sizes = study.by_size(rows, dim, label).into_iter();
        exponent(sizes.filter_map(|(particles, runs)| Some((particles as f64, runs.median(ENERGY_ROOT)?))))
    };
    let line = |name: &str, cell: &dyn Fn(Dimension) -> String| {
        let cells = study.dims.iter().map(|&dim| cell(dim));
        std::iter::once(name.to_owned()).chain(cells).collect::<Vec<_>>()
    };
    let exact = |slope: f64| number(slope).replace('-', "−");
    let mut table = vec![
        line("best possible", &|dim| exact(best_exponent(dim))),
        line("independent draws", &|_| exact(-0.5)),
    ];
    table.extend(study.labels().map(|label| line(label, &|dim| slope(dim, label))));
    page.table(&by_dimension("method", &study.dims), &table);
}

/// What the runs took: a line per method and size, a column per dimension.
fn costs(study: &Accuracy, rows: &Rows<'_>, page: &mut Page) {
    page.heading("Costs");
    let per_particle: Computed = |row| Some(EVALUATIONS(row)? / row.number("particles")?);
    let quantities: [(&str, &dyn Quantity); 3] = [
        ("Wall time of the sampler in seconds, medians over the seeds.", &SECONDS),
        (
            "Evaluations per particle, of the score and of the log density.",
            &per_particle,
        ),
        ("Active nodes in the last step.", &"active_nodes"),
    ];
    for (name, quantity) in quantities {
        let mut table = Vec::new();
        for label in study.labels() {
            for particles in ascending(&study.particles) {
                let here = rows.with("series", label).with("particles", particles);
                let value = |&dim: &Dimension| here.with("dim", dim).median(|row: &Row| quantity.of(row));
                let values: Vec<Option<f64>> = study.dims.iter().map(value).collect();
                if values.iter().flatten().any(|&value| value > 0.0) {
                    let names = [label.to_owned(), particles.to_string()];
                    table.push(
                        names
                            .into_iter()
                            .chain(values.iter().map(Cell::cell))
                            .collect::<Vec<_>>(),
                    );
                }
            }
        }
        if !table.is_empty() {
            page.paragraph(name);
            page.table(&by_dimension("method | M", &study.dims), &table);
        }
    }
}

/// The header of a table whose last columns are the dimensions.
fn by_dimension(first: &str, dims: &[Dimension]) -> Vec<String> {
    let dims = dims.iter().map(|dim| format!("d = {dim}"));
    first.names().into_iter().chain(dims).collect()
}
