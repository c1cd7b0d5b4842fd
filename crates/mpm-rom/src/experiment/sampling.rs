//! Sample points chosen on training runs.

use std::collections::HashMap;

use super::{Experiment, ExperimentError, ManifoldName, SampleCount};
use crate::deformation_map::DeformationMap;
use crate::full_order::SceneDocument;
use crate::least_squares::{GaussNewton, LeastSquares, Settings};
use crate::manifold::{Evaluation, Manifold, Wanted};
use crate::model::Model;
use crate::online::{
    Options, Quadrature, Reading, ReducedBody, ReducedModel, SampleChoice, Search, Update, choose_greedily,
};
use crate::snapshots::{Frame, Snapshots};

/// Training runs that are read, at most, and frames of each.
const RUNS: usize = 8;
const FRAMES: usize = 4;

/// Choices made so far, by manifold and number of points.
pub(super) type Chosen = HashMap<(ManifoldName, usize), SampleChoice>;

/// Training runs and what is needed to read steps from their frames.
pub(super) struct Sampling<'a, const D: usize> {
    pub experiment: &'a Experiment,
    pub document: &'a SceneDocument,
    pub model: &'a Model<D>,
    pub snapshots: &'a Snapshots<D>,
}

impl<const D: usize> Sampling<'_, D> {
    /// For every number of sample points of the experiment, those that [`choose_greedily`] finds on up to 8 training runs with 4 frames each.
    pub fn choose(
        &self,
        name: ManifoldName,
        manifold: &dyn Manifold<D>,
        into: &mut Chosen,
    ) -> Result<(), ExperimentError> {
        let runs = self.snapshots.runs().len();
        let mut readings = Vec::new();
        let used = runs.min(RUNS);
        for number in 0..used {
            let run = number * runs / used;
            readings.extend(self.readings(name, manifold, run)?);
        }
        let scene = self.scene(0)?;
        let body = ReducedBody::<D>::of(&scene)?;
        let (points, coordinates) = (body.reference.len(), manifold.coordinates());
        for samples in &self.experiment.run.samples {
            if let SampleCount::Drawn(count) = *samples {
                let chosen = choose_greedily(&readings, coordinates, &body.kinematics, points, count)?;
                into.insert((name, count), SampleChoice::Given(chosen));
            }
        }
        Ok(())
    }

    /// The scene of a training run.
    fn scene(&self, run: usize) -> Result<mpm_scenes::Scene, ExperimentError> {
        let case = self.experiment.case(&self.experiment.cases.train[run])?;
        Ok(self.document.scene(&case.changes)?)
    }

    /// Steps from some frames of a run, read at all points. Frames from which there is no step, because the map is inverted there for example, are left out.
    fn readings(
        &self,
        name: ManifoldName,
        manifold: &dyn Manifold<D>,
        run: usize,
    ) -> Result<Vec<Reading<D>>, ExperimentError> {
        let scene = self.scene(run)?;
        let body = ReducedBody::<D>::of(&scene)?;
        let guess = self.guess(name, &body.reference)?;
        let map = DeformationMap::new(manifold, &body.reference, &guess)?;
        let options = Options {
            samples: SampleChoice::All,
            quadrature: Quadrature::Lagrangian { search: Search::All },
            update: Update::VelocityOnly,
        };
        let mut reduced = ReducedModel::new(body, map, options)?;
        let frames = &self.snapshots.runs()[run].frames;
        let used = frames.len().saturating_sub(1).min(FRAMES);
        let mut readings = Vec::new();
        for number in 0..used {
            // Never the first one, where nothing moves yet.
            let index = (number + 1) * (frames.len() - 1) / used;
            let time = index as f64 * self.snapshots.body().interval;
            let guess = self.guess(name, &frames[index].positions)?;
            if let Some((latent, rates)) = fitted(&reduced, &frames[index], time, guess)
                && let Ok(reading) = reduced.reading(&latent, &rates, time)
            {
                readings.push(reading);
            }
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
