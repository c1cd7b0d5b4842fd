//! States near the frames of training runs, and what steps from them say of the velocities of all points.

use mpm_tensor::vector;

use super::ExperimentError;
use super::chosen::Readings;
use super::sampling::Sampling;
use super::spread::evenly;
use crate::deformation_map::DeformationMap;
use crate::least_squares::{GaussNewton, LeastSquares, Settings};
use crate::manifold::{Evaluation, Wanted};
use crate::online::{KnownPoints, Quadrature, Reading, ReducedBody, ReducedModel, Search};
use crate::snapshots::Frame;

/// Training runs that are read, at most, and frames of each.
const RUNS: usize = 8;
const FRAMES: usize = 6;

impl<const D: usize> Sampling<'_, D> {
    /// Steps from frames of several training runs and from states around them at these distances; those from the frames themselves once for each distance.
    pub(super) fn readings(&self, distances: &[f64]) -> Result<Readings<D>, ExperimentError> {
        let (mut steps, mut known) = (Vec::new(), None);
        for distance in distances {
            for run in evenly(self.snapshots.runs().len(), RUNS) {
                steps.extend(self.steps((run, *distance), &mut known)?);
            }
        }
        Ok(Readings {
            positions: self.snapshots.reference().to_vec(),
            steps,
        })
    }

    /// Steps from some frames of a run and from states around them, read at all recorded points, which are `known` in the body of every run alike. States from which there is no step, because the map is inverted there for example, are left out.
    fn steps(
        &self,
        (run, distance): (usize, f64),
        known: &mut Option<KnownPoints>,
    ) -> Result<Vec<Reading<D>>, ExperimentError> {
        let (body, recorded) = (ReducedBody::<D>::of(&self.scene(run)?)?, self.snapshots.reference());
        let squares: f64 = recorded.iter().map(vector::norm_squared).sum();
        let distance = distance * (squares / recorded.len().max(1) as f64).sqrt();
        let guess = self.guess(recorded)?;
        let map = DeformationMap::new(self.manifold, recorded, &guess)?;
        let known = known.get_or_insert_with(|| KnownPoints::nearest(&body.reference, recorded));
        let everywhere = Quadrature::Lagrangian { search: Search::All };
        let mut reduced = ReducedModel::to_read(body, map, known.numbers().to_vec(), everywhere)?;
        let frames = &self.snapshots.runs()[run].frames;
        let mut readings = Vec::new();
        for index in along_path(frames, FRAMES) {
            let (frame, time) = (&frames[index], frames[index].time);
            let guess = self.guess(&frame.positions)?;
            let Some((latent, rates)) = fitted(&reduced, frame, guess) else {
                continue;
            };
            let mut states = vec![latent.clone()];
            if distance > 0.0 {
                states.extend(reduced.states_around(&latent, distance));
            }
            let steps = states.iter().map(|state| reduced.reading(state, &rates, time));
            readings.extend(steps.flatten());
        }
        Ok(readings)
    }
}

/// At most `most` frames, evenly spaced along the way that the points go together, up to its end; never the first one, where nothing moves yet. A motion may be over soon, and most frames those of a
/// body at rest.
fn along_path<const D: usize>(frames: &[Frame<D>], most: usize) -> Vec<usize> {
    let mut way = vec![0.0];
    for pair in frames.windows(2) {
        way.push(way[way.len() - 1] + pair[1].moved_from(&pair[0]).sqrt());
    }
    let whole = way[way.len() - 1];
    let mut chosen: Vec<usize> = (1..=most)
        .filter_map(|n| {
            let part = whole * n as f64 / most as f64;
            (1..way.len()).find(|&k| way[k] >= part * (1.0 - 1e-9))
        })
        .collect();
    chosen.dedup();
    chosen
}

/// x̂ and v̂ that come nearest to a frame: argmin Σ|g − φ|² and argmin Σ|∂g/∂x̂ v̂ − v|².
fn fitted<const D: usize>(
    reduced: &ReducedModel<'_, D>,
    frame: &Frame<D>,
    guess: Vec<f64>,
) -> Option<(Vec<f64>, Vec<f64>)> {
    let mut latent = guess;
    let evaluate = |y: &[f64], wanted: Wanted, out: &mut Evaluation<D>| reduced.evaluate_at(y, wanted, out);
    GaussNewton::default()
        .minimise(&frame.positions, &mut latent, &Settings::default(), evaluate)
        .ok()?;
    let mut there = Evaluation::default();
    reduced.evaluate_at(&latent, Wanted::JACOBIANS, &mut there);
    let mut rates = vec![0.0; latent.len()];
    LeastSquares::default()
        .solve(&there.jacobians, &frame.velocities, &mut rates)
        .ok()?;
    Some((latent, rates))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_spread_over_the_way_not_the_time() {
        let frame = |x: f64| Frame {
            time: 0.0,
            positions: vec![[x], [x + 1.0]],
            deformation_gradients: Vec::new(),
            velocities: Vec::new(),
        };
        let mut frames: Vec<Frame<1>> = (0..=10).map(|k| frame(f64::from(k))).collect();
        frames.extend((0..90).map(|_| frame(10.0)));
        assert_eq!(along_path(&frames, 5), [2, 4, 6, 8, 10]);
        assert_eq!(along_path(&frames[..3], 5), [1, 2]);
        assert_eq!(along_path(&frames[10..20], 2), [1], "a body at rest");
        assert!(along_path(&frames[..1], 5).is_empty());
    }
}
