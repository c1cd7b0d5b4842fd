//! Sample points chosen on training runs.

use std::rc::Rc;

use mpm_scenes::Scene;

use super::beside::{Choice, Full, beside};
use super::spread::spread;
use super::{ChoiceName, Experiment, ExperimentError, ManifoldName, SampleCount};
use crate::full_order::{FullOrderError, SceneDocument};
use crate::manifold::Manifold;
use crate::model::Model;
use crate::online::{KnownPoints, OnlineError, Reading, ReducedBody, SampleChoice, choose_cubature, choose_greedily};
use crate::snapshots::{Run, Snapshots};

/// Distances of the states around each frame, over the root mean square of the points' distance from the centroid. Without such states a choice knows only errors on the way, and not
/// whether a run comes back to it; how far a run strays is not known beforehand.
const DISTANCES: [f64; 5] = [0.002, 0.0, 0.005, 0.01, 0.02];

/// The distances for a cubature, all of them: near the way it has to be exact, and farther off it must know the way back.
const CUBATURE_DISTANCES: [f64; 2] = [0.002, 0.02];

/// Training runs that choices are tried on, at most, and frames of each.
const TRIAL_RUNS: usize = 3;
const TRIAL_FRAMES: usize = 91;

/// Larger numbers of sample points are not tried: choices then differ little. The first one is taken.
const MOST_TRIED: usize = 24;

/// Training runs and what is needed to step from their frames.
pub(super) struct Sampling<'a, const D: usize> {
    pub experiment: &'a Experiment,
    /// The scene that is trained on.
    pub document: &'a SceneDocument,
    pub model: &'a Model<D>,
    /// Its number among those of the experiment.
    pub network: usize,
    pub snapshots: &'a Snapshots<D>,
}

/// A manifold, the number of the network, how points are chosen, and |𝒫|.
type Of = (ManifoldName, usize, ChoiceName, usize);

/// The sample points of every manifold, network and number of them. They hang on the scene, too: its kinematic regions need not be the same in all cases.
#[derive(Default)]
pub(super) struct Chosen<const D: usize>(Vec<Best<D>>);

/// The readings on which points are chosen, and the points.
struct Best<const D: usize> {
    of: Of,
    error: f64,
    readings: Rc<Readings<D>>,
    made: Made,
}

/// Steps from states of training runs, and where the points that they are read at are at rest.
pub(super) struct Readings<const D: usize> {
    pub positions: Vec<[f64; D]>,
    pub steps: Vec<Reading<D>>,
}

/// Points that were chosen on some readings, with the members of the scene's kinematic regions.
#[derive(Default)]
struct Made(Vec<(Vec<Vec<usize>>, SampleChoice)>);

impl<const D: usize> Chosen<D> {
    /// The points of a run of this body.
    ///
    /// # Errors
    /// Those of the choice; [`OnlineError::Readings`] where nothing has been read for it.
    pub fn points(&mut self, of: Of, coordinates: usize, body: &ReducedBody<D>) -> Result<SampleChoice, OnlineError> {
        match self.0.iter_mut().find(|best| best.of == of) {
            Some(best) => best.made.points(&best.readings, coordinates, (of.2, of.3), body),
            None => Err(OnlineError::Readings {
                readings: 0,
                points: body.reference.len(),
            }),
        }
    }
}

impl Made {
    fn points<const D: usize>(
        &mut self,
        readings: &Readings<D>,
        coordinates: usize,
        (choice, count): (ChoiceName, usize),
        body: &ReducedBody<D>,
    ) -> Result<SampleChoice, OnlineError> {
        let regions = body.kinematics.regions().iter();
        let regions: Vec<_> = regions.map(|region| region.members.clone()).collect();
        if let Some((_, points)) = self.0.iter().find(|made| made.0 == regions) {
            return Ok(points.clone());
        }
        let (kinematics, steps) = (&body.kinematics, &readings.steps);
        let known = KnownPoints::nearest(&body.reference, &readings.positions);
        let points = match choice {
            ChoiceName::Cubature => {
                SampleChoice::Weighted(choose_cubature(steps, coordinates, kinematics, &known, count)?)
            }
            _ => SampleChoice::Given(choose_greedily(steps, coordinates, kinematics, &known, count)?),
        };
        self.0.push((regions, points.clone()));
        Ok(points)
    }
}

