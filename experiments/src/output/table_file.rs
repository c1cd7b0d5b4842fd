//! Records as a CSV file, a line each.

use std::path::Path;

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::AtomicFile;
use crate::CommandError;

/// Writes all records; a file that is there is replaced at once.
pub fn write<T: Serialize>(records: impl IntoIterator<Item = T>, path: &Path) -> Result<(), CommandError> {
    AtomicFile::filled(path, |writer| {
        let mut writer = csv::Writer::from_writer(writer);
        records.into_iter().try_for_each(|record| writer.serialize(record))?;
        writer.flush()
    })
}

/// Reads what [`write`](fn@write) wrote.
pub fn read<T: DeserializeOwned>(path: &Path) -> Result<Vec<T>, CommandError> {
    let unreadable = |error: csv::Error| CommandError::unreadable(path, error);
    let mut reader = csv::Reader::from_path(path).map_err(unreadable)?;
    reader.deserialize().collect::<Result<_, _>>().map_err(unreadable)
}
