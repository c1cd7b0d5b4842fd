//! The slope of sensitive clay on a mesh (Cao et al. 2024, §3.5), against structured grids.

use super::parts::{Rows, Run, last, unfit};
use crate::ValidationRow;
use crate::scene::ShapeTable;

/// Run-out in m after 3 s on a structured grid of 0.2 m: `clay_slope.toml` with `spacing = 0.2` and `softening_rate = 5.0` (docs/results/mechanics).
pub const STRUCTURED: f64 = 10.62;

/// The run-out, of the outermost particle and half the distance between particles from where the base ends, within 5 % of the structured grid's.
///
/// # Errors
/// [`SceneFault::Value`](crate::SceneFault::Value) where a column is missing.
pub(super) fn validate(run: &Run) -> Rows {
    let body = run.scene.bodies.first();
    let base = body.and_then(|body| base(&body.shape));
    let base = base.ok_or_else(|| unfit(run.scene, "for a polygon or the corner of a box as the first body"))?;
    let half = 0.5 * body.and_then(|body| body.spacing).unwrap_or(f64::NAN);
    let run_out = last(&run.curve("upper_x")?) + half - base;
    Ok(vec![ValidationRow::near(
        "run-out",
        run_out,
        STRUCTURED,
        0.05 * STRUCTURED,
    )])
}

/// Where the base of a slope ends: that of a polygon, or of the first box of an intersection.
pub(super) fn base(shape: &ShapeTable) -> Option<f64> {
    match shape {
        ShapeTable::Polygon { corners } => Some(corners.iter().map(|corner| corner[0]).fold(f64::NAN, f64::max)),
        ShapeTable::Box { upper, .. } => upper.first().copied(),
        ShapeTable::Intersection { shapes } => shapes.iter().find_map(base),
        _ => None,
    }
}
