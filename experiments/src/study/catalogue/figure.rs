//! The figure of the study `catalogue`: what the judged method reaches, target by target, from every start.

use super::Catalogue;
use super::requirement::Requirement;
use crate::plots::DotPlot;
use crate::study::prelude::*;
use crate::study::start_law::StartLaw;

/// ED² relative to independent draws, a row per target, a marker per start.
pub fn plot(study: &Catalogue, asked: &[(String, Requirement)], rows: &Rows<'_>) -> DotPlot {
    let judged = rows.with("method", study.judged());
    // Colours tell the means of the start apart, markers its standard deviations.
    let series = |start: &StartLaw| {
        let here = start.runs(&judged);
        let value = |(target, _): &(String, Requirement)| {
            let median = here.with("target", target.as_str()).median("energy_ratio");
            median.filter(|value| *value > 0.0).unwrap_or(f64::NAN)
        };
        let values = asked.iter().map(value).collect();
        (start.to_string(), [start.mean, start.standard_deviation], values)
    };
    let bounds = asked.iter().map(|(target, asked)| (target.clone(), asked.bound));
    let plot = DotPlot::bounded("ED^{2} relative to independent draws", bounds, "requirement");
    let plot = plot.with_crossed(study.starts.iter().map(series).collect());
    let note = format!("Method {}: medians over the seeds, a marker per start.", study.judged());
    let plot = plot.with_note(note);
    match plot.missing() {
        0 => plot,
        missing => plot.with_note(format!(
            "Pairs of target and start without a finished run, hence without a marker: {missing}."
        )),
    }
}
