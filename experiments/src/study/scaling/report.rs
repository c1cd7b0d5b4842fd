//! The report of the study `scaling`.

use std::fmt::Display;

use super::Scaling;
use super::quantity::{NODES, PARTICLES, QUANTITIES, Sweep};
use crate::plots::{Fit, ScalingPlot, scaling};
use crate::study::prelude::*;

/// Tables and figures.
pub fn report(study: &Scaling, rows: &Rows<'_>, directory: &StudyDirectory) -> Result<Page, CommandError> {
    let mut page = directory.page(include_str!("report.md"), &[("threads", &"all")]);
    particles_part(study, rows, &mut page);
    nodes_part(study, rows, &mut page);
    page.part("All cases", &[]);
    let line = |row| Line::from(row).with("ending", RunRow::ending(row));
    page.lines("All cases", rows.iter().map(line));
    Ok(page.with("cases", rows.len()).with("failed", rows.failures().len()))
}

fn particles_part(study: &Scaling, rows: &Rows<'_>, page: &mut Page) {
    let sweep = &study.particles_sweep;
    let fit_from = sweep.fit_from.get() as f64;
    page.part("Growth with M and d", &[("work", &number(sweep.largest_work))]);
    exponents(page, rows, (&PARTICLES, &sweep.dims), fit_from);
    for quantity in QUANTITIES {
        let plot = plot(quantity, rows, (&PARTICLES, &sweep.dims), fit_from);
        page.drawing(&format!("particles-{}.svg", quantity.1), scaling(&plot));
    }
    page.part("dimension", &[]);
    let here = rows.with("sweep", PARTICLES.name);
    let lines = here.lines("particles", sweep.particles.clone());
    page.lines_over("dimension", &[each("d", &sweep.dims)], lines);
}

fn nodes_part(study: &Scaling, rows: &Rows<'_>, page: &mut Page) {
    let sweep = &study.nodes_sweep;
    let [low, high] = sweep.interval;
    let most = ascending(&sweep.nodes_per_axis).pop().unwrap_or(0) as f64;
    let dense = number(most.powi(ascending(&sweep.dims).pop().unwrap_or(0) as i32));
    let width = high - low;
    let values: [(&str, &dyn Display); 4] = [("low", &low), ("high", &high), ("width", &width), ("dense", &dense)];
    page.part("Growth with the nodes per axis k", &values);
    exponents(page, rows, (&NODES, &sweep.dims), 0.0);
    page.part("sparse", &[]);
    exponents(page, rows, (&NODES, &sweep.dims), sweep.fit_from.get() as f64);
    for quantity in QUANTITIES {
        let mut plot = plot(quantity, rows, (&NODES, &sweep.dims), 0.0);
        if quantity.1 == "time" {
            let guides = sweep.dims.iter().filter_map(|dim| dense_guide(&plot, dim.get()));
            plot.panel.guides = guides.collect();
        }
        page.drawing(&format!("nodes-{}.svg", quantity.1), scaling(&plot));
    }
}

/// kᵈ through the first point of that dimension, as far as it stays within a thousand times the measurements.
fn dense_guide(plot: &ScalingPlot, dim: usize) -> Option<GuideCurve> {
    let lines = plot.panel.series.iter();
    let series = lines.clone().find(|series| series.label == format!("d = {dim}"))?;
    let (&first_size, &first_time) = (series.x.first()?, series.y.first()?);
    let most = lines.fold(0.0, |most, series| series.y.iter().copied().fold(most, f64::max)) * 1e3;
    let power = |size: f64| first_time * (size / first_size).powi(dim as i32);
    let reach = (first_size * (most / first_time).powf(1.0 / dim as f64)).min(*series.x.last()?);
    let place = |i: i32| first_size * (reach / first_size).powf(f64::from(i) / 20.0);
    let x: Vec<f64> = (0..=20).map(place).collect();
    let y = x.iter().map(|&size| power(size)).collect();
    Some(GuideCurve {
        label: format!("dense grid, k^{{{dim}}}"),
        curve: Curve { x, y },
        dotted: false,
    })
}

fn plot(
    (axis, _, column): (&str, &str, &str),
    rows: &Rows<'_>,
    (sweep, dims): (&Sweep, &[Dimension]),
    fit_from: f64,
) -> ScalingPlot {
    let here = rows.with("sweep", sweep.name);
    let line = |&dim: &Dimension| here.with("dim", dim).line(format!("d = {dim}"), sweep.size, column);
    ScalingPlot {
        x_label: sweep.label.to_owned(),
        y_label: axis.to_owned(),
        fit: Fit {
            symbol: sweep.symbol.to_owned(),
            from: fit_from,
        },
        panel: MultiplesPanel::new("", dims.iter().map(line)),
    }
}

/// A line per dimension, with the exponents of what is measured.
fn exponents(page: &mut Page, rows: &Rows<'_>, (sweep, dims): (&Sweep, &[Dimension]), fit_from: f64) {
    let lines = rows.with("sweep", sweep.name).lines("dim", dims.iter().copied());
    let lines = lines.into_iter().zip(dims).map(|(line, dim)| {
        let paper = if sweep.symbol == "M" { 1 } else { dim.get() };
        line.with("paper", paper)
    });
    let fit = [each("size", [sweep.size]), each("from", [fit_from])];
    page.lines_over("exponents", &fit, lines);
}
