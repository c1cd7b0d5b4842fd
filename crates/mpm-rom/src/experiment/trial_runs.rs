//! What is tried on training runs before test cases are run.

use super::beside::{Choice, Full, beside};
use super::chosen::{Best, Chosen};
use super::sampling::Sampling;
use super::trials::Trials;
use super::{ChoiceName, ExperimentError, SampleCount};
use crate::online::{OnlineError, ReducedBody, SampleChoice};

/// Frames of each training run, at most.
const FRAMES: usize = 91;

impl<const D: usize> Sampling<'_, D> {
    /// The error of training runs together, as [`Self::together`], with the first of everything that `[run]` asks for, but for its step factors.
    pub fn error_of_training_runs(&self) -> Result<f64, ExperimentError> {
        let (run, mut chosen) = (&self.experiment.run, Chosen::default());
        let choice = self.choice(run.samples[0], run.choice[0]);
        if let Some(count) = choice.samples.count() {
            self.choose_by(choice.chosen, &[count], &mut chosen)?;
        }
        let mut trials = Trials::of(&self.experiment.cases.train);
        self.together(&choice, f64::INFINITY, &mut trials, &mut |body| {
            run.samples(&choice, &mut chosen, self.manifold.coordinates(), body)
        })
    }

    /// The error of training runs together, as [`Self::together`], with points of this choice.
    pub(super) fn error_of(
        &self,
        points: &mut Best<D>,
        least: f64,
        trials: &mut Trials,
    ) -> Result<f64, ExperimentError> {
        let (_, _, chosen, count) = points.of;
        let choice = self.choice(SampleCount::Drawn(count), chosen);
        self.together(&choice, least, trials, &mut |body| {
            points.points(self.manifold.coordinates(), body)
        })
    }

    /// What trial runs are made with: the first quadrature and update of `[run]`, whichever others the points will be used for, and Δt of the full-order run.
    fn choice(&self, samples: SampleCount, chosen: ChoiceName) -> Choice {
        let run = &self.experiment.run;
        Choice {
            manifold: self.name,
            network: self.network,
            samples,
            chosen,
            quadrature: run.quadrature[0],
            update: run.update[0],
            step_factor: 1,
        }
    }

    /// The root of the mean square of the position errors of up to eight training runs of at most 91 frames, in per cent, with the sample points that `points` gives; infinite where one does not end well or the root is above `least` in any case.
    fn together(
        &self,
        choice: &Choice,
        least: f64,
        trials: &mut Trials,
        points: &mut dyn FnMut(&ReducedBody<D>) -> Result<SampleChoice, OnlineError>,
    ) -> Result<f64, ExperimentError> {
        let (mut errors, mut mean_square) = (Vec::new(), 0.0);
        for &case in &trials.0 {
            let run = &self.snapshots.runs()[case];
            let full = Full {
                case,
                parameters: &run.parameters,
                reference: self.snapshots.reference(),
                frames: &run.frames[..run.frames.len().min(FRAMES)],
                seconds: 0.0,
                finer: None,
            };
            let body = ReducedBody::of(&self.scene(case)?)?;
            let guess = self.guess(self.snapshots.reference())?;
            let options = self.experiment.run.options(choice, points(&body)?);
            let row = beside(self.manifold, &guess, body, &full, choice, options, None)?;
            if !(self.go_on)() {
                return Err(ExperimentError::Stopped);
            }
            let error = row.error.unwrap_or(0.0);
            errors.push((case, error));
            mean_square += error.powi(2) / trials.0.len() as f64;
            let promising = row.outcome == "finished" && mean_square.sqrt() <= least;
            if !promising {
                return Ok(f64::INFINITY);
            }
        }
        trials.sort_by_errors(errors);
        Ok(mean_square.sqrt())
    }
}
