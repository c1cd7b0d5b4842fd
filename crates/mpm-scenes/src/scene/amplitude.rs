//! `ramp` and `amplitude` of loads.

use mpm_core::Amplitude;

use crate::SceneFault;
use crate::values::{not_negative, within};

/// What the keys `ramp` and `amplitude` of a load say; all of it from the start without either.
///
/// # Errors
/// [`SceneFault::Value`] for both, and for numbers out of range.
pub(crate) fn amplitude(
    field: &dyn Fn(&str) -> String,
    ramp: Option<f64>,
    points: Option<&Vec<[f64; 2]>>,
) -> Result<Amplitude, SceneFault> {
    let Some(points) = points else {
        return not_negative(&field("ramp"), ramp.unwrap_or(0.0)).map(Amplitude::ramp);
    };
    within(&field("ramp"), ramp, ramp.is_none(), "left out beside an amplitude")?;
    let expected = "at least one pair of a time and a share, finite and in the order of the times";
    let through = Amplitude::through(points.clone()).filter(|_| !points.is_empty());
    through.ok_or_else(|| SceneFault::value(field("amplitude"), points, expected))
}
