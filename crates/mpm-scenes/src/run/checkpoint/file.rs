//! The file: a magic line, a checksum, CBOR.

use std::path::Path;

use mpm_document::fingerprint;

use super::Saved;
use crate::SimulationError;
use crate::output::write_whole;

/// What a checkpoint begins with; its checksum and content follow.
const MAGIC: &[u8] = b"mpm-scenes checkpoint 1\n";

/// Replaces the file as a whole.
///
/// # Errors
/// [`SimulationError::File`], [`SimulationError::Checkpoint`].
pub fn write(path: &Path, saved: &Saved) -> Result<(), SimulationError> {
    let content = cbor4ii::serde::to_vec(Vec::new(), saved).map_err(|error| refused(path, error.to_string()))?;
    let bytes = [MAGIC, &fingerprint(&content).to_le_bytes(), &content].concat();
    write_whole(path, &bytes)
}

/// The content of a file, if there is one.
///
/// # Errors
/// [`SimulationError::Checkpoint`] for one that is damaged, [`SimulationError::File`] for one that cannot be read.
pub fn read(path: &Path) -> Result<Option<Saved>, SimulationError> {
    let bytes = match std::fs::read(path) {
        Ok(bytes) => bytes,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(SimulationError::file("read", path, error)),
    };
    let content = bytes.strip_prefix(MAGIC).and_then(|rest| rest.split_first_chunk());
    let whole = content.filter(|(sum, content)| u64::from_le_bytes(**sum) == fingerprint(content));
    let saved = whole.and_then(|(_, content)| cbor4ii::serde::from_slice(content).ok());
    let damaged = || {
        refused(
            path,
            "it is damaged or no checkpoint; remove it to begin again".to_owned(),
        )
    };
    saved.map(Some).ok_or_else(damaged)
}

pub fn refused(path: &Path, reason: String) -> SimulationError {
    SimulationError::Checkpoint {
        path: path.to_owned(),
        reason,
    }
}
