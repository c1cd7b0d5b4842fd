//! Water, sand and clay, on coarse grids.

use super::problem::{pinned, run};

#[test]
fn the_surge_front_is_that_of_martin_and_moyce() {
    let coarse = run(
        "dam_break",
        &[
            ("spacing = 0.0028575", "spacing = 0.005715"),
            ("courant = 0.3", "courant = 0.6"),
        ],
    );
    coarse.passes_as_pinned("dam_break");
}

/// Half of the collapse.
#[test]
fn a_column_of_sand_spreads_as_before() {
    let sand = run(
        "column_collapse",
        &[
            ("end = 2.0", "end = 1.0"),
            ("spacing = 0.05", "spacing = 0.1"),
            ("courant = 0.4", "courant = 0.8"),
        ],
    );
    let front = sand.column("upper_x");
    assert!(front.windows(2).all(|pair| pair[1] >= pair[0] - 1e-3));
    pinned("column_collapse", "front at 1 s", front[front.len() - 1]);
}

/// Until the toe has failed.
#[test]
fn a_slope_of_clay_fails_as_before() {
    let clay = run(
        "clay_slope",
        &[("end = 3.0", "end = 2.0"), ("spacing = 0.4", "spacing = 1.0")],
    );
    for (column, quantity) in [("centre_x", "centre at 2 s"), ("upper_x", "front at 2 s")] {
        pinned(
            "clay_slope",
            quantity,
            clay.column(column).last().copied().unwrap_or(f64::NAN),
        );
    }
}
