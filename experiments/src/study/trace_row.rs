//! The history of a run as a file has it.

use parvi::TracePoint;
use serde::{Deserialize, Serialize};

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
    /// Energy stored in the body, where it stores one.
    pub internal_energy: Option<f64>,
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
            internal_energy: point.internal_energy,
            displacement: point.displacement,
        }
    }
}
