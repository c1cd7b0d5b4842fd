//! The figure of the study `catalogue`: what the judged method reaches, target by target, from every start.

use super::requirement::Requirement;
use super::{Catalogue, from_start};
use crate::plots::style::{MARKERS, PALETTE, SeriesStyle};
use crate::plots::{DotPlot, DotRow, DotSeries};
use crate::study::prelude::*;

/// ED² relative to independent draws, a row per target, a marker per start.
pub fn plot(study: &Catalogue, asked: &[(String, Requirement)], rows: &Rows<'_>) -> DotPlot {
    let bounds = asked.iter().map(|(target, asked)| (target.clone(), asked.bound));
    let mut plot = DotPlot::bounded("ED^{2} relative to independent draws", bounds, "requirement");
    let judged = study.judged();
    // Colours tell the means of the start apart, markers its standard deviations.
    let place = |values: &mut Vec<f64>, value: f64| {
        values.iter().position(|known| *known == value).unwrap_or_else(|| {
            values.push(value);
            values.len() - 1
        })
    };
    let (mut means, mut deviations) = (Vec::new(), Vec::new());
    let mut missing = 0;
    let judged_runs = rows.with("method", judged);
    for start in &study.starts {
        let style = SeriesStyle {
            color: PALETTE[place(&mut means, start.mean) % PALETTE.len()],
            marker: MARKERS[place(&mut deviations, start.standard_deviation) % MARKERS.len()],
        };
        let here = from_start(&judged_runs, start);
        let value = |target: &DotRow| {
            let median = here.with("target", target.label.as_str()).median("energy_ratio");
            median.filter(|value| *value > 0.0).unwrap_or(f64::NAN)
        };
        let values: Vec<f64> = plot.rows.iter().map(value).collect();
        missing += values.iter().filter(|value| value.is_nan()).count();
        let label = start.to_string();
        plot.series.push(DotSeries { label, style, values });
    }
    plot.notes
        .push(format!("Method {judged}: medians over the seeds, a marker per start."));
    if missing > 0 {
        let note = format!("Pairs of target and start without a finished run, hence without a marker: {missing}.");
        plot.notes.push(note);
    }
    plot
}
