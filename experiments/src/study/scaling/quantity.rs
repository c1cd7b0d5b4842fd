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
    /// The column.
    column: &'static str,
}

const fn measured(
    name: &'static str,
    axis: &'static str,
    file: Option<&'static str>,
    column: &'static str,
) -> Measured {
    Measured {
        name,
        axis,
        file,
        column,
    }
}

/// Time per step.
pub const TIME: &str = "wall_seconds_per_step";

/// All quantities.
pub const QUANTITIES: [Measured; 5] = [
    measured("time per step", "time per step (s)", Some("time"), TIME),
    measured("active nodes", "active nodes", Some("nodes"), "active_nodes"),
    measured(
        "storage",
        "storage of particles and grid (bytes)",
        Some("storage"),
        "storage_bytes",
    ),
    measured(
        "peak memory",
        "rise of the resident memory (bytes)",
        Some("memory"),
        "memory_peak_bytes",
    ),
    measured(
        "score evaluations per step",
        "score evaluations per step",
        None,
        "scores_per_step",
    ),
];

/// A sweep over sizes.
pub struct Sweep {
    /// Its name in tables and files.
    pub name: &'static str,
    /// The column of the size that it varies.
    pub size: &'static str,
    /// The symbol of that …
    pub symbol: &'static str,
    /// … and the label of its axis.
    pub label: &'static str,
}

/// Over d and M.
pub const PARTICLES: Sweep = Sweep {
    name: "particles",
    size: "particles",
    symbol: "M",
    label: "number of particles M",
};

/// Over k.
pub const NODES: Sweep = Sweep {
    name: "nodes",
    size: "nodes_per_axis",
    symbol: "k",
    label: "nodes per axis k",
};

impl Measured {
    /// Its values in one dimension of a sweep against the size that the sweep varies, M or k.
    pub fn series(&self, rows: &Rows<'_>, sweep: &Sweep, dim: Dimension) -> LineSeries {
        let here = rows.with("sweep", sweep.name).with("dim", dim);
        here.line(format!("d = {dim}"), sweep.size, self.column)
    }

    /// The fitted exponent with its 95 % interval.
    pub fn exponent(&self, rows: &Rows<'_>, sweep: &Sweep, dim: Dimension, fit_from: f64) -> String {
        let law = scaling_fit(&self.series(rows, sweep, dim), fit_from);
        law.map(|law| exponent_text(&law, 0)).cell()
    }
}
