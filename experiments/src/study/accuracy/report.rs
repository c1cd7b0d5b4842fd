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
    let sizes = ascending(&study.particles);
    // ED² of each size over the median of the yardstick's runs, where there is one.
    let ratios = |energy: &dyn Fn(usize) -> Option<f64>| {
        let ratio = |&size: &usize| {
            let level = here.with("series", yardstick).with("particles", size).median(ENERGY);
            let ratio = energy(size).zip(level).map(|(value, level)| value / level);
            (format!("ratio {size}"), ratio)
        };
        sizes.iter().map(ratio).collect::<Vec<_>>()
    };
    let expected = |size: usize| expected(here, size as f64);
    let energies = sizes.iter().map(|&size| {
        let place = format!("median energy_thousandths where particles = {size}");
        (place, expected(size).map(|value| 1e3 * value))
    });
    let independent = Line::default().with("series", "i.i.d., expected").with_all(energies);
    let mut lines = vec![independent.with_all(ratios(&expected))];
    for line in here.lines("series", study.labels()) {
        let energy = |size: usize| line.rows.with("particles", size).median(ENERGY);
        lines.push(line.clone().with_all(ratios(&energy)));
    }
    let repeated = [each("yardstick", yardstick), each("M", &sizes)];
    page.lines_over("Squared energy distance", &repeated, lines);
}

/// A line per method, a column per dimension.
fn slopes(study: &Accuracy, rows: &Rows<'_>, page: &mut Page) {
    page.part("Slopes", &[]);
    let exact = |name: &str, slope: &dyn Fn(Dimension) -> f64| {
        let place = |dim: &Dimension| format!("exponent of particles in energy_root where dim = {dim}");
        let slope = |dim: &Dimension| (place(dim), number(slope(*dim)).replace('-', "−"));
        Line::default()
            .with("series", name)
            .with_all(study.dims.iter().map(slope))
    };
    let mut lines = vec![
        exact("best possible", &best_exponent),
        exact("independent draws", &|_| -0.5),
    ];
    lines.extend(rows.lines("series", study.labels()));
    page.lines_over("Slopes", &[each("d", &study.dims)], lines);
}

/// A line per method and size that has taken something, a column per dimension.
fn costs(study: &Accuracy, rows: &Rows<'_>, page: &mut Page) {
    page.part("Costs", &[]);
    for (part, column) in [
        ("time", SECONDS),
        ("evaluations", "evaluations_per_particle"),
        ("nodes", "active_nodes"),
    ] {
        let lines = rows.lines("series", study.labels()).into_iter();
        let lines = lines.flat_map(|line| line.by("particles", ascending(&study.particles)));
        let in_some_dimension = |line: &Line<'_>| {
            let of_dim = |dim: &Dimension| line.rows.with("dim", *dim).median(column);
            study.dims.iter().filter_map(of_dim).any(|cost| cost > 0.0)
        };
        let lines: Vec<Line<'_>> = lines.filter(in_some_dimension).collect();
        if !lines.is_empty() {
            page.part(part, &[]);
            page.lines_over(part, &[each("d", &study.dims)], lines);
        }
    }
}
