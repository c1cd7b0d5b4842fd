//! The second phase of a training: the loss at samples that stay the same for many steps, as a function of the network alone.

use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;
use rand::seq::index;
use rayon::prelude::*;

use super::finish::QuasiNewton;
use super::loss::{Motion, PairLoss, Weights};
use super::trainer::Trainer;
use super::{EpochReport, Terms, TrainingError};
use crate::encoder::EncoderTape;
use crate::snapshots::Frame;

/// Parts that the pairs are cut into, so that any number of threads adds the same numbers in the same order.
const PARTS: usize = 24;

/// Points of a pair, at least: fewer would spend more on the pair than on the points.
const POINTS: usize = 16;

/// The samples of some steps of the second phase, and where their parts are summed.
pub(super) struct FixedSample<const D: usize> {
    /// How many draws were before this one.
    pub draw: u64,
    /// Run, frame, and the coordinates there, which stay as the encoder has them after the first phase.
    pairs: Vec<(usize, usize, Motion)>,
    chosen: Vec<Vec<usize>>,
    parts: Vec<PairLoss<D>>,
}

impl<const D: usize> FixedSample<D> {
    /// The same for the same seed, snapshots and draw.
    pub fn of(trainer: &Trainer<'_, D>, draw: u64) -> Self {
        let (pairs, points) = (trainer.pairs(), trainer.snapshots.points());
        let mut generator = ChaCha8Rng::seed_from_u64(trainer.config.seed);
        // Epochs have the streams from 1 on.
        generator.set_stream(u64::MAX - draw);
        let samples = trainer.config.finishing_samples;
        let count = samples.div_ceil(pairs.len()).max(POINTS).min(points);
        let used = samples.div_ceil(count).min(pairs.len());
        let mut numbers = index::sample(&mut generator, pairs.len(), used).into_vec();
        numbers.sort_unstable();
        let mut of_frame = || index::sample(&mut generator, points, count).into_vec();
        let pairs: Vec<_> = numbers.iter().map(|&number| pairs[number]).collect();
        Self {
            draw,
            chosen: pairs.iter().map(|_| of_frame()).collect(),
            parts: vec![PairLoss::new(&trainer.network, &trainer.encoder); PARTS.min(pairs.len())],
            pairs: pairs
                .par_iter()
                .map(|&(run, frame)| (run, frame, trainer.motion(run, frame)))
                .collect(),
        }
    }

    /// The loss and its gradient with respect to the network's parameters.
    fn evaluate(&mut self, trainer: &Trainer<'_, D>) -> (Terms, Vec<f64>) {
        let weights = Weights {
            gradient: trainer.config.gradient_weight,
            velocity: trainer.config.velocity_weight,
            share: 1.0 / self.chosen.iter().map(Vec::len).sum::<usize>() as f64,
        };
        let (network, snapshots) = (&trainer.network, trainer.snapshots);
        let size = self.pairs.len().div_ceil(self.parts.len());
        let tasks = self.parts.par_iter_mut().zip(self.pairs.par_chunks(size));
        tasks
            .zip(self.chosen.par_chunks(size))
            .for_each(|((part, pairs), chosen)| {
                part.clear();
                for ((run, frame, motion), chosen) in pairs.iter().zip(chosen) {
                    let frame = &snapshots.runs()[*run].frames[*frame];
                    part.add_at(network, &weights, snapshots.reference(), frame, motion, chosen);
                }
            });
        let used = self.pairs.len().div_ceil(size);
        let (mut terms, mut gradient) = (Terms::default(), vec![0.0; network.parameters().len()]);
        for part in &self.parts[..used] {
            terms += part.terms;
            for (sum, own) in gradient.iter_mut().zip(&part.network) {
                *sum += own;
            }
        }
        (terms, gradient)
    }
}

impl<const D: usize> Trainer<'_, D> {
    /// One step of the quasi-Newton method, with new samples where it is time for them; the approximate inverse outlives them. Where no length along its
    /// direction makes the loss smaller it begins again with a diagonal; where even that fails the parameters stay, and so does the loss.
    pub(super) fn finishing_step(&mut self, sample: &mut Option<FixedSample<D>>) -> Result<EpochReport, TrainingError> {
        let done = self.history.len() as u64 - self.config.epochs;
        let (draw, first) = (
            done / self.config.finishing_redraw,
            done.is_multiple_of(self.config.finishing_redraw),
        );
        if sample.as_ref().is_none_or(|sample| sample.draw != draw) {
            *sample = None;
        }
        let sample = sample.get_or_insert_with(|| FixedSample::of(self, draw));
        let mut state = match self.finish.take() {
            Some(state) if !first => state,
            before => {
                let (terms, gradient) = sample.evaluate(self);
                match before {
                    Some(state) => state.with_loss(terms, gradient),
                    None => QuasiNewton::new(&self.scales(), terms, gradient),
                }
            }
        };
        let scales = self.scales();
        let mut parameters = self.network.parameters().to_vec();
        let mut loss = |at: &[f64]| {
            self.network.parameters_mut().copy_from_slice(at);
            sample.evaluate(self)
        };
        let mut length = state.step(&mut parameters, &mut loss);
        if length.is_none() {
            state = QuasiNewton::new(&scales, state.terms, state.gradient);
            length = state.step(&mut parameters, &mut loss);
        }
        self.network.parameters_mut().copy_from_slice(&parameters);
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

    /// What the encoder says of a frame and of the next one.
    fn motion(&self, run: usize, frame: usize) -> Motion {
        let frames = &self.snapshots.runs()[run].frames;
        let latent = |frame: &Frame<D>| {
            let mut tape = EncoderTape::default();
            self.encoder.forward(&frame.positions, &mut tape);
            tape.latent
        };
        let now = &frames[frame];
        let next = frames.get(frame + 1).map(|next| (latent(next), next.time - now.time));
        let next = next.as_ref().map(|(next, interval)| (&next[..], *interval));
        Motion::between(&latent(now), next)
    }

    /// What H begins with: 10⁻³ / √s with Adam's mean squares of the gradient.
    fn scales(&self) -> Vec<f64> {
        let second = &self.adam.second[..self.network.parameters().len()];
        let largest = second.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
        second
            .iter()
            .map(|second| 1e-3 / (second + 1e-8 * largest).sqrt())
            .collect()
    }
}
