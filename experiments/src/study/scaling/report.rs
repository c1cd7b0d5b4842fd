//! The report of the study `scaling`.

use std::fmt::Display;

use super::Scaling;
use super::quantity::{Measured, NODES, PARTICLES, QUANTITIES, Sweep, TIME};
use crate::plots::{ScalingPlot, scaling};
use crate::study::prelude::*;

/// Tables and figures.
pub fn report(study: &Scaling, rows: &Rows<'_>, directory: &StudyDirectory) -> Result<Page, CommandError> {
    let mut page = directory.page(include_str!("report.md"), &[("threads", &"all")]);
    particles_part(study, rows, &mut page);
    nodes_part(study, rows, &mut page);
    all_rows(rows, &mut page);

    Ok(page.with("cases", rows.len()).with("failed", rows.failures().len()))
}

fn particles_part(study: &Scaling, rows: &Rows<'_>, page: &mut Page) {
    let sweep = &study.particles_sweep;
    let fit_from = sweep.fit_from.get() as f64;
    page.part("Growth with M and d", &[("work", &number(sweep.largest_work))]);
    exponent_table(page, rows, &PARTICLES, &sweep.dims, fit_from);
    for (quantity, file) in drawn() {
        let plot = plot(quantity, rows, &PARTICLES, &sweep.dims, fit_from);
        let caption = format!("{} against the number of particles.", capitalised(quantity.name));
        page.figure(&format!("particles-{file}.svg"), &caption, scaling(&plot));
    }
    growth_with_dimension(study, rows, page);
}

/// Time per particle and step, by dimension, and its powers of d and of 3ᵈ.
fn growth_with_dimension(study: &Scaling, rows: &Rows<'_>, page: &mut Page) {
    let sweep = &study.particles_sweep;
    let time = |dim: usize, particles: usize| {
        let here = rows.with("sweep", PARTICLES.name).with("dim", dim);
        let row = here.with("particles", particles).first()?;
        Some(row.number(TIME)? / particles as f64 * 1e9)
    };
    page.paragraph(
        "Nanoseconds per particle and step, and the exponents b in d^b and (3ᵈ)^b: a particle touches d + 1 nodes of a simplex \
         lattice and 3ᵈ with quadratic B-splines. The paper's estimate grows as kᵈ d².",
    );
    let dims: Vec<usize> = sweep.dims.iter().map(|dim| dim.get()).collect();
    let mut header = vec!["M".to_owned()];
    header.extend(dims.iter().map(|dim| format!("d = {dim}")));
    header.extend("exponent of d | exponent of 3ᵈ".names());
    let mut table = Vec::new();
    for particles in sweep.particles.iter().map(|count| count.get()) {
        let times: Vec<Option<f64>> = dims.iter().map(|&dim| time(dim, particles)).collect();
        let growth = |size: fn(usize) -> f64| {
            let known = dims.iter().zip(&times);
            exponent(known.filter_map(|(&dim, time)| Some((size(dim), (*time)?))))
        };
        let mut line = vec![particles.to_string()];
        line.extend(times.iter().map(Cell::cell));
        line.extend([growth(|dim| dim as f64), growth(|dim| 3f64.powi(dim as i32))]);
        table.push(line);
    }
    page.table(&header, &table);
}

fn nodes_part(study: &Scaling, rows: &Rows<'_>, page: &mut Page) {
    let sweep = &study.nodes_sweep;
    let [low, high] = sweep.interval;
    let (width, dense) = (high - low, largest_dense_grid(study));
    let values: [(&str, &dyn Display); 4] = [("low", &low), ("high", &high), ("width", &width), ("dense", &dense)];
    page.part("Growth with the nodes per axis k", &values);
    exponent_table(page, rows, &NODES, &sweep.dims, 0.0);
    page.part("sparse", &[]);
    exponent_table(page, rows, &NODES, &sweep.dims, sweep.fit_from.get() as f64);
    for (quantity, file) in drawn() {
        let mut plot = plot(quantity, rows, &NODES, &sweep.dims, 0.0);
        if file == "time" {
            let guides = sweep.dims.iter().filter_map(|dim| dense_guide(&plot, dim.get()));
            plot.guides = guides.collect();
        }
        let caption = format!("{} against the nodes per axis, at fixed M.", capitalised(quantity.name));
        page.figure(&format!("nodes-{file}.svg"), &caption, scaling(&plot));
    }
}

