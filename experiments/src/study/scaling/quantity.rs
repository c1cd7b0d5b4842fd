//! What is measured per case, and its growth with the size that a sweep varies.

use crate::plots::page::MISSING;
use crate::plots::{LineSeries, exponent_text, scaling_fit};
use crate::study::run_row::RunRow;

/// A measured quantity.
pub struct Quantity {
    /// Name for tables.
    pub name: &'static str,
    /// Label of an axis, with the unit.
    pub axis: &'static str,
    /// Name of the figure's file, without sweep and extension; `None` for what a table says better.
    pub file: Option<&'static str>,
    /// Its value.
    pub value: fn(&RunRow) -> Option<f64>,
}

/// All quantities.
pub const QUANTITIES: [Quantity; 5] = [
    Quantity {
        name: "time per step",
        axis: "time per step (s)",
        file: Some("time"),
        value: |row| row.wall_seconds_per_step,
    },
    Quantity {
        name: "active nodes",
        axis: "active nodes",
        file: Some("nodes"),
        value: |row| row.active_nodes.map(|count| count as f64),
    },
    Quantity {
        name: "storage",
        axis: "storage of particles and grid (bytes)",
        file: Some("storage"),
        value: |row| row.storage_bytes.map(|bytes| bytes as f64),
    },
    Quantity {
        name: "peak memory",
        axis: "rise of the resident memory (bytes)",
        file: Some("memory"),
        value: |row| row.memory_peak_bytes.map(|bytes| bytes as f64),
    },
    Quantity {
        name: "score evaluations per step",
        axis: "score evaluations per step",
        file: None,
        value: |row| Some(row.score_evaluations? as f64 / row.steps.filter(|steps| *steps > 0)? as f64),
    },
];

impl Quantity {
    /// Its values in one dimension of a sweep against the size that the sweep varies.
    pub fn series(&self, rows: &[RunRow], sweep: &str, dim: usize) -> LineSeries {
        let here = rows.iter().filter(|row| row.sweep == sweep && row.dim == dim);
        let (x, y) = here.filter_map(|row| Some((size(row), (self.value)(row)?))).unzip();
        LineSeries {
            x,
            y,
            ..LineSeries::named(format!("d = {dim}"))
        }
    }

    /// The fitted exponent with its 95 % interval.
    pub fn exponent(&self, rows: &[RunRow], sweep: &str, dim: usize, fit_from: f64) -> String {
        scaling_fit(&self.series(rows, sweep, dim), fit_from).map_or(MISSING.to_owned(), |law| exponent_text(&law, 0))
    }
}

/// M or k, whichever the sweep varies.
fn size(row: &RunRow) -> f64 {
    row.nodes_per_axis.unwrap_or(row.particles) as f64
}
