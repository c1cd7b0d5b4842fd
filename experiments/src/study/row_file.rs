//! Rows as a CSV file: of each the cells of some columns, whose names are given with spaces between.

use std::io::{self, Write};
use std::path::Path;

use parvi_files::AtomicFile;
use parvi_options::is_among;

use super::value::read as cell;
use crate::CommandError;
use crate::plots::results::Row;

/// Writes the rows as lines, after a header where one is asked for.
///
/// # Errors
/// Those of the writer.
pub fn fill<'a>(
    writer: &mut dyn Write,
    columns: &str,
    with_header: bool,
    rows: impl IntoIterator<Item = &'a Row>,
) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(writer);
    if with_header {
        writer.write_record(columns.split(' '))?;
    }
    for row in rows {
        writer.serialize(columns.split(' ').map(|column| row.value(column)).collect::<Vec<_>>())?;
    }
    writer.flush()
}

/// Writes all rows; a file that is there is replaced at once. Without rows it is empty.
///
/// # Errors
/// [`CommandError::Files`].
pub fn write(path: &Path, columns: &str, rows: &[Row]) -> Result<(), CommandError> {
    let content = |writer: &mut dyn Write| fill(writer, columns, !rows.is_empty(), rows);
    Ok(AtomicFile::filled(path, content)?)
}

/// Reads the rows; a last line without its end is skipped.
///
/// # Errors
/// [`CommandError::Files`], with the line that does not fit.
pub fn read(path: &Path, columns: &str) -> Result<Vec<Row>, CommandError> {
    parse(path, &whole_lines(path)?, columns)
}

/// The same with all columns that the file has.
///
/// # Errors
/// As for [`read`].
#[cfg(feature = "rom")]
pub fn read_all(path: &Path) -> Result<Vec<Row>, CommandError> {
    parse_columns(path, &whole_lines(path)?, |_| true)
}

fn whole_lines(path: &Path) -> Result<Vec<u8>, CommandError> {
    let mut bytes = std::fs::read(path).map_err(|source| CommandError::file("read", path, source))?;
    bytes.truncate(whole(&bytes));
    Ok(bytes)
}

/// The length of the lines that have an end.
pub fn whole(bytes: &[u8]) -> usize {
    let end = bytes.iter().rposition(|&byte| byte == b'\n');
    end.map_or(0, |position| position + 1)
}

/// The rows of a file; what it holds in other columns is left alone.
///
/// # Errors
/// [`CommandError::Files`].
pub fn parse(path: &Path, bytes: &[u8], columns: &str) -> Result<Vec<Row>, CommandError> {
    let first = columns.split(' ').next().unwrap_or_default();
    let header = bytes.split(|&byte| byte == b'\n').next().unwrap_or_default();
    if !bytes.is_empty() && !header.split(|&byte| byte == b',').any(|name| name == first.as_bytes()) {
        let message = format!("line 1: the column `{first}` is missing");
        return Err(CommandError::unreadable(path, message));
    }
    parse_columns(path, bytes, |name| is_among(columns, name))
}

fn parse_columns(path: &Path, bytes: &[u8], is_read: impl Fn(&str) -> bool) -> Result<Vec<Row>, CommandError> {
    let mut reader = csv::Reader::from_reader(bytes);
    let refused = |error: csv::Error| CommandError::unreadable(path, error);
    let header = reader.headers().map_err(refused)?.clone();
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record.map_err(refused)?;
        let line = record.position().map_or(0, csv::Position::line);
        let mut row = Row::default();
        for (column, text) in header.iter().zip(&record).filter(|(column, _)| is_read(column)) {
            let value = cell(column, text);
            let value = value.map_err(|message| CommandError::unreadable(path, format!("line {line}: {message}")))?;
            row.set(column.to_owned(), value);
        }
        rows.push(row);
    }
    Ok(rows)
}
