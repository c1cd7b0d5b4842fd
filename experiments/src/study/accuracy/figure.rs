//! The figure of the study `accuracy`.

use super::configuration::Accuracy;
use crate::options::Dimension;
use crate::plots::{AxisKind, Curve, GuideCurve, LineSeries, MultiplesPanel, MultiplesPlot};
use crate::statistics::summarize;
use crate::study::gaussian_runs::{ENERGY_ROOT, Row, values};

/// The energy distance against M, one panel per dimension.
pub fn plot(study: &Accuracy, rows: &[Row]) -> MultiplesPlot {
    MultiplesPlot {
        title: String::new(),
        x_label: "number of particles M".to_owned(),
        y_label: "energy distance ED (standard deviations^{½})".to_owned(),
        x_axis: AxisKind::Logarithmic,
        y_axis: AxisKind::Logarithmic,
        panels: study
            .dims
            .iter()
            .map(|&dim| panel(study, rows, dim))
            .filter(|panel| !panel.series.is_empty())
            .collect(),
        notes: vec!["Medians over the seeds; bars from the smallest to the largest.".to_owned()],
    }
}

/// The exponent of the best possible energy distance of M points in d dimensions.
pub fn best_exponent(dim: Dimension) -> f64 {
    -0.5 * (1.0 + 1.0 / dim.get() as f64)
}

fn panel(study: &Accuracy, rows: &[Row], dim: Dimension) -> MultiplesPanel {
    let series: Vec<LineSeries> = study
        .methods
        .iter()
        .map(|entry| line(study, rows, dim, entry.method.label()))
        .filter(|line| !line.x.is_empty())
        .collect();
    MultiplesPanel {
        title: format!("d = {dim}"),
        guides: guides(rows, dim, &series),
        series,
        levels: Vec::new(),
    }
}

/// The medians of one method.
fn line(study: &Accuracy, rows: &[Row], dim: Dimension, label: &str) -> LineSeries {
    let mut line = LineSeries {
        label: label.to_owned(),
        ..LineSeries::default()
    };
    let mut counts: Vec<usize> = study.particles.iter().map(|count| count.get()).collect();
    counts.sort_unstable();
    for particles in counts {
        let here = |row: &&Row| row.dim == dim.get() && row.particles == particles && row.series == label;
        let runs: Vec<&Row> = rows.iter().filter(here).collect();
        if let Ok(summary) = summarize(&values(&runs, ENERGY_ROOT)) {
            line.x.push(particles as f64);
            line.y.push(summary.median);
            line.bars.push((summary.minimum, summary.maximum));
        }
    }
    line
}

/// The expectation of independent draws, and the best possible slope a little below the lowest first point.
fn guides(rows: &[Row], dim: Dimension, series: &[LineSeries]) -> Vec<GuideCurve> {
    let abscissas = || series.iter().flat_map(|line| line.x.iter().copied());
    let (first, last) = (
        abscissas().fold(f64::INFINITY, f64::min),
        abscissas().fold(0.0, f64::max),
    );
    let lowest = series
        .iter()
        .flat_map(|line| line.x.iter().zip(&line.y))
        .filter(|(x, _)| **x == first)
        .fold(f64::INFINITY, |least, (_, y)| least.min(*y));
    let independent = rows
        .iter()
        .find(|row| row.dim == dim.get())
        .map_or(f64::NAN, |row| (row.energy_level * row.particles as f64 / first).sqrt());
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
