//! What reduced runs gave, as tables.

use super::{Choice, SampleCount, SuperResolved};
use crate::online::StepReport;

/// A reduced run beside the full-order run of the same case.
#[derive(Clone, Debug, PartialEq)]
pub struct ReducedRow {
    /// Number of the test case, counted from 0.
    pub case: usize,
    /// Values of its parameters.
    pub parameters: Vec<f64>,
    /// What it was made with.
    pub choice: Choice,
    /// The variant whose network it is; empty for that of `[training]`.
    pub variant: String,
    /// |𝒫|; a cubature may have fewer than were asked for.
    pub samples: usize,
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
    /// What its last step did.
    pub report: StepReport,
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

/// The column before those of the parameters.
const CASE: &str = "case";

/// A name, and what makes the value of a row, empty where there is none.
type Column = (&'static str, fn(&ReducedRow) -> String);

/// The columns after those of the parameters.
const COLUMNS: [Column; 25] = [
    ("manifold", |row| row.choice.manifold.name().to_owned()),
    ("variant", |row| row.variant.clone()),
    ("samples", |row| row.samples.to_string()),
    ("asked", |row| match row.choice.samples {
        SampleCount::All => "all".to_owned(),
        SampleCount::Drawn(count) => count.to_string(),
    }),
    ("choice", |row| row.choice.way().to_owned()),
    ("quadrature", |row| row.choice.quadrature.name().to_owned()),
    ("update", |row| row.choice.update.name().to_owned()),
    ("step_factor", |row| row.choice.step_factor.to_string()),
    ("position_error_percent", |row| some(row.error)),
    ("reconstruction_error_percent", |row| some(row.reconstruction_error)),
    ("super_resolution_points", |row| {
        let points = row.super_resolved.map(|fine| fine.points.to_string());
        points.unwrap_or_default()
    }),
    ("super_resolution_error_percent", |row| {
        some(row.super_resolved.and_then(|fine| fine.error))
    }),
    ("tracer_error_percent", |row| {
        some(row.super_resolved.map(|fine| fine.tracer_error))
    }),
    ("latent_return", |row| exact(row.latent_return)),
    ("simulated_seconds", |row| exact(row.simulated)),
    ("steps", |row| row.steps.to_string()),
    ("seconds", |row| format!("{:.6}", row.seconds)),
    ("full_seconds", |row| format!("{:.6}", row.full_seconds)),
    ("speed_up", |row| per_second(row.full_seconds, row)),
    ("real_time_factor", |row| per_second(row.simulated, row)),
    ("nodes", |row| row.report.nodes.to_string()),
    ("quadrature_points", |row| row.report.quadrature_points.to_string()),
    ("neighbour_lists", |row| row.report.refreshes.to_string()),
    ("limited", |row| row.report.limited.to_string()),
    ("outcome", |row| format!("\"{}\"", row.outcome.replace('"', "'"))),
];

/// All digits of a number.
fn exact(value: f64) -> String {
    format!("{value:?}")
}

fn some(value: Option<f64>) -> String {
    value.map(exact).unwrap_or_default()
}

/// A number of a run over its wall time; one that could not begin took none.
fn per_second(value: f64, row: &ReducedRow) -> String {
    match row.seconds > 0.0 {
        true => format!("{:.3}", value / row.seconds),
        false => String::new(),
    }
}

/// All rows as CSV.
pub(super) fn results(parameters: &[String], rows: &[ReducedRow]) -> String {
    let names = parameters.iter().map(String::as_str);
    let names = names.chain(COLUMNS.map(|(name, _)| name));
    let mut text = CASE.to_owned();
    names.for_each(|name| text += &format!(",{name}"));
    for row in rows {
        let values = row.parameters.iter().map(|&value| exact(value));
        let values = values.chain(COLUMNS.map(|(_, value)| value(row)));
        text += &format!("\n{}", row.case);
        values.for_each(|value| text += &format!(",{value}"));
    }
    text + "\n"
}

/// Whether the results have a column with this name, whatever the parameters are.
pub(super) fn is_column(name: &str) -> bool {
    name == CASE || COLUMNS.iter().any(|(column, _)| *column == name)
}

/// All frames of all runs as CSV, with as many coordinates as the largest network has; `run` is the row of the run in the results, counted from 0.
pub(super) fn frames(runs: &[ReducedRow]) -> String {
    let all = runs.iter().flat_map(|run| &run.frames);
    let coordinates = all.map(|frame| frame.latent.len()).max().unwrap_or(0);
    let names: String = (1..=coordinates).map(|k| format!(",x{k}")).collect();
    let mut text = format!("run,time,position_error_percent{names}\n");
    for (number, run) in runs.iter().enumerate() {
        for frame in &run.frames {
            let value = |k: usize| some(frame.latent.get(k).copied());
            let latent: String = (0..coordinates).map(|k| format!(",{}", value(k))).collect();
            text += &format!("{number},{:?},{:?}{latent}\n", frame.time, frame.error);
        }
    }
    text
}
