use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use super::{names, number, write_whole};
use crate::{Series, SimulationError};

/// The time series in memory and, row by row, in `series.csv`.
#[derive(Debug)]
pub struct SeriesFile {
    series: Series,
    path: PathBuf,
    file: File,
}

impl SeriesFile {
    /// Begins a series; replaces an earlier file.
    ///
    /// # Errors
    /// [`SimulationError::File`].
    pub fn create(directory: &Path, columns: Vec<String>) -> Result<Self, SimulationError> {
        Self::with(directory.join(names::SERIES), Series::new(columns))
    }

    /// Goes on with the first `rows` rows of the file that an earlier process left; `number_at` gives the number of the row that belongs to a time.
    ///
    /// # Errors
    /// [`SimulationError::File`], also for a file with other columns or fewer rows, and [`SimulationError::Series`] for a row among them that is none, or at the time of another.
    pub fn resume(
        directory: &Path,
        columns: Vec<String>,
        rows: usize,
        number_at: &dyn Fn(f64) -> Option<u64>,
    ) -> Result<Self, SimulationError> {
        let path = directory.join(names::SERIES);
        let series = read_rows(&path, rows)?;
        let mut times = (0..).zip(series.rows().iter().map(|row| row[0]));
        if let Some((number, time)) = times.find(|(number, time)| number_at(*time) != Some(*number)) {
            return Err(SimulationError::Series {
                path,
                line: number as usize + 2,
                message: format!("time = {time:?} is not that of row {number}; remove the checkpoint to begin again"),
            });
        }
        if series.columns() != columns || series.rows().len() < rows {
            let reason = "it is not the series of the checkpoint; remove the checkpoint to begin again";
            return Err(SimulationError::file(
                "go on with",
                &path,
                std::io::Error::other(reason),
            ));
        }
        Self::with(path, series)
    }

    fn with(path: PathBuf, series: Series) -> Result<Self, SimulationError> {
        let mut text = series.columns().join(",") + "\n";
        for row in series.rows() {
            text += &line(row);
        }
        write_whole(&path, text.as_bytes())?;
        let file = OpenOptions::new().append(true).open(&path);
        let file = file.map_err(|error| SimulationError::file("write", &path, error))?;
        Ok(Self { series, path, file })
    }

    /// Adds a row.
    ///
    /// # Errors
    /// [`SimulationError::File`].
    pub fn push(&mut self, row: Vec<f64>) -> Result<(), SimulationError> {
        let written = self.file.write_all(line(&row).as_bytes());
        written.map_err(|error| SimulationError::file("write", &self.path, error))?;
        self.series.push(row);
        Ok(())
    }

    /// The series so far.
    pub fn series(&self) -> &Series {
        &self.series
    }
}

fn line(row: &[f64]) -> String {
    let numbers: Vec<String> = row.iter().map(|&value| number(value)).collect();
    numbers.join(",") + "\n"
}

/// The series of a run's directory, without a last row that was being written when its process ended.
///
/// # Errors
/// [`SimulationError::File`], and [`SimulationError::Series`] for a line that is no row.
pub fn read_series(directory: &Path) -> Result<Series, SimulationError> {
    read_rows(&directory.join(names::SERIES), usize::MAX)
}

/// The first rows of a series, at most so many.
fn read_rows(path: &Path, most: usize) -> Result<Series, SimulationError> {
    let text = std::fs::read_to_string(path).map_err(|error| SimulationError::file("read", path, error))?;
    let refused = |line: usize, message: String| SimulationError::Series {
        path: path.to_owned(),
        line,
        message,
    };
    let whole = text.rfind('\n').map_or("", |end| &text[..end]);
    let mut lines = whole.lines();
    let header = lines.next().ok_or_else(|| refused(1, "no columns".to_owned()))?;
    let columns: Vec<String> = header.split(',').map(str::to_owned).collect();
    if let Some(first) = columns.first().filter(|first| *first != "time") {
        return Err(refused(1, format!("the first column is `{first}`: must be `time`")));
    }
    let mut series = Series::new(columns.clone());
    for (line, text) in (2..).zip(lines.take(most)) {
        let cells: Vec<&str> = text.split(',').collect();
        let number = |(cell, column): (&&str, &String)| {
            let number = cell.parse::<f64>();
            number.map_err(|_| refused(line, format!("{column} = `{cell}`: must be a number")))
        };
        let row: Vec<f64> = cells.iter().zip(&columns).map(number).collect::<Result<_, _>>()?;
        if cells.len() != columns.len() || !series.push(row) {
            let message = format!(
                "the number of values is {}, that of columns {}",
                cells.len(),
                columns.len()
            );
            return Err(refused(line, message));
        }
    }
    Ok(series)
}
