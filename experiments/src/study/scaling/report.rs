//! The report of the study `scaling`.

use super::Scaling;
use super::quantity::{NODES, PARTICLES, QUANTITIES, Sweep};
use crate::plots::{ScalingPlot, scaling};
use crate::study::prelude::*;

/// Tables and figures.
pub fn report(study: &Scaling, rows: &Rows<'_>, directory: &StudyDirectory) -> Result<Page, CommandError> {
    let mut page = directory.page(include_str!("report.md"), &[("threads", &"all")]);
    particles_part(study, &rows.with("sweep", PARTICLES.name), &mut page);
    nodes_part(study, &rows.with("sweep", NODES.name), &mut page);
    page.section("All cases", &[], rows.iter());
    Ok(page.with("cases", rows.len()).with("failed", rows.failures().len()))
}

fn particles_part(study: &Scaling, here: &Rows<'_>, page: &mut Page) {
    let sweep = &study.particles_sweep;
    let fit_from = sweep.fit_from.get() as f64;
    page.part("Growth with M and d", &[("work", &number(sweep.largest_work))]);
    exponents(page, here, (&PARTICLES, &sweep.dims), fit_from);
    figures(page, here, (&PARTICLES, &sweep.dims), fit_from);
    let lines = here.lines("particles", sweep.particles.clone());
    page.section("dimension", &[each("d", &sweep.dims)], lines);
}

fn nodes_part(study: &Scaling, here: &Rows<'_>, page: &mut Page) {
    let sweep = &study.nodes_sweep;
    let ([low, high], sizes) = (sweep.interval, ascending(&sweep.nodes_per_axis));
    let most = sizes.last().map_or(0.0, |&most| most as f64);
    let dense = number(most.powi(ascending(&sweep.dims).pop().unwrap_or(0) as i32));
    let width = high - low;
    let values: [(&str, &dyn Display); 4] = [("low", &low), ("high", &high), ("width", &width), ("dense", &dense)];
    page.part("Growth with the nodes per axis k", &values);
    exponents(page, here, (&NODES, &sweep.dims), 0.0);
    page.part("sparse", &[]);
    exponents(page, here, (&NODES, &sweep.dims), sweep.fit_from.get() as f64);
    figures(page, here, (&NODES, &sweep.dims), 0.0);
}

/// A figure per quantity, the time over k beside that of dense grids.
fn figures(page: &mut Page, here: &Rows<'_>, (sweep, dims): (&Sweep, &[Dimension]), from: f64) {
    for (label, name, column) in QUANTITIES {
        let line = |&dim: &Dimension| here.with("dim", dim).line(format!("d = {dim}"), sweep.size, column);
        let series: Vec<LineSeries> = dims.iter().map(line).collect();
        let is_dense = name == "time" && sweep.symbol == NODES.symbol;
        let guide = |(dim, own): (&Dimension, &LineSeries)| dense_guide(dim.get(), own, &series);
        let guides = dims.iter().zip(&series).filter(|_| is_dense);
        let plot = ScalingPlot {
            x_label: sweep.label.to_owned(),
            y_label: label.to_owned(),
            symbol: sweep.symbol.to_owned(),
            from,
            panel: MultiplesPanel {
                guides: guides.filter_map(guide).collect(),
                ..MultiplesPanel::new("", series.clone())
            },
        };
        page.drawing(&format!("{}-{name}.svg", sweep.name), scaling(&plot));
    }
}

/// kᵈ through the first point of that dimension, as far as it stays within a thousand times the measurements.
fn dense_guide(dim: usize, own: &LineSeries, all: &[LineSeries]) -> Option<GuideCurve> {
    let (size, time) = own.points().next()?;
    let most = all.iter().flat_map(|series| &series.y).copied().fold(0.0, f64::max) * 1e3;
    let reach = (size * (most / time).powf(1.0 / dim as f64)).min(*own.x.last()?);
    let power = |place: f64| time * (place / size).powi(dim as i32);
    Some(GuideCurve::bent(
        format!("dense grid, k^{{{dim}}}"),
        (size, reach),
        power,
    ))
}

/// A line per dimension, with the exponents of what is measured.
fn exponents(page: &mut Page, here: &Rows<'_>, (sweep, dims): (&Sweep, &[Dimension]), from: f64) {
    let paper = |dim: &Dimension| if sweep.symbol == "M" { 1 } else { dim.get() };
    let lines = here.lines("dim", dims.iter().copied()).into_iter().zip(dims);
    let lines = lines.map(|(line, dim)| line.with("paper", paper(dim)));
    page.lines_over("exponents", &[each("size", [sweep.size]), each("from", [from])], lines);
}
