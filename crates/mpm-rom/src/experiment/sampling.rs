//! Sample points chosen on training runs.

use std::collections::HashMap;

use mpm_scenes::Scene;
use mpm_tensor::vector;

use super::beside::{Choice, Full, beside};
use super::{ChoiceName, Experiment, ExperimentError, ManifoldName, SampleCount};
use crate::deformation_map::DeformationMap;
use crate::full_order::{FullOrderError, SceneDocument};
use crate::least_squares::{GaussNewton, LeastSquares, Settings};
use crate::manifold::{Evaluation, Manifold, Wanted};
use crate::model::Model;
use crate::online::{
    Inverted, Options, Quadrature, Reading, ReducedBody, ReducedModel, SampleChoice, Search, Update, choose_greedily,
};
use crate::snapshots::{Frame, Run, Snapshots};

/// Training runs that are read, at most, and frames of each.
const RUNS: usize = 8;
const FRAMES: usize = 6;

/// Distances of the states around each frame, over the root mean square of the points' distance from the centroid. Without such states a choice knows only errors on the way, and not
/// whether a run comes back to it; how far a run strays is not known beforehand.
const DISTANCES: [f64; 5] = [0.0, 0.002, 0.005, 0.01, 0.02];

/// Training runs that choices are tried on, at most, and frames of each.
const TRIAL_RUNS: usize = 3;
const TRIAL_FRAMES: usize = 91;

/// Larger numbers of sample points are not tried: choices then differ little.
const MOST_TRIED: usize = 24;

/// The distance (its place in the list) of the choice that is then taken.
const UNTRIED: usize = 1;

/// Choices made so far, by manifold, number of the network and number of points.
pub(super) type Chosen = HashMap<(ManifoldName, usize, usize), SampleChoice>;

/// Training runs and what is needed to step from their frames.
pub(super) struct Sampling<'a, const D: usize> {
    pub experiment: &'a Experiment,
    pub document: &'a SceneDocument,
    pub model: &'a Model<D>,
    /// Its number among those of the experiment.
    pub network: usize,
    pub snapshots: &'a Snapshots<D>,
}

