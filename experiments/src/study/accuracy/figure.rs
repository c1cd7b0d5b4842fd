//! The figure of the study `accuracy`.

use super::{Accuracy, expected};
use crate::study::prelude::*;

/// The energy distance against M, one panel per dimension.
pub fn plot(study: &Accuracy, rows: &Rows<'_>) -> MultiplesPlot {
    let panels = study.dims.iter().map(|&dim| panel(study, &rows.with("dim", dim), dim));
    MultiplesPlot::logarithmic("number of particles M", "energy distance ED (standard deviations^{½})")
        .with_panels(panels.filter(|panel| !panel.series.is_empty()))
        .with_note("Medians over the seeds; bars from the smallest to the largest.")
}

/// The exponent of the best possible energy distance of M points in d dimensions.
pub fn best_exponent(dim: Dimension) -> f64 {
    -0.5 * (1.0 + 1.0 / dim.get() as f64)
}

fn panel(study: &Accuracy, here: &Rows<'_>, dim: Dimension) -> MultiplesPanel {
    let labels = MethodSpecification::labels(&study.methods);
    let mut series = here.curves(("", "series"), labels, "particles", "energy_root");
    series.retain(|line| !line.x.is_empty());
    MultiplesPanel {
        guides: guides(here, dim, &series),
        ..MultiplesPanel::new(format!("d = {dim}"), series)
    }
}

/// The expectation of independent draws, and the best possible slope a little below the lowest first point.
fn guides(here: &Rows<'_>, dim: Dimension, series: &[LineSeries]) -> Vec<GuideCurve> {
    let points = || series.iter().flat_map(LineSeries::points);
    let first = points().map(|(x, _)| x).fold(f64::INFINITY, f64::min);
    let last = points().map(|(x, _)| x).fold(0.0, f64::max);
    let at_first = points().filter(|(x, _)| *x == first);
    let lowest = at_first.fold(f64::INFINITY, |least, (_, y)| least.min(y));
    let independent = expected(here, first).map_or(f64::NAN, f64::sqrt);
    let guide = |label: &str, start: f64, exponent: f64, dotted: bool| {
        GuideCurve::through(label, (first, last), dotted, |x| start * (x / first).powf(exponent))
    };
    vec![
        guide("i.i.d. expected, slope −1/2", independent, -0.5, false),
        guide("best slope −(1 + 1/d)/2", 0.7 * lowest, best_exponent(dim), true),
    ]
}
