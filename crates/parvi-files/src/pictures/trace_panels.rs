//! The quantities of a run's history as panels of a figure.

use parvi::TracePoint;
use parvi_plot::{AxisKind, MultiplesPanel, TraceQuantity};

/// Galerkin–Stein residual.
pub const RESIDUAL: TraceQuantity<TracePoint> = TraceQuantity {
    level: Some((1.0, "independent draws")),
    ..TraceQuantity::plain("residual (1: independent draws)", AxisKind::Automatic, |row| {
        row.residual
    })
};

/// ½ Σ m |v|².
pub const KINETIC_ENERGY: TraceQuantity<TracePoint> =
    TraceQuantity::plain("kinetic energy", AxisKind::Automatic, |row| Some(row.kinetic_energy));

/// −E\[log p\], above its least value: it is known up to a constant of the target.
pub const POTENTIAL_ENERGY: TraceQuantity<TracePoint> = TraceQuantity {
    above_least: true,
    ..TraceQuantity::plain("potential energy above its least value", AxisKind::Linear, |row| {
        row.potential_energy
    })
};

/// Σ V⁰ Ψ(F).
const INTERNAL_ENERGY: TraceQuantity<TracePoint> =
    TraceQuantity::plain("energy stored in the body", AxisKind::Linear, |row| row.internal_energy);

/// Largest displacement of a step before it was limited; in units of h where there is a grid.
const DISPLACEMENT: TraceQuantity<TracePoint> = TraceQuantity::plain(
    "largest displacement of a step before limits",
    AxisKind::Automatic,
    |row| Some(row.displacement),
);

/// All quantities.
pub const ALL: [TraceQuantity<TracePoint>; 5] = [
    RESIDUAL,
    KINETIC_ENERGY,
    POTENTIAL_ENERGY,
    INTERNAL_ENERGY,
    DISPLACEMENT,
];

/// The panels of some of them for labelled runs.
pub fn panels<const N: usize>(
    quantities: [TraceQuantity<TracePoint>; N],
    runs: &[(String, Vec<TracePoint>)],
) -> [MultiplesPanel; N] {
    quantities.map(|quantity| quantity.panel(runs, |row| row.step as f64))
}
