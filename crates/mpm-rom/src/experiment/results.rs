//! What reduced runs gave, as tables.

use std::fmt::Write;

use super::{SampleCount, SuperResolved};

/// A reduced run beside the full-order run of the same case.
#[derive(Clone, Debug, PartialEq)]
pub struct ReducedRow {
    /// Number of the test case, counted from 0.
    pub case: usize,
    /// Values of its parameters.
    pub parameters: Vec<f64>,
    /// The family of maps.
    pub manifold: &'static str,
    /// The variant whose network it is; empty for that of `[training]`.
    pub variant: String,
    /// |𝒫|.
    pub samples: usize,
    /// What was asked for: a cubature may have fewer.
    pub asked: SampleCount,
    /// How they were chosen.
    pub chosen: &'static str,
    /// The quadrature.
    pub quadrature: &'static str,
    /// The update.
    pub update: &'static str,
    /// Δt over that of the full-order run.
    pub step_factor: u64,
    /// The position error over all frames reached, in per cent; `None` where none was, but for the first.
    pub error: Option<f64>,
    /// What encoder and network lose of the full-order frames without any dynamics, in per cent; `None` without an encoder.
    pub reconstruction_error: Option<f64>,
    /// At the points of the scene with more points, where there is one.
    pub super_resolved: Option<SuperResolved>,
    /// ‖x̂ − x̂₀‖ at the end over its largest value: 0 where the path of the coordinates is closed.
    pub latent_return: f64,
    /// Time simulated (s).
    pub simulated: f64,
    /// Steps.
    pub steps: u64,
    /// Wall time of the reduced steps (s).
    pub seconds: f64,
    /// Wall time of the full-order run of as many steps (s).
    pub full_seconds: f64,
    /// |ℐ| of the last step.
    pub nodes: usize,
    /// Quadrature points of the last step.
    pub quadrature_points: usize,
    /// Neighbour lists made.
    pub refreshes: u64,
    /// Quadrature points that had F limited because of J ≤ 0, counted in every step.
    pub limited: usize,
    /// `finished`, or why the run ended before its time.
    pub outcome: String,
    /// All frames reached.
    pub frames: Vec<FrameRow>,
}

/// A frame of a reduced run.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameRow {
    /// t (s).
    pub time: f64,
    /// The position error of this frame, in per cent.
    pub error: f64,
    /// x̂.
    pub latent: Vec<f64>,
}

/// All rows as CSV.
pub(super) fn results(parameters: &[String], rows: &[ReducedRow]) -> String {
    let mut text = String::new();
    for row in rows {
        let columns = columns(parameters, row);
        if text.is_empty() {
            let names: Vec<&str> = columns.iter().map(|(name, _)| *name).collect();
            text = names.join(",") + "\n";
        }
        let values: Vec<String> = columns.into_iter().map(|(_, value)| value).collect();
        text += &(values.join(",") + "\n");
    }
    text
}

/// The columns of the results, but for the parameters.
const COLUMNS: &str = "case manifold variant samples asked choice quadrature update step_factor position_error_percent reconstruction_error_percent super_resolution_points super_resolution_error_percent tracer_error_percent latent_return simulated_seconds steps seconds full_seconds speed_up real_time_factor nodes quadrature_points neighbour_lists limited outcome";

/// Whether the results have a column with this name, whatever the parameters are.
pub(super) fn is_column(name: &str) -> bool {
    COLUMNS.split(' ').any(|column| column == name)
}

/// Names and values of a row, empty where there are none.
fn columns<'a>(parameters: &'a [String], row: &ReducedRow) -> Vec<(&'a str, String)> {
    let exact = |value: f64| format!("{value:?}");
    let some = |value: Option<f64>| value.map(exact).unwrap_or_default();
    let fine = row.super_resolved;
    // A run that could not begin took no time.
    let timed = row.seconds > 0.0;
    let per_second = |value: f64| {
        let per_second = timed.then(|| format!("{:.3}", value / row.seconds));
        per_second.unwrap_or_default()
    };
    let mut columns = vec![("case", row.case.to_string())];
    let named = parameters.iter().zip(&row.parameters);
    columns.extend(named.map(|(name, &value)| (name.as_str(), exact(value))));
    columns.extend([
        ("manifold", row.manifold.to_owned()),
        ("variant", row.variant.clone()),
        ("samples", row.samples.to_string()),
        (
            "asked",
            row.asked.count().map_or("all".to_owned(), |count| count.to_string()),
        ),
        ("choice", row.chosen.to_owned()),
        ("quadrature", row.quadrature.to_owned()),
        ("update", row.update.to_owned()),
        ("step_factor", row.step_factor.to_string()),
        ("position_error_percent", some(row.error)),
        ("reconstruction_error_percent", some(row.reconstruction_error)),
        (
            "super_resolution_points",
            fine.map(|fine| fine.points.to_string()).unwrap_or_default(),
        ),
        ("super_resolution_error_percent", some(fine.and_then(|fine| fine.error))),
        ("tracer_error_percent", some(fine.map(|fine| fine.tracer_error))),
        ("latent_return", exact(row.latent_return)),
        ("simulated_seconds", exact(row.simulated)),
        ("steps", row.steps.to_string()),
        ("seconds", format!("{:.6}", row.seconds)),
        ("full_seconds", format!("{:.6}", row.full_seconds)),
        ("speed_up", per_second(row.full_seconds)),
        ("real_time_factor", per_second(row.simulated)),
        ("nodes", row.nodes.to_string()),
        ("quadrature_points", row.quadrature_points.to_string()),
        ("neighbour_lists", row.refreshes.to_string()),
        ("limited", row.limited.to_string()),
        ("outcome", format!("\"{}\"", row.outcome.replace('"', "'"))),
    ]);
    columns
}

/// All frames of all runs as CSV, with as many coordinates as the largest network has; `run` is the row of the run in the results, counted from 0.
pub(super) fn frames(runs: &[ReducedRow]) -> String {
    let all = runs.iter().flat_map(|run| &run.frames);
    let coordinates = all.map(|frame| frame.latent.len()).max().unwrap_or(0);
    let names: String = (1..=coordinates).map(|k| format!(",x{k}")).collect();
    let mut text = format!("run,time,position_error_percent{names}\n");
    for (number, run) in runs.iter().enumerate() {
        for frame in &run.frames {
            let value = |k: usize| {
                frame
                    .latent
                    .get(k)
                    .map(|value| format!("{value:?}"))
                    .unwrap_or_default()
            };
            let latent: String = (0..coordinates).map(|k| format!(",{}", value(k))).collect();
            let _ = writeln!(text, "{number},{:?},{:?}{latent}", frame.time, frame.error);
        }
    }
    text
}
