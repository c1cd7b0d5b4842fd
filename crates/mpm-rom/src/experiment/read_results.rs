//! The tables of a directory of reduced runs, read again.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use csv::StringRecord;

use super::files::names;
use super::options::All;
use super::{
    ChoiceName, Experiment, ExperimentError, FrameRow, ManifoldName, QuadratureName, ReducedRow, SampleCount,
    SuperResolved,
};
use crate::online::Update;

/// The rows that [`run`](super::run) has written into a directory, complete or not. The numbers of sample points that were asked for are taken to be those of the rows.
///
/// # Errors
/// [`ExperimentError::File`] for a table that is missing, [`ExperimentError::Table`] for one that cannot be read, with its line and column.
pub fn read_results(experiment: &Experiment, directory: &Path) -> Result<Vec<ReducedRow>, ExperimentError> {
    let mut rows = Vec::new();
    Table::open(directory.join(names::RESULTS))?.for_each(|line| {
        rows.push(row(experiment, &line)?);
        Ok(())
    })?;
    Table::open(directory.join(names::FRAMES))?.for_each(|line| {
        let run: usize = line.value("run")?;
        let names = (1..).map(|k| format!("x{k}"));
        let texts = names.map_while(|name| line.text(&name).ok().filter(|text| !text.is_empty()).map(|_| name));
        let latent: Result<Vec<f64>, _> = texts.map(|name| line.value(&name)).collect();
        let frame = FrameRow {
            time: line.value("time")?,
            error: line.value("position_error_percent")?,
            latent: latent?,
        };
        let row = rows.get_mut(run);
        let row = row.ok_or_else(|| line.refuse("run", format!("no row of {} has this number", names::RESULTS)))?;
        row.frames.push(frame);
        Ok(())
    })?;
    Ok(rows)
}

fn row(experiment: &Experiment, line: &Line) -> Result<ReducedRow, ExperimentError> {
    let parameters = experiment.parameters.iter().map(|name| line.value(name));
    let samples = line.value("samples")?;
    let chosen = line.word("choice", &[&["all"], ChoiceName::WORDS].concat())?;
    let super_resolved = match line.optional("super_resolution_points")? {
        None => None,
        Some(points) => Some(SuperResolved {
            points,
            error: line.value("super_resolution_error_percent")?,
            tracer_error: line.value("tracer_error_percent")?,
        }),
    };
    Ok(ReducedRow {
        case: line.value("case")?,
        parameters: parameters.collect::<Result<_, _>>()?,
        manifold: line.word("manifold", ManifoldName::WORDS)?,
        variant: line.text("variant")?.to_owned(),
        samples,
        asked: match chosen {
            "all" => SampleCount::All(All::All),
            _ => SampleCount::Drawn(samples),
        },
        chosen,
        quadrature: line.word("quadrature", QuadratureName::WORDS)?,
        update: line.word("update", Update::WORDS)?,
        step_factor: line.value("step_factor")?,
        error: line.value("position_error_percent")?,
        reconstruction_error: line.optional("reconstruction_error_percent")?,
        super_resolved,
        latent_return: line.value("latent_return")?,
        simulated: line.value("simulated_seconds")?,
        steps: line.value("steps")?,
        seconds: line.value("seconds")?,
        full_seconds: line.value("full_seconds")?,
        nodes: line.value("nodes")?,
        quadrature_points: line.value("quadrature_points")?,
        refreshes: line.value("neighbour_lists")?,
        limited: line.value("limited")?,
        outcome: line.text("outcome")?.to_owned(),
        frames: Vec::new(),
    })
}

/// A CSV file with a header.
struct Table {
    file: PathBuf,
    reader: csv::Reader<std::fs::File>,
    columns: HashMap<String, usize>,
}

/// A line of a table.
struct Line<'a> {
    file: &'a Path,
    columns: &'a HashMap<String, usize>,
    record: StringRecord,
}

impl Table {
    fn open(file: PathBuf) -> Result<Self, ExperimentError> {
        let source = std::fs::File::open(&file).map_err(|source| ExperimentError::file("read", &file, source))?;
        let mut reader = csv::Reader::from_reader(source);
        let names = reader.headers().map_err(|error| malformed(&file, &error))?;
        let columns = names
            .iter()
            .enumerate()
            .map(|(place, name)| (name.to_owned(), place))
            .collect();
        Ok(Self { file, reader, columns })
    }

    fn for_each(mut self, mut read: impl FnMut(Line) -> Result<(), ExperimentError>) -> Result<(), ExperimentError> {
        let (file, columns) = (&self.file, &self.columns);
        for record in self.reader.records() {
            let record = record.map_err(|error| malformed(file, &error))?;
            read(Line { file, columns, record })?;
        }
        Ok(())
    }
}

impl Line<'_> {
    fn refuse(&self, column: &str, message: String) -> ExperimentError {
        let line = self.record.position().map_or(0, csv::Position::line);
        ExperimentError::Table {
            file: self.file.display().to_string(),
            line,
            message: format!("column {column}: {message}"),
        }
    }

    fn text(&self, column: &str) -> Result<&str, ExperimentError> {
        let place = self.columns.get(column);
        let text = place.and_then(|&place| self.record.get(place));
        text.ok_or_else(|| self.refuse(column, "missing".to_owned()))
    }

    fn value<T: FromStr>(&self, column: &str) -> Result<T, ExperimentError> {
        let text = self.text(column)?;
        text.parse()
            .map_err(|_| self.refuse(column, format!("`{text}` is not a number")))
    }

    /// The value, if there is one.
    fn optional<T: FromStr>(&self, column: &str) -> Result<Option<T>, ExperimentError> {
        match self.text(column)? {
            "" => Ok(None),
            _ => self.value(column).map(Some),
        }
    }

    /// One of these words.
    fn word(&self, column: &str, words: &[&'static str]) -> Result<&'static str, ExperimentError> {
        let text = self.text(column)?;
        let word = words.iter().find(|word| **word == text);
        word.copied()
            .ok_or_else(|| self.refuse(column, format!("`{text}` is none of {words:?}")))
    }
}

/// A line that is no CSV, or has another number of entries.
fn malformed(file: &Path, error: &csv::Error) -> ExperimentError {
    ExperimentError::Table {
        file: file.display().to_string(),
        line: error.position().map_or(0, csv::Position::line),
        message: error.to_string(),
    }
}
