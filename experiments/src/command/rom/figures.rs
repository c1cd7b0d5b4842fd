//! Figures of a training and of reduced runs.

use std::path::Path;

use mpm_rom::experiment::Experiment;
use mpm_rom::training::EpochReport;
use parvi_files::AtomicFile;

use crate::CommandError;
use crate::plots::page::counted;
use crate::plots::results::{Row, Rows};
use crate::plots::{Axis, AxisKind, LineSeries, MultiplesPanel, MultiplesPlot, multiples};

/// The column of the position error.
pub const ERROR: &str = "position_error_percent";
/// The column of the full-order over the reduced wall time.
pub const GAIN: &str = "gain";

/// A number of an epoch.
type Value = fn(&EpochReport) -> f64;

/// Rows of runs that were made in the same way, in the order in which these come first.
pub fn groups<'a>(rows: &Rows<'a>) -> Vec<Rows<'a>> {
    let way = |row: &Row| {
        // A cubature may have fewer points than were asked for.
        let asked = [row.value("asked"), row.value("samples")].map(ToString::to_string);
        let asked = asked.into_iter().find(|count| !count.is_empty()).unwrap_or_default();
        let parts = ["manifold", "variant", "choice", "quadrature", "update", "step_factor"];
        format!("{asked} {}", parts.map(|part| row.value(part).to_string()).join(" "))
    };
    rows.by_name(way).into_iter().map(|(_, group)| group).collect()
}

/// Runs that reached the end of their time.
pub fn finished<'a>(rows: &Rows<'a>) -> Rows<'a> {
    rows.with("outcome", "finished")
}

