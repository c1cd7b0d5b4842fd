use std::path::Path;

use super::{names, write_whole};
use crate::{SimulationError, ValidationRow};

/// Writes `validation.csv` with the columns quantity, measured, reference, tolerance, pass.
///
/// # Errors
/// [`SimulationError::File`].
pub fn write_validation(directory: &Path, rows: &[ValidationRow]) -> Result<(), SimulationError> {
    let path = directory.join(names::VALIDATION);
    let mut writer = csv::Writer::from_writer(Vec::new());
    let header = ["quantity", "measured", "reference", "tolerance", "pass"].map(str::to_owned);
    let lines = rows.iter().map(|row| {
        let numbers = [row.measured, row.reference, row.tolerance].map(super::number);
        let [measured, reference, tolerance] = numbers;
        [
            row.quantity.clone(),
            measured,
            reference,
            tolerance,
            row.passes().to_string(),
        ]
    });
    for line in std::iter::once(header).chain(lines) {
        let written = writer.write_record(&line);
        written.map_err(|error| SimulationError::file("write", &path, std::io::Error::other(error)))?;
    }
    let content = writer.into_inner();
    let content =
        content.map_err(|error| SimulationError::file("write", &path, std::io::Error::other(error.to_string())))?;
    write_whole(&path, &content)
}
