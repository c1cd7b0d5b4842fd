//! A soft ball that falls through a wavy channel (Cao et al. 2024, §3.4).

use super::parts::{Rows, Run, last};
use crate::ValidationRow;

/// Below this height the channel has half a wave: a quarter of the wave length 10 of its shorter factor.
const PASSED: f64 = 2.5;

/// The ball passes: at some time all of it lies below y = 2.5 (the channel's floor is at y = 0); no particle is lost; the energy never grows by more than 1 % of
/// what the fall has freed (ours).
///
/// That no particle passes a wall the barrier itself sees to: it is an error of the run.
///
/// # Errors
/// [`SceneFault::Value`](crate::SceneFault::Value) where a column is missing.
pub(super) fn validate(run: &Run) -> Rows {
    let top = run.curve("upper_y")?.values.into_iter().fold(f64::INFINITY, f64::min);
    let mut total = run.curve("kinetic_energy")?;
    for name in ["strain_energy", "potential_energy", "barrier_energy"] {
        let part = run.curve(name)?;
        total
            .values
            .iter_mut()
            .zip(&part.values)
            .for_each(|(sum, value)| *sum += value);
    }
    let potential = run.curve("potential_energy")?;
    let start = total.values.first().copied().unwrap_or(f64::NAN);
    let freed = potential.values.first().copied().unwrap_or(f64::NAN) - last(&potential);
    let most = total
        .values
        .iter()
        .fold(f64::NEG_INFINITY, |most: f64, &energy| most.max(energy));
    let asked: u32 = run.scene.bodies.iter().filter_map(|body| body.particles).sum();
    let finite = run.last.positions.iter().filter(|c| c.is_finite()).count() / run.last.dimension.max(1);
    Ok(vec![
        ValidationRow::at_most("lowest position of the highest particle", top, PASSED),
        ValidationRow::at_most("particles lost", f64::from(asked) - finite as f64, 0.0),
        ValidationRow::at_most("energy gained / freed by the fall", (most - start) / freed, 0.01),
    ])
}
