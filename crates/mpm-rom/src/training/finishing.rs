//! The second phase of a training: the network alone, at samples that stay the same.

use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;
use rand::seq::index;
use rayon::prelude::*;

use super::finish::QuasiNewton;
use super::loss::{Coordinates, PairLoss, Weights};
use super::normal_matrix::{Site, normal_matrix};
use super::trainer::Trainer;
use super::{EpochReport, Terms, TrainingError};
use crate::encoder::EncoderError;
use crate::manifold::Network;
use crate::manifold::network::CHUNK;

/// Parts that the pairs are cut into, so that any number of threads adds the same numbers in the same order.
const PARTS: usize = 32;

/// Steps between two matrices of Gauss and Newton.
const STEPS_PER_MATRIX: u64 = 100;

/// Samples in such a matrix, for every parameter of the network.
const SITES_PER_PARAMETER: usize = 1;

/// Streams of random numbers from here on belong to the second phase: this one for its samples, those after it for its matrices.
const STREAM: u64 = 1 << 63;

/// The samples of the second phase with their coordinates, and where their parts are summed.
pub(super) struct FixedSample<const D: usize> {
    pairs: Vec<Pair>,
    parts: Vec<PairLoss<D>>,
}

/// A frame with its sample points.
struct Pair {
    run: usize,
    frame: usize,
    latent: Vec<f64>,
    direction: Option<Vec<f64>>,
    chosen: Vec<usize>,
}

impl<const D: usize> FixedSample<D> {
    /// The same for the same seed, snapshots and encoder.
    ///
    /// # Errors
    /// [`EncoderError`] never occurs.
    pub fn of(trainer: &Trainer<'_, D>) -> Result<Self, EncoderError> {
        let (snapshots, config) = (trainer.snapshots, &trainer.config);
        let points = snapshots.points();
        let frames: Vec<&[[f64; D]]> = snapshots
            .runs()
            .iter()
            .flat_map(|run| run.frames.iter().map(|frame| &frame.positions[..]))
            .collect();
        let mut latents = trainer.encoder.encode_all(&frames)?.into_iter().peekable();
        let mut generator = ChaCha8Rng::seed_from_u64(config.seed);
        generator.set_stream(STREAM);
        let share = config.finishing_samples / frames.len();
        // Whole chunks are the fastest.
        let count = if share > CHUNK {
            share / CHUNK * CHUNK
        } else {
            share.max(1)
        }
        .min(points);
        let mut pairs = Vec::with_capacity(frames.len());
        for (number, run) in snapshots.runs().iter().enumerate() {
            for frame in 0..run.frames.len() {
                let Some(latent) = latents.next() else { continue };
                let moving = config.velocity_weight > 0.0 && frame + 1 < run.frames.len();
                let next = latents.peek().filter(|_| moving);
                let rates = |next: &Vec<f64>| {
                    next.iter()
                        .zip(&latent)
                        .map(|(next, now)| (next - now) / snapshots.body().interval)
                        .collect()
                };
                pairs.push(Pair {
                    run: number,
                    frame,
                    direction: next.map(rates),
                    chosen: index::sample(&mut generator, points, count).into_vec(),
                    latent,
                });
            }
        }
        Ok(Self {
            parts: vec![PairLoss::new(&trainer.network, &trainer.encoder); PARTS.min(pairs.len())],
            pairs,
        })
    }

    /// The loss and its gradient for the parameters of `network`.
    fn evaluate(&mut self, network: &Network<D>, trainer: &Trainer<'_, D>) -> (Terms, Vec<f64>) {
        let samples = self.pairs.iter().map(|pair| pair.chosen.len()).sum();
        let (weights, snapshots) = (trainer.weights(samples), trainer.snapshots);
        let size = self.pairs.len().div_ceil(self.parts.len());
        let tasks = self.parts.par_iter_mut().zip(self.pairs.par_chunks(size));
        tasks.for_each(|(part, pairs)| {
            part.clear();
            for pair in pairs {
                let frame = &snapshots.runs()[pair.run].frames[pair.frame];
                let at = Coordinates {
                    latent: &pair.latent,
                    direction: pair.direction.as_deref(),
                };
                part.add_at(network, &weights, snapshots.reference(), frame, &pair.chosen, &at);
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

    /// The matrix of Gauss and Newton at random samples, other ones for every number.
    fn matrix(&self, trainer: &Trainer<'_, D>, number: u64) -> Vec<f64> {
        let mut generator = ChaCha8Rng::seed_from_u64(trainer.config.seed);
        generator.set_stream(STREAM + 1 + number);
        let count = SITES_PER_PARAMETER * trainer.network.parameters().len();
        let reference = trainer.snapshots.reference();
        let mut site = |k: usize| {
            // Pairs in turn: every frame has its share.
            let pair = &self.pairs[k * self.pairs.len() / count];
            Site {
                latent: &pair.latent,
                reference: reference[index::sample(&mut generator, reference.len(), 1).index(0)],
            }
        };
        let sites: Vec<_> = (0..count).map(&mut site).collect();
        normal_matrix(&trainer.network, &trainer.weights(count), &sites)
    }
}

impl<const D: usize> Trainer<'_, D> {
    fn weights(&self, samples: usize) -> Weights {
        Weights {
            gradient: self.config.gradient_weight,
            velocity: self.config.velocity_weight,
            interval: self.snapshots.body().interval,
            share: 1.0 / samples as f64,
        }
    }

    /// One step of the quasi-Newton method, whose H begins anew with a matrix of Gauss and Newton every 100 steps, and where no length along its direction makes the loss smaller; where
    /// even that does not help the parameters stay.
    pub(super) fn finishing_step(&mut self, sample: &mut FixedSample<D>) -> Result<EpochReport, TrainingError> {
        let epoch = self.history.len() as u64;
        let done = epoch - self.config.epochs;
        let due = done.is_multiple_of(STEPS_PER_MATRIX);
        let mut parameters = self.network.parameters().to_vec();
        let mut network = self.network.clone();
        let mut state = self.finish.take().filter(|_| !due);
        let mut length = None;
        for fresh in [false, true] {
            let matrix = (fresh || state.is_none()).then(|| sample.matrix(self, done));
            let mut loss = |at: &[f64]| {
                network.parameters_mut().copy_from_slice(at);
                sample.evaluate(&network, self)
            };
            if let Some(matrix) = &matrix {
                let here = loss(&parameters);
                state = Some(QuasiNewton::new(matrix, &parameters, here, &mut loss));
            }
            length = state.as_mut().and_then(|state| state.step(&mut parameters, &mut loss));
            if length.is_some() || matrix.is_some() {
                break;
            }
        }
        self.network.parameters_mut().copy_from_slice(&parameters);
        let terms = state.as_ref().map_or(Terms::default(), |state| state.terms);
        self.finish = state;
        let loss = terms.total();
        if !loss.is_finite() {
            let step = self.adam.steps + done;
            return Err(TrainingError::NotFinite { epoch, step, loss });
        }
        Ok(EpochReport {
            epoch,
            epochs: self.config.all_epochs(),
            terms,
            rate: length.unwrap_or(0.0),
        })
    }
}
