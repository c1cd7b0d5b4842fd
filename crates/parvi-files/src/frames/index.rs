//! Which frames there are.

use std::path::Path;

use mpm_vtk::collection;
use serde::{Deserialize, Serialize};

use super::names;
use crate::{AtomicFile, FileError, table_file};

/// A frame in the index.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Entry {
    /// What its files are called by.
    pub frame: String,
    /// Steps of the run.
    pub step: usize,
    /// Number of the body; empty for what the run returned.
    pub body: Option<usize>,
    /// Pseudo-time of the body; empty for what the run returned.
    pub pseudo_time: Option<f64>,
}

/// Writes the tables of the frames: `frames.csv` and, for ParaView, `frames.pvd`, whose times are the steps; what the run returned is one step behind the last one.
///
/// # Errors
/// [`FileError::System`].
pub fn write(directory: &Path, entries: &[Entry]) -> Result<(), FileError> {
    let time = |k: usize| match entries[k].body {
        Some(_) => entries[k].step as f64,
        None => time_of_returned(&entries[..k]),
    };
    let file = |k: usize| (time(k), names::vtp(&entries[k].frame));
    let files: Vec<_> = (0..entries.len()).map(file).collect();
    let files = files.iter().map(|(time, file)| (*time, file.as_str()));
    AtomicFile::write(directory.join(names::COLLECTION), collection(files))?;
    table_file::write(entries, &directory.join(names::TABLE))
}

/// The time of the animation that what the run returned has behind these frames.
pub fn time_of_returned(entries: &[Entry]) -> f64 {
    entries.last().map_or(0.0, |entry| entry.step as f64 + 1.0)
}

/// The frames that an earlier process left, without what a run returned; `None` where there is no table.
///
/// # Errors
/// [`FileError::Unreadable`].
pub fn read(directory: &Path) -> Result<Option<Vec<Entry>>, FileError> {
    let path = directory.join(names::TABLE);
    if !path.exists() {
        return Ok(None);
    }
    let mut entries: Vec<Entry> = table_file::read(&path)?;
    entries.retain(|entry| entry.body.is_some());
    Ok(Some(entries))
}
