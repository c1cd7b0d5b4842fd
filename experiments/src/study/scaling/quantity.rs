//! What is measured per case, and its growth with the size that a sweep varies.

use crate::plots::scaling_fit;
use crate::study::prelude::*;

/// A measured quantity.
pub struct Measured {
    /// Name for tables.
    pub name: &'static str,
    /// Label of an axis, with the unit.
    pub axis: &'static str,
    /// Name of the figure's file, without sweep and extension; `None` for what a table says better.
    pub file: Option<&'static str>,
    value: Computed,
}

const fn measured(name: &'static str, axis: &'static str, file: Option<&'static str>, value: Computed) -> Measured {
    Measured {
        name,
        axis,
        file,
        value,
    }
}

/// All quantities.
pub const QUANTITIES: [Measured; 5] = [
    measured("time per step", "time per step (s)", Some("time"), |row| {
        row.number("wall_seconds_per_step")
    }),
    measured("active nodes", "active nodes", Some("nodes"), |row| {
        row.number("active_nodes")
    }),
    measured(
        "storage",
        "storage of particles and grid (bytes)",
        Some("storage"),
        |row| row.number("storage_bytes"),
    ),
    measured(
        "peak memory",
        "rise of the resident memory (bytes)",
        Some("memory"),
        |row| row.number("memory_peak_bytes"),
    ),
    measured(
        "score evaluations per step",
        "score evaluations per step",
        None,
        |row| Some(row.number("score_evaluations")? / row.number("steps").filter(|steps| *steps > 0.0)?),
    ),
];

impl Measured {
    /// Its values in one dimension of a sweep against the size that the sweep varies, M or k.
    pub fn series(&self, rows: &Rows<'_>, sweep: &str, dim: Dimension) -> LineSeries {
        let size = |row: &Row| row.number("nodes_per_axis").or(row.number("particles"));
        let here = rows.with("sweep", sweep).with("dim", dim);
        let (x, y) = here
            .iter()
            .filter_map(|row| Some((size(row)?, (self.value)(row)?)))
            .unzip();
        LineSeries {
            x,
            y,
            ..LineSeries::named(format!("d = {dim}"))
        }
    }

    /// The fitted exponent with its 95 % interval.
    pub fn exponent(&self, rows: &Rows<'_>, sweep: &str, dim: Dimension, fit_from: f64) -> String {
        let law = scaling_fit(&self.series(rows, sweep, dim), fit_from);
        law.map(|law| exponent_text(&law, 0)).cell()
    }
}