impl<const D: usize> Sampling<'_, D> {
    /// Sample points for every number of them in the experiment.
    ///
    /// Candidates are what [`choose_greedily`] finds on steps from 6 frames of each of up to 8 training runs, evenly spaced along the way of the body, and from states around these frames at one of several distances.
    /// Each is tried on up to three training runs of at most 90 frames, and the one with the least mean position error is taken. Above 24 points nothing is tried, and the distance is 0.002.
    pub fn choose(
        &self,
        name: ManifoldName,
        manifold: &dyn Manifold<D>,
        into: &mut Chosen,
    ) -> Result<(), ExperimentError> {
        let body = ReducedBody::<D>::of(&self.scene(0)?)?;
        let (points, coordinates) = (body.reference.len(), manifold.coordinates());
        let mut readings = Vec::new();
        let counts = self.experiment.run.samples.iter().filter_map(|samples| match samples {
            SampleCount::Drawn(count) => Some(*count),
            SampleCount::All(_) => None,
        });
        let tried = counts.min().is_some_and(|least| least <= MOST_TRIED);
        for (place, distance) in DISTANCES.into_iter().enumerate() {
            if !tried && place != UNTRIED {
                readings.push(Vec::new());
                continue;
            }
            let mut of_distance = Vec::new();
            for run in evenly(self.snapshots.runs().len(), RUNS) {
                of_distance.extend(self.readings(name, manifold, run, distance)?);
            }
            readings.push(of_distance);
        }
        for samples in &self.experiment.run.samples {
            let SampleCount::Drawn(count) = *samples else { continue };
            let greedily = |readings: &[Reading<D>]| {
                choose_greedily(readings, coordinates, &body.kinematics, points, count).map(SampleChoice::Given)
            };
            if count > MOST_TRIED {
                into.insert((name, self.network, count), greedily(&readings[UNTRIED])?);
                continue;
            }
            let mut best: Option<(f64, SampleChoice)> = None;
            for readings in &readings {
                let candidate = greedily(readings)?;
                let error = self.trial(name, manifold, &candidate)?;
                if best.as_ref().is_none_or(|(least, _)| error < *least) {
                    best = Some((error, candidate));
                }
            }
            if let Some((_, choice)) = best {
                into.insert((name, self.network, count), choice);
            }
        }
        Ok(())
    }

    /// The mean position error of training runs with these sample points, in per cent; infinite where one does not end well.
    fn trial(
        &self,
        name: ManifoldName,
        manifold: &dyn Manifold<D>,
        candidate: &SampleChoice,
    ) -> Result<f64, ExperimentError> {
        let run = &self.experiment.run;
        let choice = Choice {
            manifold: name,
            network: self.network,
            samples: SampleCount::Drawn(0),
            chosen: ChoiceName::Greedy,
            quadrature: run.quadrature[0],
            update: run.update[0],
            step_factor: 1,
        };
        let options = Options {
            samples: candidate.clone(),
            ..run.options(&choice, &Chosen::new())
        };
        let tried = evenly(self.snapshots.runs().len(), TRIAL_RUNS);
        let mut mean = 0.0;
        for &case in &tried {
            let whole = &self.snapshots.runs()[case];
            let part = Run {
                parameters: whole.parameters.clone(),
                frames: whole.frames.iter().take(TRIAL_FRAMES).cloned().collect(),
            };
            let snapshots = Snapshots::new(self.snapshots.body().clone(), vec![part]).map_err(FullOrderError::from)?;
            let full = Full {
                case,
                snapshots,
                seconds: 0.0,
                finer: None,
            };
            let body = ReducedBody::of(&self.scene(case)?)?;
            let guess = self.guess(name, &body.reference)?;
            let row = beside(manifold, &guess, body, &full, &choice, options.clone(), None)?;
            let finished = row.outcome == "finished" && row.error.is_finite();
            mean += if finished { row.error } else { f64::INFINITY } / tried.len() as f64;
        }
        Ok(mean)
    }

    /// The scene of a training run.
    fn scene(&self, run: usize) -> Result<Scene, ExperimentError> {
        let case = self.experiment.case(&self.experiment.cases.train[run])?;
        Ok(self.document.scene(&case.changes)?)
    }

    /// Steps from some frames of a run and from states around them, read at all points. States from which there is no step, because the map is inverted there for example, are left out.
    fn readings(
        &self,
        name: ManifoldName,
        manifold: &dyn Manifold<D>,
        run: usize,
        distance: f64,
    ) -> Result<Vec<Reading<D>>, ExperimentError> {
        let body = ReducedBody::<D>::of(&self.scene(run)?)?;
        let squares: f64 = body.reference.iter().map(vector::norm_squared).sum();
        let distance = distance * (squares / body.reference.len().max(1) as f64).sqrt();
        let guess = self.guess(name, &body.reference)?;
        let map = DeformationMap::new(manifold, &body.reference, &guess)?;
        let options = Options {
            samples: SampleChoice::All,
            quadrature: Quadrature::Lagrangian { search: Search::All },
            update: Update::VelocityOnly,
            inverted: Inverted::Refuse,
        };
        let mut reduced = ReducedModel::new(body, map, options)?;
        let frames = &self.snapshots.runs()[run].frames;
        let mut readings = Vec::new();
        for index in along_path(frames, FRAMES) {
            let (frame, time) = (&frames[index], index as f64 * self.snapshots.body().interval);
            let guess = self.guess(name, &frame.positions)?;
            let Some((latent, rates)) = fitted(&reduced, frame, time, guess) else {
                continue;
            };
            let mut states = vec![latent.clone()];
            if distance > 0.0 {
                states.extend(reduced.states_around(&latent, time, distance));
            }
            let steps = states.iter().map(|state| reduced.reading(state, &rates, time));
            readings.extend(steps.flatten());
        }
        Ok(readings)
    }

    /// Where a search for coordinates begins.
    fn guess(&self, name: ManifoldName, positions: &[[f64; D]]) -> Result<Vec<f64>, ExperimentError> {
        Ok(match name {
            ManifoldName::Network => self.model.encoder().encode(positions)?,
            ManifoldName::Linear => vec![0.0; self.model.network().coordinates()],
        })
    }
}

/// At most `most` of the numbers below `count`, evenly spaced up to the last.
fn evenly(count: usize, most: usize) -> Vec<usize> {
    let used = count.min(most);
    (1..=used).map(|n| n * count / used - 1).collect()
}

/// At most `most` frames, evenly spaced along the way that the points go together, up to its end; never the first one, where nothing moves yet. A motion may be over soon, and most frames those of a
/// body at rest.
fn along_path<const D: usize>(frames: &[Frame<D>], most: usize) -> Vec<usize> {
    let mut way = vec![0.0];
    for pair in frames.windows(2) {
        let steps = pair[0].positions.iter().zip(&pair[1].positions);
        let squares: f64 = steps.map(|(x, y)| vector::distance_squared(x, y)).sum();
        way.push(way[way.len() - 1] + squares.sqrt());
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
    reduced: &ReducedModel<D, &dyn Manifold<D>>,
    frame: &Frame<D>,
    time: f64,
    guess: Vec<f64>,
) -> Option<(Vec<f64>, Vec<f64>)> {
    let mut latent = guess;
    let evaluate = |y: &[f64], wanted: Wanted, out: &mut Evaluation<D>| reduced.evaluate_at(y, time, wanted, out);
    GaussNewton::default()
        .minimise(&frame.positions, &mut latent, &Settings::default(), evaluate)
        .ok()?;
    let (mut there, wanted) = (
        Evaluation::default(),
        Wanted {
            jacobians: true,
            ..Wanted::default()
        },
    );
    reduced.evaluate_at(&latent, time, wanted, &mut there);
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
