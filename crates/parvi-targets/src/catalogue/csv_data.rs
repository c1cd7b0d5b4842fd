//! Regression data from CSV files: a header, the response in the first column, covariates in the others.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use csv::StringRecord;

use crate::data::LARGEST_VALUE;
use crate::{MAXIMUM_DIMENSION, RegressionTable, Response, TargetError};

impl<Y: Response> RegressionTable<Y> {
    /// Reads a CSV file: a header line, the response (0 or 1, or a count) in the first column, covariates as they are in
    /// the others.
    /// An intercept is added in front, so that d = number of columns. Blank lines are skipped, blanks around cells too.
    ///
    /// # Errors
    /// The `Data…` variants of [`TargetError`], with the file, the line, the column's name and the offending cell.
    pub fn from_csv_file(path: &Path) -> Result<Self, TargetError> {
        let source = path.display().to_string();
        let file = File::open(path).map_err(|e| TargetError::DataUnreadable {
            file: source.clone(),
            reason: e.to_string(),
        })?;
        Self::from_csv_reader(file, &source)
    }

    /// As [`from_csv_file`](Self::from_csv_file), for any reader; `source` stands for the file in error messages.
    ///
    /// # Errors
    /// As [`from_csv_file`](Self::from_csv_file).
    pub fn from_csv_reader(reader: impl Read, source: &str) -> Result<Self, TargetError> {
        let mut reader = csv::ReaderBuilder::new()
            .flexible(true)
            .trim(csv::Trim::All)
            .from_reader(reader);
        let header = reader.headers().map_err(|e| unreadable(source, &e))?.clone();
        let names = column_names(&header, source)?;
        let mut data = Self::empty(source, names[1..].iter().cloned());
        let mut record = StringRecord::new();
        let mut covariates = Vec::with_capacity(names.len() - 1);
        while reader.read_record(&mut record).map_err(|e| unreadable(source, &e))? {
            // Nothing but blanks.
            if record.iter().eq([""]) {
                continue;
            }
            let row = Row {
                record: &record,
                source,
                names: &names,
            };
            row.check_length()?;
            let response = row.response()?;
            covariates.clear();
            for column in 1..names.len() {
                covariates.push(row.number(column, LARGEST_VALUE)?);
            }
            data.push(response, &covariates);
        }
        data.non_empty()
    }
}

fn unreadable(source: &str, error: &csv::Error) -> TargetError {
    TargetError::DataUnreadable {
        file: source.to_owned(),
        reason: error.to_string(),
    }
}

fn line_of(record: &StringRecord) -> u64 {
    record.position().map_or(1, csv::Position::line)
}

/// The names of the header: at least one, not all numbers, none empty, none twice, not more than there are dimensions.
fn column_names(header: &StringRecord, source: &str) -> Result<Vec<String>, TargetError> {
    let (file, line) = (source.to_owned(), line_of(header));
    if header.is_empty() {
        return Err(TargetError::DataEmpty { file });
    }
    if header.iter().all(|name| name.parse::<f64>().is_ok()) {
        return Err(TargetError::DataHeaderMissing { file, line });
    }
    let mut names: Vec<String> = Vec::with_capacity(header.len());
    for (index, name) in header.iter().enumerate() {
        if name.is_empty() {
            return Err(TargetError::DataHeaderEmpty {
                file,
                line,
                column: index + 1,
            });
        }
        if names.iter().any(|known| known == name) {
            return Err(TargetError::DataHeaderDuplicate {
                file,
                line,
                column: name.to_owned(),
            });
        }
        names.push(name.to_owned());
    }
    if names.len() > MAXIMUM_DIMENSION {
        return Err(TargetError::DataTooManyCovariates {
            file,
            found: names.len() - 1,
            maximum: MAXIMUM_DIMENSION - 1,
        });
    }
    Ok(names)
}

/// One line of data with what an error message needs.
struct Row<'a> {
    record: &'a StringRecord,
    source: &'a str,
    names: &'a [String],
}

impl Row<'_> {
    fn check_length(&self) -> Result<(), TargetError> {
        if self.record.len() == self.names.len() {
            return Ok(());
        }
        Err(TargetError::DataRaggedRow {
            file: self.source.to_owned(),
            line: line_of(self.record),
            expected: self.names.len(),
            found: self.record.len(),
        })
    }

    /// The number in a column, no larger than `largest` in size.
    fn number(&self, column: usize, largest: f64) -> Result<f64, TargetError> {
        let text = self.record.get(column).unwrap_or_default();
        let (file, line, column) = (self.source.to_owned(), line_of(self.record), self.names[column].clone());
        if text.is_empty() {
            return Err(TargetError::DataMissingCell { file, line, column });
        }
        match text.parse::<f64>() {
            Ok(value) if value.abs() <= largest => Ok(value),
            Ok(finite) if finite.is_finite() => Err(TargetError::DataTooLarge {
                file,
                line,
                column,
                value: text.to_owned(),
                largest,
            }),
            Ok(_) => Err(TargetError::DataNotFinite {
                file,
                line,
                column,
                value: text.to_owned(),
            }),
            Err(_) => Err(TargetError::DataNotNumeric {
                file,
                line,
                column,
                value: text.to_owned(),
            }),
        }
    }

    /// The first column's 0 or 1, or count.
    fn response<Y: Response>(&self) -> Result<Y, TargetError> {
        Y::from_number(self.number(0, f64::MAX)?).ok_or_else(|| TargetError::DataResponse {
            file: self.source.to_owned(),
            line: line_of(self.record),
            column: self.names[0].clone(),
            value: self.record.get(0).unwrap_or_default().to_owned(),
            allowed: Y::ALLOWED,
        })
    }
}
