//! A soft ball that falls through a wavy channel (Cao et al. 2024, §3.4).

use super::parts::{Rows, Run};
use crate::scene::{Discretisation, MeshShapeTable, MeshTable};
use crate::{Snapshot, ValidationRow};

/// Below this height above y = 0, and so above any floor, the channel has half a wave: a quarter of the wave length 10 of its shorter factor.
const PASSED: f64 = 2.5;

/// Particles at most this many spacings (V^(1/D), V the particle's volume) from each other hold together.
const TOGETHER: f64 = 3.0;

/// The ball passes: at some time all of it lies less than 2.5 above the channel's floor; no particle is lost; at the end the largest piece of it has 99 % of its mass; the
/// energy never grows by more than 1 % of what the fall has freed (ours).
///
/// That no particle passes a wall the barrier itself sees to: it is an error of the run.
///
/// # Errors
/// [`SceneFault::Value`](crate::SceneFault::Value) where a column is missing.
pub(super) fn validate(run: &Run) -> Rows {
    let floor = match run.scene.discretisation()? {
        Discretisation::Mesh(MeshTable {
            generate: Some(MeshShapeTable::Channel { floor, .. }),
            ..
        }) => *floor,
        _ => 0.0,
    };
    let top = run.curve("upper_y")?.values.into_iter().fold(f64::INFINITY, f64::min);
    let mut total = run.curve("kinetic_energy")?;
    for name in ["strain_energy", "potential_energy", "barrier_energy"] {
        if name == "barrier_energy" && run.scene.barrier.is_none() {
            continue;
        }
        total = total.plus(&run.curve(name)?);
    }
    let potential = run.curve("potential_energy")?;
    let (start, freed) = (total.first(), potential.first() - potential.last());
    let most = total
        .values
        .iter()
        .fold(f64::NEG_INFINITY, |most: f64, &energy| most.max(energy));
    let asked: u32 = run.scene.bodies.iter().filter_map(|body| body.particles).sum();
    let finite = run.last.positions.iter().filter(|c| c.is_finite()).count() / run.last.dimension.max(1);
    Ok(vec![
        ValidationRow::at_most(
            "lowest position of the highest particle above the floor",
            top - floor,
            PASSED,
        ),
        ValidationRow::at_most("particles lost", f64::from(asked) - finite as f64, 0.0),
        ValidationRow::at_most("mass torn off", 1.0 - largest_piece(run.last), 0.01),
        ValidationRow::at_most("energy gained / freed by the fall", (most - start) / freed, 0.01),
    ])
}

/// The largest share of the mass whose particles hold together.
fn largest_piece(last: &Snapshot) -> f64 {
    let mut rest: Vec<usize> = (0..last.len()).collect();
    let mut largest = 0.0;
    while let Some(first) = rest.pop() {
        let (mut front, mut mass) = (vec![first], last.masses[first]);
        while let Some(p) = front.pop() {
            let (near, far) = rest.iter().partition(|&&q| together(last, p, q));
            rest = far;
            let near: Vec<usize> = near;
            mass += near.iter().map(|&q| last.masses[q]).sum::<f64>();
            front.extend(near);
        }
        largest = f64::max(largest, mass);
    }
    largest / last.masses.iter().sum::<f64>()
}

fn together(last: &Snapshot, p: usize, q: usize) -> bool {
    let (Some(x), Some(y)) = (last.vector(&last.positions, p), last.vector(&last.positions, q)) else {
        return false;
    };
    let spacing = |p: usize| (last.reference_volumes[p] * last.volume_ratios[p]).powf(1.0 / last.dimension as f64);
    let square: f64 = x.iter().zip(y).map(|(a, b)| (a - b).powi(2)).sum();
    square.sqrt() <= TOGETHER * spacing(p).max(spacing(q))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_torn_body_is_seen() {
        let row = |x: &[f64]| Snapshot {
            dimension: 1,
            positions: x.to_vec(),
            masses: vec![1.0; x.len()],
            reference_volumes: vec![0.1; x.len()],
            volume_ratios: vec![1.0; x.len()],
            ..Snapshot::default()
        };
        assert_eq!(largest_piece(&row(&[0.3, 0.0, 0.1, 0.2])), 1.0);
        assert_eq!(largest_piece(&row(&[0.9, 0.0, 0.1, 0.2])), 0.75);
    }
}
