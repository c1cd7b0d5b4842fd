use std::io::ErrorKind;
use std::path::Path;

use super::names;
use crate::SimulationError;

/// Removes the frames of an earlier run and their index from a directory, and nothing else: a file that no run would write stays.
///
/// # Errors
/// [`SimulationError::File`] for a directory or a file of it that the system refuses; a directory that does not exist has no frames.
pub fn remove_frames(directory: &Path) -> Result<(), SimulationError> {
    let refused = |error| SimulationError::file("read", directory, error);
    let entries = match std::fs::read_dir(directory) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(()),
        entries => entries.map_err(refused)?,
    };
    for entry in entries {
        let entry = entry.map_err(refused)?;
        let own = entry
            .file_name()
            .to_str()
            .is_some_and(|name| name == names::INDEX || is_frame(name));
        if own {
            remove_file(&entry.path())?;
        }
    }
    Ok(())
}

/// Removes a file, if there is one.
///
/// # Errors
/// [`SimulationError::File`].
pub fn remove_file(path: &Path) -> Result<(), SimulationError> {
    match std::fs::remove_file(path) {
        Err(error) if error.kind() != ErrorKind::NotFound => Err(SimulationError::file("remove", path, error)),
        _ => Ok(()),
    }
}

/// Whether a name is that of a frame of any number.
fn is_frame(name: &str) -> bool {
    let digits = name
        .strip_prefix("particles_")
        .and_then(|rest| rest.strip_suffix(".vtu"));
    let number = digits.and_then(|digits| digits.parse().ok());
    number.is_some_and(|number| names::frame(number) == name)
}
