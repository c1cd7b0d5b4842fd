//! Figures of a training and of reduced runs.

use std::path::Path;

use mpm_rom::experiment::{Experiment, ReducedRow};
use mpm_rom::training::EpochReport;

use super::run::groups;
use crate::CommandError;
use crate::output::AtomicFile;
use crate::plots::{AxisKind, LinePlot, LineSeries, TracePanel, TracePlot, TraceSeries, line, trace};

/// A number of an epoch or of a run.
type Value<T> = fn(&T) -> f64;

/// The loss and its terms against the epoch.
pub fn losses(directory: &Path, title: &str, history: &[EpochReport]) -> Result<(), CommandError> {
    let terms: [(&str, Value<EpochReport>); 4] = [
        ("loss", |report| report.terms.total()),
        ("position", |report| report.terms.position),
        ("gradient", |report| report.terms.gradient),
        ("velocity", |report| report.terms.velocity),
    ];
    let series = terms.map(|(label, value)| TraceSeries {
        label: label.to_owned(),
        step: history.iter().map(|report| (report.epoch + 1) as f64).collect(),
        value: history.iter().map(value).collect(),
    });
    let panel = TracePanel {
        y_label: "mean loss".to_owned(),
        y_axis: AxisKind::Logarithmic,
        series: series.into(),
        levels: Vec::new(),
    };
    let plot = TracePlot {
        title: format!("{title}: training"),
        x_label: "epoch".to_owned(),
        panels: vec![panel],
    };
    AtomicFile::write(directory.join("losses.svg"), trace(&plot)?)
}

/// Test cases whose coordinates are drawn, at most.
const DRAWN: usize = 6;

/// x̂ against time, a panel for each coordinate: the first test cases, run in the way that comes first.
pub fn coordinates(directory: &Path, experiment: &Experiment, rows: &[ReducedRow]) -> Result<(), CommandError> {
    let groups = groups(rows);
    let Some(first) = groups.first() else { return Ok(()) };
    let shown = &first[..first.len().min(DRAWN)];
    let count = shown[0].frames.first().map_or(0, |frame| frame.latent.len());
    let panel = |coordinate: usize| TracePanel {
        y_label: format!("x̂{}", coordinate + 1),
        y_axis: AxisKind::Linear,
        series: shown
            .iter()
            .map(|row| {
                let named = experiment.parameters.iter().zip(&row.parameters);
                let values: Vec<String> = named.map(|(name, value)| format!("{name} {value}")).collect();
                TraceSeries {
                    label: values.join(", "),
                    step: row.frames.iter().map(|frame| frame.time).collect(),
                    value: row.frames.iter().map(|frame| frame.latent[coordinate]).collect(),
                }
            })
            .collect(),
        levels: Vec::new(),
    };
    let plot = TracePlot {
        title: format!("{}: coordinates, {} sample points", experiment.title, shown[0].samples),
        x_label: "time (s)".to_owned(),
        panels: (0..count).map(panel).collect(),
    };
    AtomicFile::write(directory.join("coordinates.svg"), trace(&plot)?)
}

/// The family of maps, or the variant of the network.
fn map_of(row: &ReducedRow) -> &str {
    match row.variant.as_str() {
        "" => row.manifold,
        variant => variant,
    }
}

/// Position error and wall time against the number of sample points.
pub fn errors(directory: &Path, title: &str, rows: &[ReducedRow]) -> Result<(), CommandError> {
    let figures: [(&str, &str, Value<ReducedRow>); 2] = [
        ("errors.svg", "position error (%)", |row| row.error),
        ("speed_up.svg", "full-order over reduced wall time", |row| {
            row.full_seconds / row.seconds
        }),
    ];
    for (file, y_label, value) in figures {
        let mut series: Vec<LineSeries> = Vec::new();
        // What all lines share is not in their labels. All points are a choice of their own, and belong to every line.
        let several_maps = rows.iter().any(|row| map_of(row) != map_of(&rows[0]));
        let mut drawn = rows.iter().map(|row| row.chosen).filter(|&chosen| chosen != "all");
        let first_choice = drawn.next();
        let several_choices = drawn.any(|chosen| Some(chosen) != first_choice);
        for group in groups(rows) {
            let first = group[0];
            let mut label = format!("{}, {}", first.quadrature, first.update);
            if several_maps {
                label = format!("{}, {label}", map_of(first));
            }
            if several_choices && first.chosen != "all" {
                label.push_str(&format!(", {}", first.chosen));
            }
            if first.step_factor > 1 {
                label.push_str(&format!(", Δt × {}", first.step_factor));
            }
            let values: Vec<f64> = group.iter().map(|row| value(row)).collect();
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            let ends = values.iter().fold((f64::INFINITY, 0.0f64), |(low, high), &value| {
                (low.min(value), high.max(value))
            });
            let place = series.iter().position(|line| line.label == label).unwrap_or_else(|| {
                series.push(LineSeries {
                    label,
                    ..LineSeries::default()
                });
                series.len() - 1
            });
            series[place].x.push(group[0].samples as f64);
            series[place].y.push(mean);
            series[place].bars.push(ends);
        }
        let plot = LinePlot {
            title: title.to_owned(),
            x_label: "sample points (mean and range over the test cases)".to_owned(),
            y_label: y_label.to_owned(),
            x_axis: AxisKind::Logarithmic,
            series,
            ..LinePlot::default()
        };
        AtomicFile::write(directory.join(file), line(&plot)?)?;
    }
    Ok(())
}
