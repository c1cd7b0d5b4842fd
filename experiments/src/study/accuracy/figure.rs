//! The figure of the study `accuracy`.

use super::{Accuracy, expected, runs};
use crate::options::Dimension;
use crate::plots::{Curve, GuideCurve, LineSeries, MultiplesPanel, MultiplesPlot};
use crate::study::checks::ascending;
use crate::study::run_row::{ENERGY_ROOT, RunRow, curve};

/// The energy distance against M, one panel per dimension.
pub fn plot(study: &Accuracy, rows: &[RunRow]) -> MultiplesPlot {
    let panels = study.dims.iter().map(|&dim| panel(study, rows, dim));
    MultiplesPlot {
        panels: panels.filter(|panel| !panel.series.is_empty()).collect(),
        notes: vec!["Medians over the seeds; bars from the smallest to the largest.".to_owned()],
        ..MultiplesPlot::logarithmic("number of particles M", "energy distance ED (standard deviations^{½})")
    }
}

/// The exponent of the best possible energy distance of M points in d dimensions.
pub fn best_exponent(dim: Dimension) -> f64 {
    -0.5 * (1.0 + 1.0 / dim.get() as f64)
}

fn panel(study: &Accuracy, rows: &[RunRow], dim: Dimension) -> MultiplesPanel {
    let line = |label: &str| {
        let counts = ascending(&study.particles).into_iter();
        let points = counts.map(|count| (count as f64, runs(rows, dim, count, label)));
        curve(label, points, ENERGY_ROOT)
    };
    let series = study.methods.iter().map(|entry| line(entry.method.label()));
    let series: Vec<LineSeries> = series.filter(|line| !line.x.is_empty()).collect();
    MultiplesPanel {
        title: format!("d = {dim}"),
        guides: guides(rows, dim, &series),
        series,
        levels: Vec::new(),
    }
}

/// The expectation of independent draws, and the best possible slope a little below the lowest first point.
fn guides(rows: &[RunRow], dim: Dimension, series: &[LineSeries]) -> Vec<GuideCurve> {
    let abscissas = || series.iter().flat_map(|line| line.x.iter().copied());
    let (first, last) = (
        abscissas().fold(f64::INFINITY, f64::min),
        abscissas().fold(0.0, f64::max),
    );
    let points = series.iter().flat_map(|line| line.x.iter().zip(&line.y));
    let lowest = points
        .filter(|(x, _)| **x == first)
        .fold(f64::INFINITY, |least, (_, y)| least.min(*y));
    let independent = expected(rows, dim, first).map_or(f64::NAN, f64::sqrt);
    let guide = |label: &str, start: f64, exponent: f64, dotted: bool| GuideCurve {
        label: label.to_owned(),
        curve: Curve {
            x: vec![first, last],
            y: vec![start, start * (last / first).powf(exponent)],
        },
        dotted,
    };
    vec![
        guide("i.i.d. expected, slope −1/2", independent, -0.5, false),
        guide("best slope −(1 + 1/d)/2", 0.7 * lowest, best_exponent(dim), true),
    ]
}
