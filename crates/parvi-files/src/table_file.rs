//! Records as a CSV file, a line each.

use std::path::Path;

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::{AtomicFile, FileError};

/// Writes all records; a file that is there is replaced at once.
///
/// # Errors
/// [`FileError::System`].
pub fn write<T: Serialize>(records: impl IntoIterator<Item = T>, path: &Path) -> Result<(), FileError> {
    AtomicFile::filled(path, |writer| {
        let mut writer = csv::Writer::from_writer(writer);
        records.into_iter().try_for_each(|record| writer.serialize(record))?;
        writer.flush()
    })
}

/// Reads what [`write`](fn@write) wrote.
///
/// # Errors
/// [`FileError::Unreadable`] with the line that does not fit.
pub fn read<T: DeserializeOwned>(path: &Path) -> Result<Vec<T>, FileError> {
    let unreadable = |error: csv::Error| FileError::unreadable(path, error);
    let mut reader = csv::Reader::from_path(path).map_err(unreadable)?;
    reader.deserialize().collect::<Result<_, _>>().map_err(unreadable)
}