/// The loss and its terms against the epoch.
pub fn losses(directory: &Path, title: &str, history: &[EpochReport]) -> Result<(), CommandError> {
    let terms: [(&str, Value); 4] = [
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
    Ok(AtomicFile::write(directory.join("losses.svg"), multiples(&plot)?)?)
}

/// Test cases whose coordinates are drawn, at most.
const DRAWN: usize = 6;

/// x̂ against time, a panel for each coordinate: the first test cases, run in the way that comes first of those that began; without any there is no figure, nor one of earlier runs. The frames have the places of their
/// runs among the rows.
pub fn coordinates(
    directory: &Path,
    experiment: &Experiment,
    rows: &Rows<'_>,
    frames: &Rows<'_>,
) -> Result<(), CommandError> {
    let run_of = |row: &Row| rows.iter().position(|other| std::ptr::eq(other, row));
    let path = directory.join("coordinates.svg");
    let shown = groups(rows).into_iter().find_map(|group| {
        let runs = group.iter().map(|row| (row, frames.with("run", run_of(row))));
        let begun = runs.filter(|(_, frames)| !frames.is_empty());
        Some(begun.take(DRAWN).collect::<Vec<_>>()).filter(|shown| !shown.is_empty())
    });
    let Some(shown) = shown else {
        // There may be none.
        let _ = std::fs::remove_file(path);
        return Ok(());
    };
    let names = (1..).map(|k| format!("x{k}"));
    let known = names.take_while(|name| shown[0].1.iter().any(|frame| frame.number(name).is_some()));
    let panel = |name: String| {
        let line = |(row, frames): &(&Row, Rows<'_>)| {
            let parameters = experiment.parameters.iter();
            let values: Vec<String> = parameters.map(|name| format!("{name} {}", row.value(name))).collect();
            frames.line(values.join(", "), "time", &name)
        };
        let label = name.replace('x', "x̂");
        MultiplesPanel::over(label, AxisKind::Linear, shown.iter().map(line))
    };
    let samples = counted(shown[0].0.count("samples").unwrap_or(0), "sample points");
    let title = format!("{}: coordinates, {samples}", experiment.title);
    let plot = MultiplesPlot::traces(title, "time (s)", known.map(panel));
    Ok(AtomicFile::write(path, multiples(&plot)?)?)
}

/// What lines may differ in, besides the choice of their points.
fn parts(row: &Row) -> [String; 4] {
    let names = ["variant", "manifold"].map(|column| row.text(column));
    let network = names.into_iter().find(|name| !name.is_empty());
    [
        network.unwrap_or_default().to_owned(),
        row.text("quadrature").to_owned(),
        row.text("update").to_owned(),
        format!("Δt × {}", row.value("step_factor")),
    ]
}

/// Position error and wall time of the runs that finished against the number of sample points; without any there is no figure, nor one of earlier runs.
pub fn errors(directory: &Path, title: &str, rows: &Rows<'_>) -> Result<(), CommandError> {
    let figures = [
        ("errors.svg", "position error (%)", ERROR),
        ("speed_up.svg", "full-order over reduced wall time", GAIN),
    ];
    let ended = rows.len() - finished(rows).len();
    let note = format!("Runs that ended before their time and have no part in the means: {ended}.");
    for (file, y_label, column) in figures {
        let path = directory.join(file);
        if ended == rows.len() {
            // There may be none.
            let _ = std::fs::remove_file(path);
            continue;
        }
        let x_label = "sample points (mean and range over the test cases)";
        let plot = MultiplesPlot {
            title: title.to_owned(),
            y: Axis::new(y_label, AxisKind::Automatic),
            panels: vec![MultiplesPanel::new("", series(rows, column))],
            notes: (ended > 0).then(|| note.clone()).into_iter().collect(),
            ..MultiplesPlot::logarithmic(x_label, "")
        };
        AtomicFile::write(path, multiples(&plot)?)?;
    }
    Ok(())
}

/// A line for all runs that differ in nothing but the number of their points, with a gap where none of them finished. All points are a choice of their own, and belong to the line of every choice.
fn series(rows: &Rows<'_>, column: &str) -> Vec<LineSeries> {
    // What all lines share is not in their labels.
    let all_parts: Vec<[String; 4]> = rows.iter().map(parts).collect();
    let is_told = |part: &usize| all_parts.iter().any(|parts| parts[*part] != all_parts[0][*part]);
    let told: Vec<usize> = (0..4).filter(is_told).collect();
    let way = |row: &Row| told.iter().map(|&part| parts(row)[part].clone()).collect::<Vec<_>>();
    let groups = groups(rows).into_iter();
    let groups = groups.filter_map(|group| Some((way(group.first()?), group.first()?.text("choice"), group)));
    let (all, drawn): (Vec<_>, Vec<_>) = groups.partition(|(_, choice, _)| *choice == "all");
    let several_choices = drawn.iter().any(|(_, choice, _)| *choice != drawn[0].1);
    let mut lines: Vec<(Vec<String>, &str, LineSeries)> = Vec::new();
    for (way, chosen, group) in drawn.into_iter().chain(all) {
        let is_of = |line: &(Vec<String>, &str, LineSeries)| line.0 == way && [line.1, "all"].contains(&chosen);
        if !lines.iter().any(is_of) {
            let choice = (several_choices && chosen != "all").then_some(chosen);
            let label: Vec<&str> = way.iter().map(String::as_str).chain(choice).collect();
            lines.push((way.clone(), chosen, LineSeries::named(label.join(", "))));
        }
        let samples = group.first().and_then(|row| row.number("samples"));
        for (_, _, line) in lines.iter_mut().filter(|line| is_of(line)) {
            line.push_mean(samples.unwrap_or(f64::NAN), &finished(&group).values(column));
        }
    }
    lines.into_iter().map(|(_, _, line)| line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(quadrature: &str, choice: &str, samples: usize, error: f64) -> Row {
        let row = Row::of("0").with("manifold", "network").with("quadrature", quadrature);
        let row = row.with("choice", choice).with("samples", samples);
        row.with("update", "position-velocity")
            .with("outcome", "finished")
            .with(ERROR, error)
    }

    fn lines(rows: &[Row]) -> Vec<(String, Vec<f64>, Vec<f64>)> {
        let lines = series(&rows.iter().collect(), ERROR).into_iter();
        lines.map(|line| (line.label, line.x, line.y)).collect()
    }

    #[test]
    fn runs_that_ended_before_their_time_have_no_part_in_the_means() {
        let ended = |row: Row| row.with("outcome", "J < 0").with(ERROR, None::<f64>);
        let rows = [
            row("eulerian", "greedy", 10, 3.0),
            ended(row("eulerian", "greedy", 10, 0.0)),
            ended(row("eulerian", "greedy", 20, 0.0)),
        ];
        let lines = lines(&rows);
        assert_eq!((lines[0].1.as_slice(), lines[0].2[0]), ([10.0, 20.0].as_slice(), 3.0));
        assert!(lines[0].2[1].is_nan());
        let root = tempfile::tempdir().unwrap();
        std::fs::write(root.path().join("errors.svg"), "of earlier runs").unwrap();
        errors(root.path(), "All ended", &rows[1..].iter().collect()).unwrap();
        assert!(!root.path().join("errors.svg").exists());
    }

    #[test]
    fn coordinates_are_those_of_runs_that_began() {
        let text = r#"
            title = "One"
            scene = "none.toml"
            parameters = ["g"]
            keys = [{ key = "gravity.1", product = ["g"] }]
            cases = { train = [[1.0]], test = [[2.0]] }
        "#;
        let experiment = Experiment::parse(text, Path::new("rom.toml")).unwrap();
        let rows = [row("eulerian", "greedy", 10, 3.0), row("lagrangian", "greedy", 10, 3.0)];
        let frame = |time: f64| {
            Row::of("")
                .with("run", 1_usize)
                .with("time", time)
                .with("x1", 2.0 * time)
        };
        let frames = [frame(0.0), frame(1.0)];
        let root = tempfile::tempdir().unwrap();
        let draw = |frames: &[Row]| {
            coordinates(
                root.path(),
                &experiment,
                &rows.iter().collect(),
                &frames.iter().collect(),
            )
            .unwrap();
            root.path().join("coordinates.svg").exists()
        };
        assert!(draw(&frames) && !draw(&[]));
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
