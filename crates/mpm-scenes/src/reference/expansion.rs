//! A compressed body that expands inside a rigid sphere (Cao et al. 2024, §3.6).

use super::parts::{Rows, Run};
use crate::ValidationRow;

/// The body comes to rest: its kinetic energy at the end is at most 1 % of its peak (ours); and no particle has left the sphere, which the barrier
/// itself sees to.
///
/// # Errors
/// [`SceneFault::Value`](crate::SceneFault::Value) where a column is missing.
pub(super) fn validate(run: &Run) -> Rows {
    let kinetic = run.curve("kinetic_energy")?;
    Ok(vec![ValidationRow::at_most(
        "kinetic energy at the end / peak",
        kinetic.last() / kinetic.peak(),
        0.01,
    )])
}
