//! Figures of a training and of reduced runs.

use std::path::Path;

use mpm_rom::experiment::{Experiment, ReducedRow};
use mpm_rom::training::EpochReport;

use super::groups;
use crate::CommandError;
use crate::output::AtomicFile;
use crate::plots::{AxisKind, LineSeries, MultiplesPanel, MultiplesPlot, multiples};

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
    let series = terms.map(|(label, value)| {
        let point = |report: &EpochReport| ((report.epoch + 1) as f64, value(report));
        LineSeries::through(label, history.iter().map(point))
    });
    let panel = MultiplesPanel::over("mean loss", AxisKind::Logarithmic, series);
    let plot = MultiplesPlot::traces(format!("{title}: training"), "epoch", [panel]);
    AtomicFile::write(directory.join("losses.svg"), multiples(&plot)?)
}

/// Test cases whose coordinates are drawn, at most.
const DRAWN: usize = 6;

/// x̂ against time, a panel for each coordinate: the first test cases, run in the way that comes first.
pub fn coordinates(directory: &Path, experiment: &Experiment, rows: &[ReducedRow]) -> Result<(), CommandError> {
    let groups = groups(rows);
    let Some(first) = groups.first() else { return Ok(()) };
    let shown = &first[..first.len().min(DRAWN)];
    let count = shown[0].frames.first().map_or(0, |frame| frame.latent.len());
    let panel = |coordinate: usize| {
        let line = |row: &&ReducedRow| {
            let named = experiment.parameters.iter().zip(&row.parameters);
            let values: Vec<String> = named.map(|(name, value)| format!("{name} {value}")).collect();
            let frames = row.frames.iter();
            let points = frames.map(|frame| (frame.time, frame.latent[coordinate]));
            LineSeries::through(values.join(", "), points)
        };
        MultiplesPanel::over(format!("x̂{}", coordinate + 1), AxisKind::Linear, shown.iter().map(line))
    };
    let title = format!("{}: coordinates, {} sample points", experiment.title, shown[0].samples);
    let plot = MultiplesPlot::traces(title, "time (s)", (0..count).map(panel));
    AtomicFile::write(directory.join("coordinates.svg"), multiples(&plot)?)
}

/// What lines may differ in, besides the choice of their points.
const PARTS: [fn(&ReducedRow) -> String; 4] = [
    |row| match row.variant.as_str() {
        "" => row.manifold.to_owned(),
        variant => variant.to_owned(),
    },
    |row| row.quadrature.to_owned(),
    |row| row.update.to_owned(),
    |row| format!("Δt × {}", row.step_factor),
];

/// Position error and wall time against the number of sample points.
pub fn errors(directory: &Path, title: &str, rows: &[ReducedRow]) -> Result<(), CommandError> {
    let figures: [(&str, &str, Value<ReducedRow>); 2] = [
        ("errors.svg", "position error (%)", |row| row.error),
        ("speed_up.svg", "full-order over reduced wall time", |row| {
            row.full_seconds / row.seconds
        }),
    ];
    for (file, y_label, value) in figures {
        let x_label = "sample points (mean and range over the test cases)";
        let plot = MultiplesPlot {
            title: title.to_owned(),
            y_axis: AxisKind::Automatic,
            panels: vec![MultiplesPanel::new("", series(rows, value))],
            ..MultiplesPlot::logarithmic(x_label, y_label)
        };
        AtomicFile::write(directory.join(file), multiples(&plot)?)?;
    }
    Ok(())
}

/// A line for all runs that differ in nothing but the number of their points. All points are a choice of their own, and belong to the line of every choice.
fn series(rows: &[ReducedRow], value: Value<ReducedRow>) -> Vec<LineSeries> {
    // What all lines share is not in their labels.
    let told: Vec<_> = PARTS
        .into_iter()
        .filter(|part| rows.iter().any(|row| part(row) != part(&rows[0])))
        .collect();
    let way = |row: &ReducedRow| told.iter().map(|part| part(row)).collect::<Vec<_>>();
    let (all, drawn): (Vec<_>, Vec<_>) = groups(rows).into_iter().partition(|group| group[0].chosen == "all");
    let several_choices = drawn.iter().any(|group| group[0].chosen != drawn[0][0].chosen);
    let mut lines: Vec<(Vec<String>, &str, LineSeries)> = Vec::new();
    for group in drawn.into_iter().chain(all) {
        let (way, chosen) = (way(group[0]), group[0].chosen);
        let is_of = |line: &(Vec<String>, &str, LineSeries)| line.0 == way && [line.1, "all"].contains(&chosen);
        if !lines.iter().any(is_of) {
            let choice = (several_choices && chosen != "all").then_some(chosen);
            let label = way.iter().map(String::as_str).chain(choice).collect::<Vec<_>>();
            lines.push((way.clone(), chosen, LineSeries::named(label.join(", "))));
        }
        let values: Vec<f64> = group.iter().map(|row| value(row)).collect();
        for (_, _, line) in lines.iter_mut().filter(|line| is_of(line)) {
            line.push_mean(group[0].samples as f64, &values);
        }
    }
    lines.into_iter().map(|(_, _, line)| line).collect()
}

#[cfg(test)]
mod tests {
    use mpm_rom::experiment::{All, SampleCount};

    use super::*;

    fn row(quadrature: &'static str, chosen: &'static str, samples: usize, error: f64) -> ReducedRow {
        ReducedRow {
            case: 0,
            parameters: vec![1.0],
            manifold: "network",
            variant: String::new(),
            samples,
            asked: match chosen {
                "all" => SampleCount::All(All::All),
                _ => SampleCount::Drawn(samples),
            },
            chosen,
            quadrature,
            update: "position-velocity",
            step_factor: 1,
            error,
            reconstruction_error: None,
            super_resolved: None,
            latent_return: 0.0,
            simulated: 1.0,
            steps: 10,
            seconds: 1.0,
            full_seconds: 1.0,
            nodes: 8,
            quadrature_points: 20,
            refreshes: 0,
            limited: 0,
            outcome: "finished".to_owned(),
            frames: Vec::new(),
        }
    }

    fn lines(rows: &[ReducedRow]) -> Vec<(String, Vec<f64>, Vec<f64>)> {
        let lines = series(rows, |row| row.error).into_iter();
        lines.map(|line| (line.label, line.x, line.y)).collect()
    }

    #[test]
    fn labels_tell_what_differs_and_all_points_end_every_line() {
        let one = [row("eulerian", "greedy", 10, 3.0), row("eulerian", "greedy", 20, 2.0)];
        assert_eq!(lines(&one), [(String::new(), vec![10.0, 20.0], vec![3.0, 2.0])]);
        let many = [
            row("eulerian", "all", 90, 1.0),
            row("eulerian", "greedy", 10, 3.0),
            row("eulerian", "greedy", 10, 5.0),
            row("eulerian", "cubature", 10, 7.0),
            row("lagrangian", "all", 90, 2.0),
        ];
        let expected = [
            ("eulerian, greedy", vec![10.0, 90.0], vec![4.0, 1.0]),
            ("eulerian, cubature", vec![10.0, 90.0], vec![7.0, 1.0]),
            ("lagrangian", vec![90.0], vec![2.0]),
        ];
        assert_eq!(lines(&many), expected.map(|(label, x, y)| (label.to_owned(), x, y)));
    }
}
