use std::path::Path;

use mpm_vtk::collection;

use super::{names, write_whole};
use crate::SimulationError;

/// Writes the index that ParaView opens to see all frames as one animation: frame k is at `times[k]`.
///
/// # Errors
/// [`SimulationError::File`].
pub fn write_index(directory: &Path, times: &[f64]) -> Result<(), SimulationError> {
    let names: Vec<String> = (0..times.len() as u64).map(names::frame).collect();
    let text = collection(times.iter().copied().zip(names.iter().map(String::as_str)));
    write_whole(&directory.join(names::INDEX), text.as_bytes())
}
