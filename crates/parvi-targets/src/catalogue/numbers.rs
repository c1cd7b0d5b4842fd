//! Tables of numbers that are embedded in the crate.

use crate::TargetError;

/// The rows of a CSV file with a header and K columns of numbers.
pub(crate) fn rows<const K: usize>(file: &str, text: &str) -> Result<Vec<[f64; K]>, TargetError> {
    let row = |line: &str| {
        let cells: Result<Vec<f64>, _> = line.split(',').map(str::parse).collect();
        <[f64; K]>::try_from(cells.ok()?).ok()
    };
    let read = |line: &str| {
        row(line).ok_or_else(|| TargetError::DataUnreadable {
            file: file.to_owned(),
            reason: format!("'{line}' is no row of length {K}"),
        })
    };
    text.lines().skip(1).map(read).collect()
}

/// The numbers of a CSV file with a header and one column.
pub(crate) fn series(file: &str, text: &str) -> Result<Vec<f64>, TargetError> {
    Ok(rows::<1>(file, text)?.into_iter().map(|[y]| y).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_numbers() {
        assert_eq!(
            rows::<2>("a.csv", "x,y\n1,-2\n3.5,4e1\n"),
            Ok(vec![[1.0, -2.0], [3.5, 40.0]])
        );
        assert_eq!(series("a.csv", "y\n"), Ok(vec![]));
        for bad in ["x,y\n1\n", "x,y\n1,2,3\n", "x,y\n1,two\n"] {
            let error = rows::<2>("a.csv", bad).unwrap_err().to_string();
            assert!(error.starts_with("cannot read a.csv: '1"), "{error}");
        }
    }
}
