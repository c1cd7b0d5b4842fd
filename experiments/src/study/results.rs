//! results.csv: one row per finished case, appended whole.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::CommandError;

/// The file's name.
pub const FILE_NAME: &str = "results.csv";

/// A row of results.
pub trait Row: Serialize + DeserializeOwned {
    /// The case it belongs to; also the first column.
    fn case(&self) -> &str;
}

/// The open file and the rows in it; locked against a second process.
pub struct ResultsFile<R> {
    path: PathBuf,
    file: File,
    rows: Vec<R>,
    has_header: bool,
    /// The columns to write; none: all that a row has.
    columns: Vec<&'static str>,
}

impl<R: Row> ResultsFile<R> {
    /// Opens the file, creates it if there is none, and cuts off a last line that was not written to its end. Of rows to come it will hold
    /// these columns, without any all.
    ///
    /// # Errors
    /// [`CommandError::File`], [`CommandError::DirectoryOccupied`] if another process works on it, or
    /// [`CommandError::ResultsUnreadable`] with the line that does not fit.
    pub fn open(path: &Path, columns: &'static str) -> Result<Self, CommandError> {
        let failed = |operation| move |source| CommandError::file(operation, path, source);
        let mut file = OpenOptions::new()
            .read(true)
            .write(true)
            .create(true)
            .truncate(false)
            .open(path)
            .map_err(failed("write"))?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                return Err(CommandError::DirectoryOccupied {
                    directory: path.display().to_string(),
                    occupant: "is being written by another process".to_owned(),
                });
            }
            // A file system without locks does not keep a single process from working.
            Err(TryLockError::Error(_)) => {}
        }
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes).map_err(failed("read"))?;
        let whole = whole(&bytes);
        if whole < bytes.len() {
            file.set_len(whole as u64).map_err(failed("write"))?;
            bytes.truncate(whole);
        }
        file.seek(SeekFrom::Start(whole as u64)).map_err(failed("read"))?;
        Ok(Self {
            rows: parse(path, &bytes)?,
            has_header: whole > 0,
            path: path.to_owned(),
            file,
            columns: columns.split_whitespace().collect(),
        })
    }

    /// Reads the rows without changing the file; a last line without its end is skipped.
    pub fn read(path: &Path) -> Result<Vec<R>, CommandError> {
        let mut bytes = std::fs::read(path).map_err(|source| CommandError::file("read", path, source))?;
        bytes.truncate(whole(&bytes));
        parse(path, &bytes)
    }

    /// The rows so far, in the order of the file.
    pub fn rows(&self) -> &[R] {
        &self.rows
    }

    /// Adds a row with one write and waits until it is on the disk.
    pub fn append(&mut self, row: R) -> Result<(), CommandError> {
        let failed = |source| CommandError::file("write", &self.path, source);
        let line = self.line(&row).map_err(|error| failed(std::io::Error::other(error)))?;
        self.file
            .write_all(&line)
            .and_then(|()| self.file.sync_data())
            .map_err(failed)?;
        self.has_header = true;
        self.rows.push(row);
        Ok(())
    }

    /// The row as a line, after a header where the file has none yet.
    fn line(&self, row: &R) -> Result<Vec<u8>, csv::Error> {
        let mut all = csv::Writer::from_writer(Vec::new());
        all.serialize(row)?;
        let all = all.into_inner().map_err(|error| error.into_error())?;
        let mut reader = csv::Reader::from_reader(all.as_slice());
        let header = reader.headers()?.clone();
        let is_written = |name: &&str| self.columns.is_empty() || self.columns.contains(name);
        let mut order: Vec<usize> = (0..header.len()).filter(|&k| is_written(&&header[k])).collect();
        order.sort_by_key(|&k| self.columns.iter().position(|name| *name == &header[k]));
        let mut writer = csv::Writer::from_writer(Vec::new());
        if !self.has_header {
            writer.write_record(order.iter().map(|&k| &header[k]))?;
        }
        for record in reader.records() {
            let record = record?;
            writer.write_record(order.iter().map(|&k| &record[k]))?;
        }
        writer.into_inner().map_err(|error| error.into_error().into())
    }
}

