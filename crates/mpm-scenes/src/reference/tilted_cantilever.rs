//! A cantilever that falls under its full weight, turned together with its mesh (Cao et al. 2024, §3.3).

use super::cantilever::difference_of_tip;
use super::curve::Curve;
use super::parts::{Rows, Run, unfit};
use crate::Scene;

/// Fine cubic runs of the beam at rest with gravity tilted instead: t, displacements of the tip along and across the beam, for each angle in degrees, and
/// the error that Cao et al. reach at a mesh size of 0.5.
const FINE_RUNS: [(f64, &str, f64); 3] = [
    (15.0, include_str!("../../data/cantilever_tip_15.csv"), 0.0127),
    (30.0, include_str!("../../data/cantilever_tip_30.csv"), 0.0218),
    (45.0, include_str!("../../data/cantilever_tip_45.csv"), 0.0472),
];

/// Vertical displacement of the tip of the fine run at an angle, and the error that is allowed.
pub fn fine_run(degrees: f64) -> Option<(Curve, f64)> {
    if degrees == 0.0 {
        return Some((super::cantilever::fine_run(), 0.02));
    }
    let (_, text, tolerance) = FINE_RUNS.iter().find(|(angle, _, _)| *angle == degrees)?;
    let (sine, cosine) = degrees.to_radians().sin_cos();
    let curve = Curve::of_rows(text, |numbers| match numbers {
        [along, across] => Some(sine * along + cosine * across),
        _ => None,
    });
    Some((curve, *tolerance))
}

/// The fine run at the angle of a scene, with the tolerance.
pub(super) fn fine_run_of(scene: &Scene) -> Option<(Curve, f64)> {
    let rotation = scene.bodies.first().and_then(|body| body.rotation.as_ref());
    fine_run(rotation.map_or(0.0, |rotation| rotation.degrees))
}

/// Root mean square difference of the tip to the fine run over 3 s, over its peak.
///
/// # Errors
/// [`SceneFault::Value`](crate::SceneFault::Value) without the probe `tip`, or at an angle that there is no fine run for.
pub(super) fn validate(run: &Run) -> Rows {
    let fine = fine_run_of(run.scene);
    let (fine, tolerance) = fine.ok_or_else(|| unfit(run.scene, "for a turn of 0, 15, 30 or 45 degrees"))?;
    difference_of_tip(run, &fine, tolerance)
}
