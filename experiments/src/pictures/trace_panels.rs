//! The quantities of a run's history as panels of a figure.

use parvi::TracePoint;

use crate::plots::{AxisKind, ReferenceLevel, TracePanel, TraceSeries};

/// A quantity of [`TracePoint`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TraceQuantity {
    /// Galerkin–Stein residual.
    Residual,
    /// ½ Σ m |v|².
    KineticEnergy,
    /// −E\[log p\], above its least value: it is known up to a constant of the target.
    PotentialEnergy,
    /// Σ V⁰ Ψ(F).
    InternalEnergy,
    /// Largest displacement of a step before it was limited; in units of h where there is a grid.
    Displacement,
}

impl TraceQuantity {
    /// All quantities.
    pub const ALL: [Self; 5] = [
        Self::Residual,
        Self::KineticEnergy,
        Self::PotentialEnergy,
        Self::InternalEnergy,
        Self::Displacement,
    ];

    /// Its panel for labelled runs; a run without values of it is left out.
    pub fn panel(self, runs: &[(String, Vec<TracePoint>)]) -> TracePanel {
        let label = match self {
            Self::Residual => "residual (1: independent draws)",
            Self::KineticEnergy => "kinetic energy",
            Self::PotentialEnergy => "potential energy above its least value",
            Self::InternalEnergy => "energy stored in the body",
            Self::Displacement => "largest displacement of a step before limits",
        };
        let level = ReferenceLevel::new(1.0, "independent draws");
        TracePanel {
            y_label: label.to_owned(),
            y_axis: if matches!(self, Self::PotentialEnergy | Self::InternalEnergy) {
                AxisKind::Linear
            } else {
                AxisKind::Automatic
            },
            series: runs
                .iter()
                .filter_map(|(label, rows)| self.series(label, rows))
                .collect(),
            levels: if self == Self::Residual {
                vec![level]
            } else {
                Vec::new()
            },
        }
    }

    fn value(self, row: &TracePoint) -> Option<f64> {
        match self {
            Self::Residual => row.residual,
            Self::KineticEnergy => Some(row.kinetic_energy),
            Self::PotentialEnergy => row.potential_energy,
            Self::InternalEnergy => row.internal_energy,
            Self::Displacement => Some(row.displacement),
        }
    }

    fn series(self, label: &str, rows: &[TracePoint]) -> Option<TraceSeries> {
        let points = rows.iter().filter_map(|row| Some((row.step as f64, self.value(row)?)));
        let (step, mut value): (Vec<f64>, Vec<f64>) = points.unzip();
        if self == Self::PotentialEnergy {
            let least = value.iter().copied().fold(f64::INFINITY, f64::min);
            value.iter_mut().for_each(|value| *value -= least);
        }
        (!step.is_empty()).then(|| TraceSeries {
            label: label.to_owned(),
            step,
            value,
        })
    }
}
