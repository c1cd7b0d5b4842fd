//! results.csv: one row per finished case, appended whole.

use std::collections::HashSet;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use super::row_file;
use crate::CommandError;
use crate::plots::results::Row;

/// The file's name.
pub const FILE_NAME: &str = "results.csv";

/// The open file, locked against a second process.
pub struct ResultsFile {
    path: PathBuf,
    file: File,
    has_header: bool,
    has_other_columns: bool,
    columns: &'static str,
}

impl ResultsFile {
    /// Opens the file, creates it if there is none, and cuts off a last line that was not written to its end. Of every row it holds these
    /// columns, with spaces between; the rows so far come with it.
    ///
    /// # Errors
    /// [`CommandError::Files`], [`CommandError::Refused`] if another process works on it, or
    /// [`CommandError::Files`] with the line that does not fit.
    pub fn open(path: &Path, columns: &'static str) -> Result<(Self, Vec<Row>), CommandError> {
        let failed = |operation| move |source| CommandError::file(operation, path, source);
        let mut options = OpenOptions::new();
        options.read(true).write(true).create(true).truncate(false);
        let mut file = options.open(path).map_err(failed("write"))?;
        // A file system without locks does not keep a single process from working.
        if let Err(TryLockError::WouldBlock) = file.try_lock() {
            return Err(CommandError::occupied(path, "is being written by another process"));
        }
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes).map_err(failed("read"))?;
        let whole = row_file::whole(&bytes);
        if whole < bytes.len() {
            file.set_len(whole as u64).map_err(failed("write"))?;
            bytes.truncate(whole);
        }
        file.seek(SeekFrom::Start(whole as u64)).map_err(failed("read"))?;
        let header = bytes.split(|&byte| byte == b'\n').next().unwrap_or_default();
        let results = Self {
            has_header: whole > 0,
            has_other_columns: whole > 0 && header.trim_ascii_end() != columns.replace(' ', ",").as_bytes(),
            path: path.to_owned(),
            file,
            columns,
        };
        Ok((results, once_each(path, row_file::parse(path, &bytes, columns)?)?))
    }

    /// Refuses rows under the names of others.
    ///
    /// # Errors
    /// [`CommandError::Refused`] where the file has other columns, or these in another order.
    pub fn takes_rows(&self) -> Result<(), CommandError> {
        match self.has_other_columns {
            false => Ok(()),
            true => Err(CommandError::occupied(
                &self.path,
                "has other columns than this version of the study writes",
            )),
        }
    }

    /// Adds a row with one write and waits until it is on the disk.
    pub fn append(&mut self, row: &Row) -> Result<(), CommandError> {
        let failed = |source| CommandError::file("write", &self.path, source);
        let mut lines = Vec::new();
        row_file::fill(&mut lines, self.columns, !self.has_header, [row]).map_err(failed)?;
        self.file.write_all(&lines).map_err(failed)?;
        self.file.sync_data().map_err(failed)?;
        self.has_header = true;
        Ok(())
    }
}

/// Reads the rows; a last line without its end is skipped.
///
/// # Errors
/// [`CommandError::Files`], with the line that does not fit.
pub fn read(path: &Path, columns: &str) -> Result<Vec<Row>, CommandError> {
    once_each(path, row_file::read(path, columns)?)
}

/// The rows, unless a case has two: it would count twice.
fn once_each(path: &Path, rows: Vec<Row>) -> Result<Vec<Row>, CommandError> {
    let mut seen = HashSet::new();
    match rows.iter().position(|row| !seen.insert(row.case())) {
        None => Ok(rows),
        Some(place) => {
            let message = format!(
                "line {}: the case `{}` has a row already",
                place + 2,
                rows[place].case()
            );
            Err(CommandError::unreadable(path, message))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const COLUMNS: &str = "case value";

    fn row(case: &str, value: Option<f64>) -> Row {
        Row::of(case).with("value", value)
    }

    #[test]
    fn rows_survive_closing_the_file() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join(FILE_NAME);
        let (mut results, _) = ResultsFile::open(&path, COLUMNS).unwrap();
        results.append(&row("a, with comma", Some(0.1 + 0.2))).unwrap();
        drop(results);
        let (mut results, _) = ResultsFile::open(&path, COLUMNS).unwrap();
        results.append(&row("b", None)).unwrap();
        drop(results);
        let expected = [row("a, with comma", Some(0.1 + 0.2)), row("b", None)];
        assert_eq!(read(&path, COLUMNS).unwrap(), expected);
    }

    #[test]
    fn a_torn_line_is_dropped_wherever_it_was_torn() {
        let whole = "case,value\na,1.0\nb,2.0\n";
        for length in 0..whole.len() {
            let directory = tempfile::tempdir().unwrap();
            let path = directory.path().join(FILE_NAME);
            std::fs::write(&path, &whole[..length]).unwrap();
            let (mut results, rows) = ResultsFile::open(&path, COLUMNS).unwrap();
            for (case, value) in [("a", 1.0), ("b", 2.0)] {
                if !rows.iter().any(|row| row.case() == case) {
                    results.append(&row(case, Some(value))).unwrap();
                }
            }
            assert_eq!(std::fs::read_to_string(&path).unwrap(), whole, "cut at {length}");
        }
    }

    #[test]
    fn only_the_columns_asked_for_are_written_in_their_order() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join(FILE_NAME);
        let (mut results, _) = ResultsFile::open(&path, "case steps note seed").unwrap();
        let row = row("a \"b\", c", Some(0.1))
            .with("seed", u64::MAX)
            .with("steps", 3_usize);
        results.append(&row).unwrap();
        assert_eq!(
            std::fs::read_to_string(&path).unwrap(),
            "case,steps,note,seed\n\"a \"\"b\"\", c\",3,,18446744073709551615\n"
        );
    }

    #[test]
    fn a_second_writer_is_refused() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join(FILE_NAME);
        let _first = ResultsFile::open(&path, COLUMNS).unwrap();
        let message = ResultsFile::open(&path, COLUMNS).err().unwrap().to_string();
        assert!(message.contains("another process"), "{message}");
    }

    #[test]
    fn what_no_study_writes_is_reported() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join(FILE_NAME);
        for (text, expected) in [
            ("x,y\n1,2\n", "line 1: the column `case` is missing"),
            ("case,value\na,1.0\nb,two\n", "line 3: `two` in the column `value`"),
            ("case,status\na,fine\n", "line 2: `fine` is no `status`"),
            ("case,value\na\n", "line"),
            ("case,value\na,1\nb,1\na,2\n", "line 4: the case `a` has a row already"),
        ] {
            std::fs::write(&path, text).unwrap();
            let message = read(&path, "case status value").err().unwrap().to_string();
            assert!(message.contains(expected), "{message}");
        }
    }
}
