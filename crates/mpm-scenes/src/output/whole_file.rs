use std::fs::{self, File};
use std::io::Write;
use std::path::Path;

use crate::SimulationError;

/// Replaces a file as a whole: whoever reads it, and whenever the process ends, finds the old one or the new one.
///
/// # Errors
/// [`SimulationError::File`].
pub fn write_whole(path: &Path, content: &[u8]) -> Result<(), SimulationError> {
    let mut part = path.to_owned().into_os_string();
    part.push(".partial");
    let replaced = File::create(&part).and_then(|mut file| {
        file.write_all(content)?;
        file.sync_all()?;
        fs::rename(&part, path)
    });
    replaced.map_err(|error| {
        let _ = fs::remove_file(&part);
        SimulationError::file("write", path, error)
    })
}
