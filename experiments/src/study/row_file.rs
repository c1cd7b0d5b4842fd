//! Rows as a CSV file: of each the cells of some columns, whose names are given with spaces between.

use std::path::Path;

use super::value::{Written, read as cell};
use crate::CommandError;
use crate::output::AtomicFile;
use crate::plots::results::Row;

/// The rows as lines, after a header where one is asked for.
///
/// # Errors
/// None that a text of memory has.
pub fn lines<'a>(
    columns: &str,
    with_header: bool,
    rows: impl IntoIterator<Item = &'a Row>,
) -> Result<Vec<u8>, csv::Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    if with_header {
        writer.write_record(columns.split(' '))?;
    }
    for row in rows {
        let cells: Vec<Written<'_>> = columns.split(' ').map(|column| Written(row.value(column))).collect();
        writer.serialize(cells)?;
    }
    writer.into_inner().map_err(|error| error.into_error().into())
}

/// Writes all rows; a file that is there is replaced at once. Without rows it is empty.
///
/// # Errors
/// [`CommandError::File`].
pub fn write(path: &Path, columns: &str, rows: &[Row]) -> Result<(), CommandError> {
    let text = lines(columns, !rows.is_empty(), rows);
    let text = text.map_err(|error| CommandError::file("write", path, std::io::Error::other(error)))?;
    AtomicFile::write(path, text)
}

/// Reads the rows; a last line without its end is skipped.
///
/// # Errors
/// [`CommandError::File`], or [`CommandError::ResultsUnreadable`] with the line that does not fit.
pub fn read(path: &Path, columns: &'static str) -> Result<Vec<Row>, CommandError> {
    let mut bytes = std::fs::read(path).map_err(|source| CommandError::file("read", path, source))?;
    bytes.truncate(whole(&bytes));
    parse(path, &bytes, columns)
}

/// The length of the lines that have an end.
pub fn whole(bytes: &[u8]) -> usize {
    let end = bytes.iter().rposition(|&byte| byte == b'\n');
    end.map_or(0, |position| position + 1)
}

/// The rows of a file; what it holds in other columns is left alone.
///
/// # Errors
/// [`CommandError::ResultsUnreadable`].
pub fn parse(path: &Path, bytes: &[u8], columns: &'static str) -> Result<Vec<Row>, CommandError> {
    let unreadable = |message: String| CommandError::ResultsUnreadable {
        file: path.display().to_string(),
        message,
    };
    let mut reader = csv::Reader::from_reader(bytes);
    let header = reader.headers().map_err(|error| unreadable(error.to_string()))?.clone();
    let place = |column: &'static str| Some((column, header.iter().position(|name| name == column)?));
    let places: Vec<(&str, usize)> = columns.split(' ').filter_map(place).collect();
    let first = columns.split(' ').next();
    if !bytes.is_empty() && places.first().map(|(column, _)| *column) != first {
        let first = first.unwrap_or_default();
        return Err(unreadable(format!("line 1: the column `{first}` is missing")));
    }
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|error| unreadable(error.to_string()))?;
        let line = record.position().map_or(0, csv::Position::line);
        let mut row = Row::default();
        for &(column, place) in &places {
            let value = cell(column, record.get(place).unwrap_or_default());
            row.set(
                column,
                value.map_err(|message| unreadable(format!("line {line}: {message}")))?,
            );
        }
        rows.push(row);
    }
    Ok(rows)
}
