//! What is drawn of each case, and the sizes that it grows with.

/// What is measured: label of its axis, with the unit; name of the figure's file, behind that of the sweep; and column.
pub const QUANTITIES: [(&str, &str, &str); 4] = [
    ("time per step (s)", "time", "wall_seconds_per_step"),
    ("active nodes", "nodes", "active_nodes"),
    ("storage of particles and grid (bytes)", "storage", "storage_bytes"),
    ("rise of the resident memory (bytes)", "memory", "memory_peak_bytes"),
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
