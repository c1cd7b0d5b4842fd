//! The quantities of a run's history as panels of a figure.

use parvi::TracePoint;

use crate::plots::{AxisKind, ReferenceLevel, TracePanel, TraceSeries};

/// A quantity of [`TracePoint`].
pub struct TraceQuantity {
    /// The label of its axis.
    label: &'static str,
    axis: AxisKind,
    value: fn(&TracePoint) -> Option<f64>,
    /// The value for independent draws.
    level: Option<f64>,
    /// Whether only differences mean something.
    above_least: bool,
}

/// A quantity that is drawn as it is.
const fn plain(label: &'static str, axis: AxisKind, value: fn(&TracePoint) -> Option<f64>) -> TraceQuantity {
    TraceQuantity {
        label,
        axis,
        value,
        level: None,
        above_least: false,
    }
}

/// Galerkin–Stein residual.
pub const RESIDUAL: TraceQuantity = TraceQuantity {
    level: Some(1.0),
    ..plain("residual (1: independent draws)", AxisKind::Automatic, |row| {
        row.residual
    })
};

/// ½ Σ m |v|².
pub const KINETIC_ENERGY: TraceQuantity = plain("kinetic energy", AxisKind::Automatic, |row| Some(row.kinetic_energy));

/// −E\[log p\], above its least value: it is known up to a constant of the target.
pub const POTENTIAL_ENERGY: TraceQuantity = TraceQuantity {
    above_least: true,
    ..plain("potential energy above its least value", AxisKind::Linear, |row| {
        row.potential_energy
    })
};

/// Σ V⁰ Ψ(F).
const INTERNAL_ENERGY: TraceQuantity = plain("energy stored in the body", AxisKind::Linear, |row| row.internal_energy);

/// Largest displacement of a step before it was limited; in units of h where there is a grid.
const DISPLACEMENT: TraceQuantity = plain(
    "largest displacement of a step before limits",
    AxisKind::Automatic,
    |row| Some(row.displacement),
);

/// All quantities.
pub const ALL: [TraceQuantity; 5] = [
    RESIDUAL,
    KINETIC_ENERGY,
    POTENTIAL_ENERGY,
    INTERNAL_ENERGY,
    DISPLACEMENT,
];

impl TraceQuantity {
    /// Its panel for labelled runs; a run without values of it is left out.
    pub fn panel(&self, runs: &[(String, Vec<TracePoint>)]) -> TracePanel {
        let lines = runs.iter().map(|(label, rows)| self.line(label, rows));
        let level = |value| ReferenceLevel::new(value, "independent draws");
        TracePanel {
            levels: self.level.map(level).into_iter().collect(),
            ..TracePanel::new(self.label, self.axis, lines.filter(|line| !line.step.is_empty()))
        }
    }

    fn line(&self, label: &str, rows: &[TracePoint]) -> TraceSeries {
        let points = rows
            .iter()
            .filter_map(|row| Some((row.step as f64, (self.value)(row)?)));
        let mut line = TraceSeries::through(label, points);
        if self.above_least {
            let least = line.value.iter().copied().fold(f64::INFINITY, f64::min);
            line.value.iter_mut().for_each(|value| *value -= least);
        }
        line
    }
}
