//! The slope of sensitive clay on a mesh (Cao et al. 2024, §3.5), against structured grids.

use super::parts::{Rows, Run, unfit};
use crate::ValidationRow;
use crate::scene::ShapeTable;

/// Run-outs in m after 3 s on structured grids, by the distance between particles in m: `clay_slope.toml` with `particles_per_axis = 2`, `spacing` twice that distance and
/// `softening_rate` 5 `spacing` / 0.2 m (docs/results/umls).
const STRUCTURED: [[f64; 2]; 4] = [[0.05, 10.26], [0.1, 10.85], [0.15, 11.01], [0.2, 11.20]];

/// The run-out, of the outermost particle and half the distance between particles from where the base ends, within 5 % of that on a structured grid with as many particles.
///
/// # Errors
/// [`SceneFault::Value`](crate::SceneFault::Value) where a column is missing.
pub(super) fn validate(run: &Run) -> Rows {
    let body = run.scene.bodies.first();
    let base = body.and_then(|body| base(&body.shape));
    let base = base.ok_or_else(|| unfit(run.scene, "for a polygon or the corner of a box as the first body"))?;
    let spacing = body.and_then(|body| body.spacing).unwrap_or(f64::NAN);
    let run_out = run.curve("upper_x")?.last() + 0.5 * spacing - base;
    let expected = structured(spacing);
    Ok(vec![ValidationRow::near("run-out", run_out, expected, 0.05 * expected)])
}

/// The run-out on a structured grid, between the distances that have been run by a straight line, beyond them that of the last.
fn structured(spacing: f64) -> f64 {
    let between = STRUCTURED.array_windows().find(|[_, [upper, _]]| spacing < *upper);
    match between {
        Some([[lower, near], [upper, far]]) => near + (far - near) * ((spacing - lower) / (upper - lower)).max(0.0),
        None => STRUCTURED[STRUCTURED.len() - 1][1],
    }
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

#[cfg(test)]
mod tests {
    use super::structured;

    #[test]
    fn structured_run_outs_are_joined_by_lines() {
        assert_eq!(
            [0.01, 0.05, 0.1, 0.2, 3.0].map(structured),
            [10.26, 10.26, 10.85, 11.20, 11.20]
        );
        assert!((structured(0.125) - 0.5 * (10.85 + 11.01)).abs() < 1e-12);
    }
}
