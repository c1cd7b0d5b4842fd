//! Sample points chosen on training runs.

use std::rc::Rc;

use mpm_scenes::Scene;

use super::chosen::{Best, Chosen};
use super::options::MOST_TRIED;
use super::trials::Trials;
use super::{ChoiceName, Experiment, ExperimentError, ManifoldName};
use crate::full_order::SceneDocument;
use crate::manifold::Manifold;
use crate::model::Model;
use crate::snapshots::Snapshots;

/// Distances of the states around each frame, over the root mean square of the points' distance from the centroid. Without such states a choice knows only errors on the way, and not
/// whether a run comes back to it; how far a run strays is not known beforehand.
const DISTANCES: [f64; 5] = [0.002, 0.0, 0.005, 0.01, 0.02];

/// The distances for a cubature, all of them: near the way it has to be exact, and farther off it must know the way back.
const CUBATURE_DISTANCES: [f64; 2] = [0.002, 0.02];

/// A family of maps, training runs and what is needed to step from their frames.
pub(super) struct Sampling<'a, const D: usize> {
    pub experiment: &'a Experiment,
    /// The scene that is trained on.
    pub document: &'a SceneDocument,
    pub model: &'a Model<D>,
    /// Its number among those of the experiment.
    pub network: usize,
    /// The family: the model's network, or the linear one.
    pub name: ManifoldName,
    pub manifold: &'a dyn Manifold<D>,
    pub snapshots: &'a Snapshots<D>,
    /// Asked after every trial run whether to go on.
    pub go_on: &'a dyn Fn() -> bool,
}

impl<const D: usize> Sampling<'_, D> {
    /// Sample points for every number of them in the experiment, by every choice that needs training runs.
    pub fn choose(&self, into: &mut Chosen<D>) -> Result<(), ExperimentError> {
        let run = &self.experiment.run;
        let counts: Vec<usize> = run.counts().collect();
        let mut choices = run.choice.iter();
        choices.try_for_each(|&choice| self.choose_by(choice, &counts, into))
    }

    /// So many sample points by one choice, if it needs training runs.
    pub(super) fn choose_by(
        &self,
        choice: ChoiceName,
        counts: &[usize],
        into: &mut Chosen<D>,
    ) -> Result<(), ExperimentError> {
        match choice {
            ChoiceName::Greedy => self.choose_greedily(counts, into),
            ChoiceName::Cubature => self.choose_cubature(counts, into),
            ChoiceName::Drawn | ChoiceName::Redrawn | ChoiceName::Spread => Ok(()),
        }
    }

    /// What [`choose_cubature`](crate::online::choose_cubature) finds on steps from 6 frames of each of up to 8 training runs, evenly spaced along the way of the body, and from states around these frames, near and far; those from the frames themselves count twice.
    fn choose_cubature(&self, counts: &[usize], into: &mut Chosen<D>) -> Result<(), ExperimentError> {
        let readings = Rc::new(self.readings(&CUBATURE_DISTANCES)?);
        let of = |count| (self.name, self.network, ChoiceName::Cubature, count);
        into.extend(counts.iter().map(|&count| Best::new(of(count), Rc::clone(&readings))));
        Ok(())
    }

    /// Candidates are what [`choose_greedily`](crate::online::choose_greedily) finds on steps from 6 frames of each of up to 8 training runs, evenly spaced along the way of the body, and from states around these frames at one of several distances.
    /// Each is tried on up to eight training runs of at most 91 frames, and the one with the least error of them together is taken, and exchanged. More than 24 points are not tried, and the distance is 0.002.
    fn choose_greedily(&self, counts: &[usize], into: &mut Chosen<D>) -> Result<(), ExperimentError> {
        let new = |&count: &usize| (count, None, Trials::of(&self.experiment.cases.train));
        let mut all: Vec<(usize, Option<Best<D>>, Trials)> = counts.iter().map(new).collect();
        for distance in DISTANCES {
            let mut readings = None;
            for (count, best, trials) in &mut all {
                let tried = *count <= MOST_TRIED;
                if best.is_some() && !tried {
                    continue;
                }
                let readings = match &readings {
                    Some(readings) => readings,
                    None => readings.insert(Rc::new(self.readings(&[distance])?)),
                };
                let of = (self.name, self.network, ChoiceName::Greedy, *count);
                let mut candidate = Best::new(of, Rc::clone(readings));
                let least = best.as_ref().map_or(f64::INFINITY, |best| best.error);
                if tried {
                    candidate.error = self.error_of(&mut candidate, least, trials)?;
                }
                if best.is_none() || candidate.error < least {
                    *best = Some(candidate);
                }
            }
        }
        for (count, best, mut trials) in all {
            let Some(mut best) = best else { continue };
            if count <= MOST_TRIED {
                self.exchange(&mut best, &mut trials)?;
            }
            into.extend([best]);
        }
        Ok(())
    }

    /// The scene of a training run.
    pub(super) fn scene(&self, run: usize) -> Result<Scene, ExperimentError> {
        let values = &self.experiment.cases.train[run];
        self.experiment.scene_of(self.document, values)
    }

    /// Where a search for coordinates begins.
    pub(super) fn guess(&self, positions: &[[f64; D]]) -> Result<Vec<f64>, ExperimentError> {
        Ok(match self.name {
            ManifoldName::Network => self.model.encoder().encode(positions)?,
            ManifoldName::Linear => vec![0.0; self.manifold.coordinates()],
        })
    }
}
