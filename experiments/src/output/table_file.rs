//! Records as a CSV file, a line each.

use std::path::Path;

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::AtomicFile;
use crate::CommandError;

/// Writes all records; a file that is there is replaced at once.
pub fn write<T: Serialize>(records: impl IntoIterator<Item = T>, path: &Path) -> Result<(), CommandError> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for record in records {
        writer
            .serialize(record)
            .map_err(|error| CommandError::file("write", path, std::io::Error::other(error)))?;
    }
    let text = writer
        .into_inner()
        .map_err(|error| CommandError::file("write", path, error.into_error()))?;
    AtomicFile::write(path, text)
}

/// Reads what [`write`](fn@write) wrote.
pub fn read<T: DeserializeOwned>(path: &Path) -> Result<Vec<T>, CommandError> {
    let unreadable = |error: csv::Error| CommandError::unreadable(path, error);
    let mut reader = csv::Reader::from_path(path).map_err(unreadable)?;
    reader.deserialize().collect::<Result<_, _>>().map_err(unreadable)
}
