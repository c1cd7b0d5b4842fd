use std::path::Path;

use super::{names, number, write_whole};
use crate::SimulationError;

/// Writes the index that ParaView opens to see all frames as one animation: frame k is at `times[k]`.
///
/// # Errors
/// [`SimulationError::File`].
pub fn write_index(directory: &Path, times: &[f64]) -> Result<(), SimulationError> {
    let mut text = String::from(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n  <Collection>\n",
    );
    for (frame, &time) in times.iter().enumerate() {
        let (time, file) = (number(time), names::frame(frame as u64));
        text.push_str(&format!(
            "    <DataSet timestep=\"{time}\" part=\"0\" file=\"{file}\"/>\n"
        ));
    }
    text.push_str("  </Collection>\n</VTKFile>\n");
    write_whole(&directory.join(names::INDEX), text.as_bytes())
}
