//! The history of a run as a file.

use std::path::Path;

use parvi::TracePoint;
use serde::{Deserialize, Serialize};

use crate::CommandError;
use crate::output::AtomicFile;

/// One entry; the fields are those of [`TracePoint`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TraceRow {
    /// Step, from 1.
    pub step: usize,
    /// Pseudo-time.
    pub time: f64,
    /// Residual relative to i.i.d. draws.
    pub residual: Option<f64>,
    /// Kinetic energy.
    pub kinetic_energy: f64,
    /// Potential energy.
    pub potential_energy: Option<f64>,
    /// Largest displacement of a node in units of h.
    pub displacement: f64,
}

impl From<&TracePoint> for TraceRow {
    fn from(point: &TracePoint) -> Self {
        Self {
            step: point.step,
            time: point.time,
            residual: point.residual,
            kinetic_energy: point.kinetic_energy,
            potential_energy: point.potential_energy,
            displacement: point.displacement,
        }
    }
}

/// Writes a history.
pub fn write(trace: &[TracePoint], path: &Path) -> Result<(), CommandError> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for point in trace {
        writer
            .serialize(TraceRow::from(point))
            .map_err(|error| CommandError::file("write", path, std::io::Error::other(error)))?;
    }
    let text = writer
        .into_inner()
        .map_err(|error| CommandError::file("write", path, error.into_error()))?;
    AtomicFile::write(path, text)
}

/// Reads what [`write`] wrote.
pub fn read(path: &Path) -> Result<Vec<TraceRow>, CommandError> {
    let unreadable = |error: csv::Error| CommandError::ResultsUnreadable {
        file: path.display().to_string(),
        message: error.to_string(),
    };
    let mut reader = csv::Reader::from_path(path).map_err(unreadable)?;
    reader.deserialize().collect::<Result<_, _>>().map_err(unreadable)
}