impl<const D: usize> Sampling<'_, D> {
    /// Sample points for every number of them in the experiment, by every choice that needs training runs.
    pub fn choose(
        &self,
        name: ManifoldName,
        manifold: &dyn Manifold<D>,
        into: &mut Chosen<D>,
    ) -> Result<(), ExperimentError> {
        let (run, mut counts) = (&self.experiment.run, Vec::new());
        counts.extend(run.samples.iter().filter_map(|samples| samples.count()));
        for &choice in &run.choice {
            self.choose_by(choice, &counts, name, manifold, into)?;
        }
        Ok(())
    }

    /// So many sample points by one choice, if it needs training runs.
    fn choose_by(
        &self,
        choice: ChoiceName,
        counts: &[usize],
        name: ManifoldName,
        manifold: &dyn Manifold<D>,
        into: &mut Chosen<D>,
    ) -> Result<(), ExperimentError> {
        match choice {
            ChoiceName::Greedy => self.choose_greedily(counts, name, manifold, into),
            ChoiceName::Cubature => self.choose_cubature(counts, name, manifold, into),
            ChoiceName::Drawn | ChoiceName::Spread => Ok(()),
        }
    }

    /// What [`choose_cubature`] finds on steps from 6 frames of each of up to 8 training runs, evenly spaced along the way of the body, and from states around these frames, near and far; those from the frames themselves count twice.
    fn choose_cubature(
        &self,
        counts: &[usize],
        name: ManifoldName,
        manifold: &dyn Manifold<D>,
        into: &mut Chosen<D>,
    ) -> Result<(), ExperimentError> {
        let readings = Rc::new(self.readings(name, manifold, &CUBATURE_DISTANCES)?);
        into.0.extend(counts.iter().map(|&count| Best {
            of: (name, self.network, ChoiceName::Cubature, count),
            error: f64::INFINITY,
            readings: Rc::clone(&readings),
            made: Made::default(),
        }));
        Ok(())
    }

    /// Candidates are what [`choose_greedily`] finds on steps from 6 frames of each of up to 8 training runs, evenly spaced along the way of the body, and from states around these frames at one of several distances.
    /// Each is tried on up to three training runs of at most 90 frames, and the one with the least mean position error is taken. More than 24 points are not tried, and the distance is 0.002.
    fn choose_greedily(
        &self,
        counts: &[usize],
        name: ManifoldName,
        manifold: &dyn Manifold<D>,
        into: &mut Chosen<D>,
    ) -> Result<(), ExperimentError> {
        let mut best: Vec<Best<D>> = Vec::new();
        for distance in DISTANCES {
            let mut readings = None;
            for &count in counts {
                let of = (name, self.network, ChoiceName::Greedy, count);
                let known = best.iter().position(|best| best.of == of);
                if known.is_some() && count > MOST_TRIED {
                    continue;
                }
                let readings = match &readings {
                    Some(readings) => readings,
                    None => readings.insert(Rc::new(self.readings(name, manifold, &[distance])?)),
                };
                let least = known.map_or(f64::INFINITY, |known| best[known].error);
                let error = match count {
                    ..=MOST_TRIED => self.trial(name, manifold, readings, count, least)?,
                    _ => f64::INFINITY,
                };
                let (readings, made) = (Rc::clone(readings), Made::default());
                let candidate = Best {
                    of,
                    error,
                    readings,
                    made,
                };
                match known {
                    None => best.push(candidate),
                    Some(known) if error < least => best[known] = candidate,
                    Some(_) => {}
                }
            }
        }
        into.0.extend(best);
        Ok(())
    }

    /// The mean position error of training runs with sample points chosen on these readings, in per cent; infinite where one does not end well or the mean is above `least` in any case.
    fn trial(
        &self,
        name: ManifoldName,
        manifold: &dyn Manifold<D>,
        readings: &Readings<D>,
        count: usize,
        least: f64,
    ) -> Result<f64, ExperimentError> {
        let choice = self.choice(name, SampleCount::Drawn(count), ChoiceName::Greedy);
        let mut made = Made::default();
        self.mean_error(manifold, &choice, least, &mut |body| {
            made.points(readings, manifold.coordinates(), (ChoiceName::Greedy, count), body)
        })
    }

    /// The mean position error of training runs of the network, in per cent, with the first of everything that `[run]` asks for; infinite where one does not end well.
    pub fn error_of_training_runs(&self) -> Result<f64, ExperimentError> {
        let (run, network, mut chosen) = (&self.experiment.run, self.model.network(), Chosen::default());
        let choice = self.choice(ManifoldName::Network, run.samples[0], run.choice[0]);
        if let Some(count) = choice.samples.count() {
            self.choose_by(choice.chosen, &[count], choice.manifold, network, &mut chosen)?;
        }
        self.mean_error(network, &choice, f64::INFINITY, &mut |body| {
            run.samples(&choice, |count| {
                let of = (choice.manifold, choice.network, choice.chosen, count);
                chosen.points(of, network.coordinates(), body)
            })
        })
    }

    /// What trial runs are made with.
    fn choice(&self, name: ManifoldName, samples: SampleCount, chosen: ChoiceName) -> Choice {
        let run = &self.experiment.run;
        Choice {
            manifold: name,
            network: self.network,
            samples,
            chosen,
            quadrature: run.quadrature[0],
            update: run.update[0],
            step_factor: 1,
        }
    }

    /// The mean position error of up to three training runs of at most 90 frames, in per cent, with the sample points that `points` gives; infinite where one does not end well or the mean is above `least` in any case.
    fn mean_error(
        &self,
        manifold: &dyn Manifold<D>,
        choice: &Choice,
        least: f64,
        points: &mut dyn FnMut(&ReducedBody<D>) -> Result<SampleChoice, OnlineError>,
    ) -> Result<f64, ExperimentError> {
        let (tried, mut mean) = (spread(&self.experiment.cases.train, TRIAL_RUNS), 0.0);
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
            let guess = self.guess(choice.manifold, self.snapshots.reference())?;
            let options = self.experiment.run.options(choice, points(&body)?);
            let row = beside(manifold, &guess, body, &full, choice, options, None)?;
            mean += row.error / tried.len() as f64;
            let promising = row.outcome == "finished" && mean <= least;
            if !promising {
                return Ok(f64::INFINITY);
            }
        }
        Ok(mean)
    }

    /// The scene of a training run.
    pub(super) fn scene(&self, run: usize) -> Result<Scene, ExperimentError> {
        let values = &self.experiment.cases.train[run];
        self.experiment.scene_of(self.document, values)
    }

    /// Where a search for coordinates begins.
    pub(super) fn guess(&self, name: ManifoldName, positions: &[[f64; D]]) -> Result<Vec<f64>, ExperimentError> {
        Ok(match name {
            ManifoldName::Network => self.model.encoder().encode(positions)?,
            ManifoldName::Linear => vec![0.0; self.model.network().coordinates()],
        })
    }
}