/// The length of the lines that have an end.
fn whole(bytes: &[u8]) -> usize {
    let end = bytes.iter().rposition(|&byte| byte == b'\n');
    end.map_or(0, |position| position + 1)
}

fn parse<R: Row>(path: &Path, bytes: &[u8]) -> Result<Vec<R>, CommandError> {
    csv::Reader::from_reader(bytes)
        .deserialize()
        .map(|row| {
            row.map_err(|error| CommandError::ResultsUnreadable {
                file: path.display().to_string(),
                message: error.to_string(),
            })
        })
        .collect()
}

/// A text for one cell: without line breaks, so that a file whose last line has no end was cut off.
pub fn single_line(text: impl ToString) -> String {
    text.to_string().split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use serde::Deserialize;

    use super::*;

    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    struct Example {
        case: String,
        value: Option<f64>,
    }

    impl Row for Example {
        fn case(&self) -> &str {
            &self.case
        }
    }

    fn row(case: &str, value: Option<f64>) -> Example {
        Example {
            case: case.to_owned(),
            value,
        }
    }

    #[test]
    fn rows_survive_closing_the_file() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join(FILE_NAME);
        let mut results = ResultsFile::open(&path, "").unwrap();
        results.append(row("a, with comma", Some(0.1 + 0.2))).unwrap();
        drop(results);
        let mut results = ResultsFile::open(&path, "").unwrap();
        results.append(row("b", None)).unwrap();
        drop(results);
        let expected = [row("a, with comma", Some(0.1 + 0.2)), row("b", None)];
        assert_eq!(ResultsFile::<Example>::read(&path).unwrap(), expected);
    }

    #[test]
    fn a_torn_line_is_dropped_wherever_it_was_torn() {
        let whole = "case,value\na,1.0\nb,2.0\n";
        for length in 0..whole.len() {
            let directory = tempfile::tempdir().unwrap();
            let path = directory.path().join(FILE_NAME);
            std::fs::write(&path, &whole[..length]).unwrap();
            let mut results = ResultsFile::open(&path, "").unwrap();
            for (case, value) in [("a", 1.0), ("b", 2.0)] {
                if !results.rows().iter().any(|row: &Example| row.case == case) {
                    results.append(row(case, Some(value))).unwrap();
                }
            }
            assert_eq!(std::fs::read_to_string(&path).unwrap(), whole, "cut at {length}");
        }
    }

    #[test]
    fn only_the_columns_asked_for_are_written_in_their_order() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join(FILE_NAME);
        let mut results = ResultsFile::open(&path, "value case").unwrap();
        results.append(row("a \"b\", c", Some(0.1))).unwrap();
        assert_eq!(
            std::fs::read_to_string(&path).unwrap(),
            "value,case\n0.1,\"a \"\"b\"\", c\"\n"
        );
        let mut cases = ResultsFile::open(&directory.path().join("cases"), "case").unwrap();
        cases.append(row("a", Some(0.1))).unwrap();
        drop(cases);
        assert_eq!(
            ResultsFile::<Example>::read(&directory.path().join("cases")).unwrap(),
            [row("a", None)]
        );
    }

    #[test]
    fn a_second_writer_is_refused() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join(FILE_NAME);
        let _first = ResultsFile::<Example>::open(&path, "").unwrap();
        let message = ResultsFile::<Example>::open(&path, "").err().unwrap().to_string();
        assert!(message.contains("another process"), "{message}");
    }

    #[test]
    fn foreign_columns_are_reported() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join(FILE_NAME);
        std::fs::write(&path, "x,y\n1,2\n").unwrap();
        let message = ResultsFile::<Example>::open(&path, "").err().unwrap().to_string();
        assert!(message.contains("missing field `case`"), "{message}");
    }
}
