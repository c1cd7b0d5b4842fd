//! The report of the study `accuracy`.

use super::figure::{best_exponent, plot};
use super::{Accuracy, expected, runs};
use crate::options::{Dimension, MethodName};
use crate::plots::multiples;
use crate::plots::page::{Cell, MISSING, Page, exponent, number};
use crate::study::checks::ascending;
use crate::study::definition::Report;
use crate::study::run_row::{
    ENERGY, ENERGY_ROOT, EVALUATIONS, Quantity, RunRow, SECONDS, median, report_of_runs, values,
};

/// Methods that a figure can tell apart; where there are more, the tables have to do.
const MOST_LINES: usize = 8;

/// Tables and figure.
pub fn report(study: &Accuracy, rows: &[RunRow]) -> Report {
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
    report_of_runs(page, rows)
}

/// A line per method, a column or two per size.
fn energy_table(study: &Accuracy, rows: &[RunRow], dim: Dimension, page: &mut Page) {
    let sobol = |entry: &&super::Entry| entry.method.name == MethodName::Sobol;
    let yardstick = study.methods.iter().find(sobol).map(|entry| entry.method.label());
    // Over the median ED² of the yardstick's runs, where there is one.
    let relative = |value: Option<f64>, particles: usize| {
        let ratio = |label: &str| Some(value? / median(&runs(rows, dim, particles, label), ENERGY)?);
        yardstick.map(|label| ratio(label).cell())
    };
    let counts = ascending(&study.particles);
    let mut header = vec!["method".to_owned()];
    let mut independent = vec!["i.i.d., expected".to_owned()];
    for &particles in &counts {
        header.push(format!("M = {particles}"));
        header.extend(yardstick.map(|label| format!("/ {label}")));
        let expected = expected(rows, dim, particles as f64);
        independent.push(expected.map(|value| 1e3 * value).cell());
        independent.extend(relative(expected, particles));
    }
    let mut table = vec![independent];
    for entry in &study.methods {
        let mut line = vec![entry.method.label().to_owned()];
        for &particles in &counts {
            let here = runs(rows, dim, particles, entry.method.label());
            let middle = median(&here, ENERGY);
            line.push(match (middle, values(&here, ENERGY).into_iter().reduce(f64::max)) {
                (Some(middle), Some(most)) => format!("{} ({})", number(1e3 * middle), number(1e3 * most)),
                _ => MISSING.to_owned(),
            });
            line.extend(relative(middle, particles));
        }
        table.push(line);
    }
    page.table(&header, &table);
}

/// A line per method, a column per dimension.
fn slopes(study: &Accuracy, rows: &[RunRow], page: &mut Page) {
    page.heading("Slopes");
    page.paragraph(
        "Exponents b of ED ∝ M^b: least squares in logarithms over the medians, with 95 % confidence intervals. No M points \
         can do better than the order M^(−(1 + 1/d)/2) of optimally spread ones; independent draws have −1/2.",
    );
    let slope = |dim: Dimension, label: &str| {
        exponent(ascending(&study.particles).into_iter().filter_map(|particles| {
            let error = median(&runs(rows, dim, particles, label), ENERGY_ROOT)?;
            Some((particles as f64, error))
        }))
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
    for entry in &study.methods {
        let label = entry.method.label();
        table.push(line(label, &|dim| slope(dim, label)));
    }
    page.table(&by_dimension(&["method"], &study.dims), &table);
}

/// What the runs took: a line per method and size, a column per dimension.
fn costs(study: &Accuracy, rows: &[RunRow], page: &mut Page) {
    page.heading("Costs");
    let quantities: [(&str, Quantity); 3] = [
        ("Wall time of the sampler in seconds, medians over the seeds.", SECONDS),
        (
            "Evaluations per particle, of the score and of the log density.",
            |row| Some(EVALUATIONS(row)? / row.particles as f64),
        ),
        ("Active nodes in the last step.", |row| {
            row.active_nodes.map(|count| count as f64)
        }),
    ];
    for (name, quantity) in quantities {
        let mut table = Vec::new();
        for entry in &study.methods {
            for particles in ascending(&study.particles) {
                let value = |&dim: &Dimension| median(&runs(rows, dim, particles, entry.method.label()), quantity);
                let values: Vec<Option<f64>> = study.dims.iter().map(value).collect();
                if values.iter().flatten().any(|&value| value > 0.0) {
                    let mut line = vec![entry.method.label().to_owned(), particles.to_string()];
                    line.extend(values.iter().map(Cell::cell));
                    table.push(line);
                }
            }
        }
        if !table.is_empty() {
            page.paragraph(name);
            page.table(&by_dimension(&["method", "M"], &study.dims), &table);
        }
    }
}

/// The header of a table whose last columns are the dimensions.
fn by_dimension(first: &[&str], dims: &[Dimension]) -> Vec<String> {
    let dims = dims.iter().map(|dim| format!("d = {dim}"));
    first.iter().map(|name| (*name).to_owned()).chain(dims).collect()
}
