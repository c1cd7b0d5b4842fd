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

/// A line per method.
fn lines<'a>(study: &Accuracy, rows: &Rows<'a>) -> Vec<Line<'a>> {
    rows.lines("series", MethodSpecification::labels(&study.methods))
}

/// A column or two per size; of runs in one dimension.
fn energy_table(study: &Accuracy, here: &Rows<'_>, page: &mut Page) {
    let sobol = study.methods.iter().find(|method| method.name == MethodName::Sobol);
    let yardstick = sobol.map(MethodSpecification::label);
    let sizes = ascending(&study.particles);
    let of_runs = |runs: &Rows<'_>, size: usize| runs.with("particles", size).median(ENERGY);
    // ED² of a size over the median of the yardstick's runs, where there is one.
    let ratio = |size: usize, energy: Option<f64>| {
        let level = of_runs(&here.with("series", yardstick), size);
        let ratio = energy.zip(level).map(|(value, level)| value / level);
        (format!("ratio {size}"), ratio)
    };
    let mut independent = Line::default().with("series", "i.i.d., expected");
    for &size in &sizes {
        let energy = expected(here, size as f64);
        let place = format!("median energy_thousandths where particles = {size}");
        independent = independent.with(place, energy.map(|value| 1e3 * value));
        independent = independent.with_all([ratio(size, energy)]);
    }
    let of_methods = lines(study, here).into_iter().map(|line| {
        let ratios = sizes.iter().map(|&size| ratio(size, of_runs(&line.rows, size)));
        line.clone().with_all(ratios)
    });
    let lines = [independent].into_iter().chain(of_methods);
    let repeated = [each("yardstick", yardstick), each("M", &sizes)];
    page.lines_over("Squared energy distance", &repeated, lines);
}

/// The exponent in a dimension.
type Exponent = fn(Dimension) -> f64;

/// A column per dimension, with what is known exactly above.
fn slopes(study: &Accuracy, rows: &Rows<'_>, page: &mut Page) {
    let exact: [(&str, Exponent); 2] = [("best possible", best_exponent), ("independent draws", |_| -0.5)];
    let exact = exact.map(|(name, slope)| {
        let cell = |&dim: &Dimension| {
            let place = format!("exponent of particles in energy_root where dim = {dim}");
            (place, number(slope(dim)).replace('-', "−"))
        };
        let line = Line::default().with("series", name);
        line.with_all(study.dims.iter().map(cell))
    });
    let lines = exact.into_iter().chain(lines(study, rows));
    page.section("Slopes", &[each("d", &study.dims)], lines);
}

/// A line per method and size that has taken something, a column per dimension.
fn costs(study: &Accuracy, rows: &Rows<'_>, page: &mut Page) {
    page.part("Costs", &[]);
    for (part, column) in [
        ("time", SECONDS),
        ("evaluations", "evaluations_per_particle"),
        ("nodes", "active_nodes"),
    ] {
        let labels = MethodSpecification::labels(&study.methods);
        let mut lines = rows.lines_by(("series", labels), ("particles", ascending(&study.particles)));
        lines.retain(|line| line.rows.largest(column) > Some(0.0));
        if !lines.is_empty() {
            page.section(part, &[each("d", &study.dims)], lines);
        }
    }
}
