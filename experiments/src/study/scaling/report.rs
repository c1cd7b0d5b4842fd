//! The report of the study `scaling`.

use super::{NODES, PARTICLES, Scaling, Sweep};
use crate::plots::{ScalingPlot, scaling};
use crate::study::prelude::*;

/// What is measured: label of its axis, with the unit; name of the figure's file, behind that of the sweep; and column.
const QUANTITIES: [(&str, &str, &str); 4] = [
    ("time per step (s)", "time", "wall_seconds_per_step"),
    ("active nodes", "nodes", "active_nodes"),
    ("storage of particles and grid (bytes)", "storage", "storage_bytes"),
    ("rise of the resident memory (bytes)", "memory", "memory_peak_bytes"),
];

/// Tables and figures.
pub fn report(study: &Scaling, rows: &Rows<'_>, directory: &StudyDirectory) -> Result<Page, CommandError> {
    let mut page = directory.page(include_str!("report.md"), &[("threads", &"all")]);
    let (sweep, here) = (&study.particles_sweep, rows.with("sweep", PARTICLES[0]));
    let grown = (PARTICLES, &sweep.dims[..]);
    let fit_from = sweep.fit_from.get() as f64;
    page.part("Growth with M and d", &[("work", &number(sweep.largest_work))]);
    exponents(&mut page, &here, grown, fit_from);
    figures(&mut page, &here, grown, fit_from);
    let lines = here.lines("particles", sweep.particles.clone());
    page.section("dimension", &[each("d", &sweep.dims)], lines);

    let (sweep, here) = (&study.nodes_sweep, rows.with("sweep", NODES[0]));
    let (grown, [low, high]) = ((NODES, &sweep.dims[..]), sweep.interval);
    let most = ascending(&sweep.nodes_per_axis).pop().unwrap_or(0) as f64;
    let dense = number(most.powi(ascending(&sweep.dims).pop().unwrap_or(0) as i32));
    let width = high - low;
    let values: [(&str, &dyn Display); 4] = [("low", &low), ("high", &high), ("width", &width), ("dense", &dense)];
    page.part("Growth with the nodes per axis k", &values);
    exponents(&mut page, &here, grown, 0.0);
    page.part("sparse", &[]);
    exponents(&mut page, &here, grown, sweep.fit_from.get() as f64);
    figures(&mut page, &here, grown, 0.0);
    page.section("All cases", &[], rows.iter());
    Ok(page.with("cases", rows.len()).with("failed", rows.failures().len()))
}

/// A figure per quantity, the time over k beside that of dense grids, kᵈ, as far as it stays within a thousand times the measurements.
fn figures(page: &mut Page, here: &Rows<'_>, (sweep, dims): (Sweep, &[Dimension]), from: f64) {
    let [name, size, symbol, x_label] = sweep;
    for (y_label, quantity, column) in QUANTITIES {
        let series = here.curves(("d = ", "dim"), dims.to_vec(), size, column);
        let mut plot = ScalingPlot::over((x_label, symbol), y_label, series, from);
        if quantity == "time" && sweep == NODES {
            let powers = dims
                .iter()
                .map(|dim| (format!("dense grid, k^{{{dim}}}"), dim.get() as i32));
            plot = plot.beside_powers(powers, 1e3);
        }
        page.drawing(&format!("{name}-{quantity}.svg"), scaling(&plot));
    }
}

/// A line per dimension, with the exponents of what is measured.
fn exponents(page: &mut Page, here: &Rows<'_>, (sweep, dims): (Sweep, &[Dimension]), from: f64) {
    let paper = |dim: &Dimension| if sweep == PARTICLES { 1 } else { dim.get() };
    let lines = here.lines("dim", dims.iter().copied()).into_iter().zip(dims);
    let lines = lines.map(|(line, dim)| line.with("paper", paper(dim)));
    page.lines_over("exponents", &[each("size", [sweep[1]]), each("from", [from])], lines);
}
