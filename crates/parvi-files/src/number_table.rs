//! Tables of numbers that a user hands over: .csv with a header or without, .npy.

use std::path::Path;

use super::{FileError, ParticleFormat, npy};

/// Rows of as many numbers each.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NumberTable {
    /// What the columns are called; empty where the file does not say.
    pub header: Vec<String>,
    /// Numbers per row, at least 1.
    pub columns: usize,
    /// All of them, row by row.
    pub numbers: Vec<f64>,
}

impl NumberTable {
    /// Reads the file of a flag. A first line of a .csv that holds anything but numbers is a header; an .npy is f64, of one axis (a column) or of two.
    ///
    /// # Errors
    /// [`FileError::Extension`] of another file, [`FileError::NoTable`], with the line where it can be told.
    pub fn read(flag: &'static str, path: &Path) -> Result<Self, FileError> {
        let table = match ParticleFormat::of(flag, path)? {
            ParticleFormat::Csv => Self::of_csv(path),
            ParticleFormat::Npy => npy::table(path),
        };
        table.map_err(|reason| FileError::NoTable {
            flag,
            path: path.to_owned(),
            reason,
        })
    }

    /// Reads a table of comma-separated values.
    ///
    /// # Errors
    /// What is wrong with it, in words.
    pub fn of_csv(path: &Path) -> Result<Self, String> {
        let mut options = csv::ReaderBuilder::new();
        let reader = options.has_headers(false).trim(csv::Trim::All).from_path(path);
        let mut table = Self::default();
        for (row, record) in reader.map_err(in_words)?.records().enumerate() {
            let record = record.map_err(in_words)?;
            let line = record.position().map_or(row as u64 + 1, csv::Position::line);
            table.columns = record.len();
            let is_header = row == 0 && record.iter().any(|cell| cell.parse::<f64>().is_err());
            if is_header {
                table.header = record.iter().map(str::to_owned).collect();
                continue;
            }
            for cell in &record {
                let number = cell.parse();
                let number = number.map_err(|_| format!("line {line}: '{cell}' is not a number"))?;
                table.numbers.push(number);
            }
        }
        if table.numbers.is_empty() {
            return Err("it holds no numbers".to_owned());
        }
        Ok(table)
    }

    /// Rows.
    pub fn rows(&self) -> usize {
        self.numbers.len() / self.columns
    }
}

fn in_words(error: csv::Error) -> String {
    match error.is_io_error() {
        true => format!("cannot be read: {error}"),
        false => error.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(name: &str, text: &str) -> Result<NumberTable, String> {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join(name);
        std::fs::write(&path, text).unwrap();
        NumberTable::read("start", &path).map_err(|error| error.to_string().rsplit("x.").next().unwrap().to_owned())
    }

    #[test]
    fn a_header_is_no_row() {
        let expected = |header: &[&str]| NumberTable {
            header: header.iter().map(|name| (*name).to_owned()).collect(),
            columns: 2,
            numbers: vec![0.5, -1.0, 2.0, 3e-7],
        };
        assert_eq!(table("x.csv", "x1,x2\n0.5,-1\n2,3e-7\n"), Ok(expected(&["x1", "x2"])));
        assert_eq!(table("x.csv", "0.5, -1\n2, 3e-7\n"), Ok(expected(&[])));
        assert_eq!(expected(&[]).rows(), 2);
    }

    #[test]
    fn what_cannot_be_read_is_named_with_its_line() {
        let reason = |name: &str, text: &str| table(name, text).unwrap_err();
        assert_eq!(reason("x.csv", "x1\n1\ntwo\n"), "csv: line 3: 'two' is not a number");
        assert!(
            reason("x.csv", "x1,x2\n1,2\n3\n").contains("line: 3"),
            "{}",
            reason("x.csv", "x1,x2\n1,2\n3\n")
        );
        assert_eq!(reason("x.csv", "x1,x2\n"), "csv: it holds no numbers");
        assert_eq!(reason("x.txt", "1\n"), "txt: the extension must be .csv or .npy");
        assert!(!reason("x.npy", "no array").is_empty());
    }

    #[cfg(feature = "npy")]
    #[test]
    fn an_array_that_is_cut_off_is_called_so() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("x.npy");
        let whole = npy::array(&[2, 2], &[1.0, 2.0, 3.0, 4.0]).unwrap();
        for length in [9, 60, whole.len() - 8] {
            std::fs::write(&path, &whole[..length]).unwrap();
            let reason = NumberTable::read("start", &path).unwrap_err().to_string();
            assert!(
                reason.ends_with("x.npy: it ends too early: a part of the array is missing"),
                "{reason}"
            );
        }
    }
}
