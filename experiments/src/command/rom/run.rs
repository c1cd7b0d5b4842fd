//! `parvi rom run`.

use std::path::Path;

use mpm_rom::experiment::{Experiment, names, run_experiment};

use super::figures;
use crate::plots::results::{Row, Rows, Value};
use crate::progress::Bar;
use crate::study::row_file;
use crate::{CommandError, console, interrupt};

/// Reduced runs of all test cases, their table and figures.
pub fn execute(experiment: &Experiment, directory: &Path) -> Result<(), CommandError> {
    let mut progress = Bar::counting("run");
    let result = run_experiment(experiment, directory, &mut |done, runs| {
        progress.set(done, runs);
        !interrupt::requested()
    });
    progress.clear();
    result?;
    report(experiment, directory)
}

/// Figures and means of the reduced runs in the tables of a directory.
pub fn report(experiment: &Experiment, directory: &Path) -> Result<(), CommandError> {
    let mut rows = row_file::read_all(&directory.join(names::RESULTS))?;
    for row in &mut rows {
        let gain = row.number("full_seconds").zip(row.number("seconds"));
        row.set(figures::GAIN, gain.map(|(full, reduced)| full / reduced));
    }
    let frames = row_file::read_all(&directory.join(names::FRAMES))?;
    let rows: Rows<'_> = rows.iter().collect();
    figures::errors(directory, &experiment.title, &rows)?;
    figures::coordinates(directory, experiment, &rows, &frames.iter().collect())?;
    for row in rows.iter().filter(|row| row.text("outcome") != "finished") {
        console::notice(&format!("case {}: {}: {}", row.case(), made(row), row.text("outcome")));
    }
    let groups = figures::groups(&rows);
    let lines = groups.iter().filter_map(|here| Some(line(here.first()?, here)));
    console::print(&lines.collect::<String>())
}

/// How a run was made, as keys and values.
fn made(row: &Row) -> String {
    let columns = "manifold variant samples choice quadrature update step_factor".split(' ');
    let given = columns.filter(|column| *row.value(column) != Value::Empty);
    let pairs: Vec<String> = given.map(|column| format!("{column}={}", row.value(column))).collect();
    pairs.join(" ")
}

/// The means over those of the runs, which were made as the first one, that finished; only how many did where none has.
fn line(first: &Row, here: &Rows<'_>) -> String {
    let (made, all) = (made(first), here.len());
    let here = figures::finished(here);
    let mut text = format!("{made} finished={}/{all}", here.len());
    if here.is_empty() {
        return text + "\n";
    }
    text.push_str(&format!(
        " mean_error_percent={:.4} largest_error_percent={:.4} speed_up={:.2} real_time_factor={:.3}",
        here.mean(figures::ERROR),
        here.largest(figures::ERROR).unwrap_or(f64::NAN),
        here.mean("full_seconds") / here.mean("seconds"),
        here.mean("simulated_seconds") / here.mean("seconds"),
    ));
    if first.number("super_resolution_points").is_some() {
        text.push_str(&format!(
            " super_resolution_mean_error_percent={:.4} tracer_mean_error_percent={:.4}",
            here.mean("super_resolution_error_percent"),
            here.mean("tracer_error_percent"),
        ));
    }
    text + "\n"
}