fn largest_dense_grid(study: &Scaling) -> String {
    let sweep = &study.nodes_sweep;
    let nodes = sweep.nodes_per_axis.iter().map(|nodes| nodes.get()).max().unwrap_or(0) as f64;
    let dim = sweep.dims.iter().map(|dim| dim.get()).max().unwrap_or(0);
    number(nodes.powi(dim as i32))
}

/// kᵈ through the first point of that dimension, as far as it stays within a thousand times the measurements.
fn dense_guide(plot: &ScalingPlot, dim: usize) -> Option<GuideCurve> {
    let series = plot.series.iter().find(|series| series.label == format!("d = {dim}"))?;
    let (&first_size, &first_time) = (series.x.first()?, series.y.first()?);
    let &last_size = series.x.last()?;
    let times = plot.series.iter().flat_map(|series| &series.y);
    let most = 1e3 * times.fold(0.0, |most: f64, &y| most.max(y));
    let power = |size: f64| first_time * (size / first_size).powi(dim as i32);
    let reach = (first_size * (most / first_time).powf(1.0 / dim as f64)).min(last_size);
    let place = |i: i32| first_size * (reach / first_size).powf(f64::from(i) / 20.0);
    let x: Vec<f64> = (0..=20).map(place).collect();
    let y = x.iter().map(|&size| power(size)).collect();
    Some(GuideCurve {
        label: format!("dense grid, k^{{{dim}}}"),
        curve: Curve { x, y },
        dotted: false,
    })
}

/// The quantities that have a figure.
fn drawn() -> impl Iterator<Item = (&'static Measured, &'static str)> {
    let named = QUANTITIES.iter().map(|quantity| Some((quantity, quantity.file?)));
    named.flatten()
}

fn plot(quantity: &Measured, rows: &Rows<'_>, sweep: &Sweep, dims: &[Dimension], fit_from: f64) -> ScalingPlot {
    ScalingPlot {
        x_label: sweep.label.to_owned(),
        y_label: quantity.axis.to_owned(),
        x_symbol: sweep.symbol.to_owned(),
        fit_from,
        series: dims.iter().map(|&dim| quantity.series(rows, sweep, dim)).collect(),
        ..ScalingPlot::default()
    }
}

fn exponent_table(page: &mut Page, rows: &Rows<'_>, sweep: &Sweep, dims: &[Dimension], fit_from: f64) {
    let names = QUANTITIES.iter().map(|quantity| quantity.name);
    let header: Vec<&str> = ["d"].into_iter().chain(names).chain(["paper, dense grid"]).collect();
    let line = |&dim: &Dimension| {
        let exponents = QUANTITIES
            .iter()
            .map(|quantity| quantity.exponent(rows, sweep, dim, fit_from));
        let paper = match sweep.symbol {
            "M" => "1".to_owned(),
            _ => dim.to_string(),
        };
        let cells = [dim.to_string()].into_iter().chain(exponents).chain([paper]);
        cells.collect::<Vec<_>>()
    };
    page.table(&header, dims.iter().map(line));
}

fn all_rows(rows: &Rows<'_>, page: &mut Page) {
    page.heading("All cases");
    let line = |row: &Row| {
        let columns =
            "spacing | active_nodes | score_evaluations | storage_bytes | memory_peak_bytes | wall_seconds_per_step";
        [line(&[&row.case(), &row.ending()]), row.cells(columns)].concat()
    };
    let header =
        "case | status | h | active nodes | scores | storage (bytes) | peak memory (bytes) | time per step (s)";
    page.table(header, rows.iter().map(line));
}

fn capitalised(text: &str) -> String {
    let (first, rest) = text.split_at(1);
    first.to_uppercase() + rest
}
