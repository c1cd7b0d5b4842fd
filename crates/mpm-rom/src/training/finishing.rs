//! The second phase of a training: the loss at samples that stay the same.

use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;
use rand::seq::index;
use rayon::prelude::*;

use super::finish::QuasiNewton;
use super::loss::{PairLoss, Weights};
use super::trainer::Trainer;
use super::{EpochReport, Terms, TrainingError};
use crate::product::LANES;

/// Parts that the pairs are cut into, so that any number of threads adds the same numbers in the same order.
const PARTS: usize = 24;

/// The samples of the second phase, and where their parts are summed.
pub(super) struct FixedSample<const D: usize> {
    pairs: Vec<(usize, usize)>,
    chosen: Vec<Vec<usize>>,
    parts: Vec<PairLoss<D>>,
}

impl<const D: usize> FixedSample<D> {
    /// The same for the same seed and snapshots.
    pub fn of(trainer: &Trainer<'_, D>) -> Self {
        let (pairs, points) = (trainer.pairs(), trainer.snapshots.points());
        let mut generator = ChaCha8Rng::seed_from_u64(trainer.config.seed);
        // Epochs have the streams from 1 on.
        generator.set_stream(u64::MAX);
        let share = trainer.config.finishing_samples.div_ceil(pairs.len());
        let count = share.next_multiple_of(LANES).min(points);
        let mut draw = || index::sample(&mut generator, points, count).into_vec();
        Self {
            chosen: pairs.iter().map(|_| draw()).collect(),
            parts: vec![PairLoss::new(&trainer.network, &trainer.encoder); PARTS.min(pairs.len())],
            pairs,
        }
    }

    /// The loss and its gradient.
    fn evaluate(&mut self, trainer: &Trainer<'_, D>) -> (Terms, Vec<f64>) {
        let weights = Weights {
            gradient: trainer.config.gradient_weight,
            velocity: trainer.config.velocity_weight,
            interval: trainer.snapshots.body().interval,
            share: 1.0 / self.chosen.iter().map(Vec::len).sum::<usize>() as f64,
        };
        let (model, snapshots) = ((&trainer.network, &trainer.encoder), trainer.snapshots);
        let size = self.pairs.len().div_ceil(self.parts.len());
        let tasks = self.parts.par_iter_mut().zip(self.pairs.par_chunks(size));
        tasks
            .zip(self.chosen.par_chunks(size))
            .for_each(|((part, pairs), chosen)| {
                part.clear();
                for (&(run, frame), chosen) in pairs.iter().zip(chosen) {
                    let run = &snapshots.runs()[run];
                    part.add(model, &weights, snapshots.reference(), run, frame, chosen);
                }
            });
        let used = self.pairs.len().div_ceil(size);
        let (mut terms, mut gradient) = (Terms::default(), vec![0.0; trainer.adam.first.len()]);
        for part in &self.parts[..used] {
            terms += part.terms;
            for (sum, own) in gradient.iter_mut().zip(part.network.iter().chain(&part.encoder)) {
                *sum += own;
            }
        }
        (terms, gradient)
    }
}

impl<const D: usize> Trainer<'_, D> {
    /// One step of the quasi-Newton method. Where no length along its direction makes the loss smaller it begins again with a diagonal; where even that
    /// fails the parameters stay, and so does the loss.
    pub(super) fn finishing_step(&mut self, sample: &mut FixedSample<D>) -> Result<EpochReport, TrainingError> {
        let mut state = match self.finish.take() {
            Some(state) => state,
            None => {
                let (terms, gradient) = sample.evaluate(self);
                QuasiNewton::new(&self.scales(), terms, gradient)
            }
        };
        let scales = self.scales();
        let mut parameters = [self.network.parameters(), self.encoder.parameters()].concat();
        let mut loss = |at: &[f64]| {
            self.set_parameters(at);
            sample.evaluate(self)
        };
        let mut length = state.step(&mut parameters, &mut loss);
        if length.is_none() {
            state = QuasiNewton::new(&scales, state.terms, state.gradient);
            length = state.step(&mut parameters, &mut loss);
        }
        self.set_parameters(&parameters);
        let (epoch, terms) = (self.history.len() as u64, state.terms);
        self.finish = Some(state);
        let loss = terms.total();
        if !loss.is_finite() {
            let step = self.adam.steps + epoch - self.config.epochs;
            return Err(TrainingError::NotFinite { epoch, step, loss });
        }
        Ok(EpochReport {
            epoch,
            epochs: self.config.all_epochs(),
            terms,
            rate: length.unwrap_or(0.0),
        })
    }

    fn set_parameters(&mut self, parameters: &[f64]) {
        let (network, encoder) = parameters.split_at(self.network.parameters().len());
        self.network.parameters_mut().copy_from_slice(network);
        self.encoder.parameters_mut().copy_from_slice(encoder);
    }

    /// What H begins with: 10⁻³ / √s with Adam's mean squares of the gradient.
    fn scales(&self) -> Vec<f64> {
        let largest = self.adam.second.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
        let scale = |second: &f64| 1e-3 / (second + 1e-8 * largest).sqrt();
        self.adam.second.iter().map(scale).collect()
    }
}
