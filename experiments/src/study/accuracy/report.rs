//! The report of the study `accuracy`.

use super::figure::{best_exponent, plot};
use super::{Accuracy, expected};
use crate::study::prelude::*;

/// Methods that a figure can tell apart; where there are more, the tables have to do.
const MOST_LINES: usize = 8;

/// Tables and figure.
pub fn report(study: &Accuracy, rows: &Rows<'_>, directory: &StudyDirectory) -> Result<Page, CommandError> {
    let mut page = directory.page(include_str!("report.md"), &[]);
    if study.methods.len() <= MOST_LINES {
        page.heading("Figure");
        page.drawing("accuracy.svg", multiples(&plot(study, rows)));
    }
    page.part("Squared energy distance", &[]);
    for &dim in &study.dims {
        page.paragraph(format!("**d = {dim}**"));
        energy_table(study, &rows.with("dim", dim), &mut page);
    }
    slopes(study, rows, &mut page);
    costs(study, rows, &mut page);
    Ok(rows.close(page))
}

/// A line per method, a column or two per size; of runs in one dimension.
fn energy_table(study: &Accuracy, here: &Rows<'_>, page: &mut Page) {
    let sobol = |entry: &&super::Entry| entry.method.name == MethodName::Sobol;
    let yardstick = study.methods.iter().find(sobol).map(|entry| entry.method.label());
    let runs = |label: &str, size: usize| here.with("series", label).with("particles", size);
    // Over the median ED² of the yardstick's runs, where there is one.
    let relative = |value: Option<f64>, size: usize| {
        let level = |label: &str| runs(label, size).median(ENERGY);
        yardstick.map(|label| value.zip(level(label)).map(|(value, level)| value / level).cell())
    };
    let mut header = vec!["method".to_owned()];
    let mut independent = vec!["i.i.d., expected".to_owned()];
    let sizes = ascending(&study.particles);
    for &size in &sizes {
        header.push(format!("M = {size}"));
        header.extend(yardstick.map(|label| format!("/ {label}")));
        let expected = expected(here, size as f64);
        independent.push(expected.map(|value| 1e3 * value).cell());
        independent.extend(relative(expected, size));
    }
    let mut table = vec![independent];
    for label in study.labels() {
        let mut line = vec![label.to_owned()];
        for &size in &sizes {
            let runs = runs(label, size);
            let cells = runs.cells("median energy_thousandths | largest energy_thousandths");
            line.push(match runs.median(ENERGY) {
                Some(_) => format!("{} ({})", cells[0], cells[1]),
                None => MISSING.to_owned(),
            });
            line.extend(relative(runs.median(ENERGY), size));
        }
        table.push(line);
    }
    page.table(&header, &table);
}

/// A line per method, a column per dimension.
fn slopes(study: &Accuracy, rows: &Rows<'_>, page: &mut Page) {
    page.part("Slopes", &[]);
    let slope = |label: &str, dim: Dimension| {
        let here = rows.with("dim", dim).with("series", label);
        exponent(here.curve(label, "particles", "energy_root").points())
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
    table.extend(study.labels().map(|label| line(label, &|dim| slope(label, dim))));
    page.table(&by_dimension("method", &study.dims), &table);
}

/// What the runs took.
const COSTS: [(&str, &str); 3] = [
    ("Wall time of the sampler in seconds, medians over the seeds.", SECONDS),
    (
        "Evaluations per particle, of the score and of the log density.",
        "evaluations_per_particle",
    ),
    ("Active nodes in the last step.", "active_nodes"),
];

/// A line per method and size, a column per dimension.
fn costs(study: &Accuracy, rows: &Rows<'_>, page: &mut Page) {
    page.heading("Costs");
    for (name, column) in COSTS {
        let mut table = Vec::new();
        for label in study.labels() {
            for size in ascending(&study.particles) {
                let here = rows.with("series", label).with("particles", size);
                let values = study.dims.iter().map(|&dim| here.with("dim", dim).median(column));
                let values: Vec<Option<f64>> = values.collect();
                if values.iter().flatten().any(|&value| value > 0.0) {
                    let names = [label.to_owned(), size.to_string()].into_iter();
                    table.push(names.chain(values.iter().map(Cell::cell)).collect::<Vec<_>>());
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
