use std::ops::ControlFlow;
use std::path::Path;

use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;
use rand::seq::{SliceRandom, index};
use rayon::prelude::*;

use super::loss::{PairLoss, Weights};
use super::optimizer::Descent;
use super::{EpochReport, Terms, Training, TrainingError};
use crate::encoder::{Encoder, EncoderShape};
use crate::manifold::{Network, NetworkShape, Scaling};
use crate::model::{Model, Summary};
use crate::snapshots::Snapshots;

/// A training under way: the state after a whole number of passes over all pairs.
#[derive(Debug)]
pub struct Trainer<'a, const D: usize> {
    pub(super) snapshots: &'a Snapshots<D>,
    pub(super) config: Training,
    pub(super) network: Network<D>,
    pub(super) encoder: Encoder<D>,
    pub(super) descent: Descent,
    /// The best parameters so far.
    pub(super) best: Option<Best>,
    /// One report per epoch taken.
    pub(super) history: Vec<EpochReport>,
}

/// The parameters after the epoch of the least mean loss.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Best {
    pub report: EpochReport,
    pub network: Vec<f64>,
    pub encoder: Vec<f64>,
}

impl<'a, const D: usize> Trainer<'a, D> {
    /// A training at its start: Glorot's random weights, scalings from the snapshots.
    ///
    /// # Errors
    /// [`TrainingError::Value`]; [`TrainingError::Network`] where D = 0.
    pub fn new(snapshots: &'a Snapshots<D>, config: Training) -> Result<Self, TrainingError> {
        config.check()?;
        let positions = snapshots.frames().flat_map(|frame| &frame.positions);
        let scaling = Scaling::fit(snapshots.reference(), positions);
        let shape = NetworkShape {
            coordinates: config.coordinates,
            width: config.width,
            depth: config.depth,
        };
        let encoder = EncoderShape {
            points: snapshots.points(),
            width: config.encoder_width,
            coordinates: config.coordinates,
        };
        // Stream 0 draws the start, stream 1 + e all of epoch e.
        let mut generator = ChaCha8Rng::seed_from_u64(config.seed);
        let network = Network::start(shape, scaling.clone(), &mut generator)?;
        let encoder = Encoder::start(encoder, scaling, &mut generator)?;
        Ok(Self {
            snapshots,
            descent: Descent::new(config.optimizer, &network, &encoder),
            config,
            network,
            encoder,
            best: None,
            history: Vec::new(),
        })
    }

    /// Reports of the epochs taken.
    pub fn history(&self) -> &[EpochReport] {
        &self.history
    }

    /// Trains to the last epoch, or until `after_epoch`, which is told every one, breaks. With a path, a checkpoint is left there every
    /// `checkpoint_interval` epochs and at the end, from which [`Self::resume`] goes on to the same bits.
    ///
    /// # Errors
    /// [`TrainingError::NotFinite`], [`TrainingError::File`].
    pub fn train(
        &mut self,
        checkpoint: Option<&Path>,
        after_epoch: &mut dyn FnMut(&EpochReport) -> ControlFlow<()>,
    ) -> Result<(), TrainingError> {
        let worker = PairLoss::new(&self.network, &self.encoder);
        let mut workers = vec![worker; self.config.batch.min(self.pairs().len())];
        let epochs = self.config.epochs;
        while (self.history.len() as u64) < epochs {
            let report = self.epoch(&mut workers)?;
            self.history.push(report);
            let least = self
                .best
                .as_ref()
                .is_none_or(|best| report.terms.total() < best.report.terms.total());
            if least {
                self.best = Some(Best {
                    report,
                    network: self.network.parameters().to_vec(),
                    encoder: self.encoder.parameters().to_vec(),
                });
            }
            let flow = after_epoch(&report);
            let done = self.history.len() as u64;
            let due = done.is_multiple_of(self.config.checkpoint_interval) || done == epochs;
            if let Some(path) = checkpoint.filter(|_| due || flow.is_break()) {
                self.write_checkpoint(path)?;
            }
            if flow.is_break() {
                break;
            }
        }
        Ok(())
    }

    /// The model with the best parameters so far, or those of the start.
    pub fn model(&self) -> Model<D> {
        let (mut network, mut encoder) = (self.network.clone(), self.encoder.clone());
        if let Some(best) = &self.best {
            network.parameters_mut().copy_from_slice(&best.network);
            encoder.parameters_mut().copy_from_slice(&best.encoder);
        }
        let summary = Summary {
            scene: self.snapshots.body().scene.clone(),
            epochs: self.history.len() as u64,
            best: self.best.as_ref().map(|best| best.report),
            training: self.config.clone(),
        };
        Model::new(network, encoder, summary)
    }

    /// All pairs (run, frame).
    pub(super) fn pairs(&self) -> Vec<(usize, usize)> {
        let runs = self.snapshots.runs().iter().enumerate();
        runs.flat_map(|(number, run)| (0..run.frames.len()).map(move |frame| (number, frame)))
            .collect()
    }

    fn epoch(&mut self, workers: &mut [PairLoss<D>]) -> Result<EpochReport, TrainingError> {
        let epoch = self.history.len() as u64;
        let mut generator = ChaCha8Rng::seed_from_u64(self.config.seed);
        generator.set_stream(1 + epoch);
        let mut pairs = self.pairs();
        pairs.shuffle(&mut generator);
        let count = self.config.points.min(self.snapshots.points());
        let of_epoch = pairs.len().div_ceil(self.config.batch) as u64;
        let steps = self.config.epochs.saturating_mul(of_epoch);
        let (mut terms, mut rate) = (Terms::default(), self.config.initial_rate);
        for batch in pairs.chunks(self.config.batch) {
            let mut draw = || index::sample(&mut generator, self.snapshots.points(), count).into_vec();
            let chosen: Vec<Vec<usize>> = batch.iter().map(|_| draw()).collect();
            rate = self.config.rate(self.descent.steps, steps);
            let of_batch = self.step(workers, batch, &chosen, rate);
            let loss = of_batch.total();
            if !loss.is_finite() {
                let step = self.descent.steps - 1;
                return Err(TrainingError::NotFinite { epoch, step, loss });
            }
            terms.add(batch.len() as f64 / pairs.len() as f64, &of_batch);
        }
        Ok(EpochReport {
            epoch,
            epochs: self.config.epochs,
            terms,
            rate,
        })
    }

    /// One step; the loss before it.
    fn step(
        &mut self,
        workers: &mut [PairLoss<D>],
        batch: &[(usize, usize)],
        chosen: &[Vec<usize>],
        rate: f64,
    ) -> Terms {
        let points = chosen.first().map_or(0, Vec::len);
        let weights = Weights {
            gradient: self.config.gradient_weight,
            velocity: self.config.velocity_weight,
            share: 1.0 / (batch.len() * points) as f64,
        };
        let (model, snapshots) = ((&self.network, &self.encoder), self.snapshots);
        let tasks = workers.par_iter_mut().zip(batch).zip(chosen);
        tasks.for_each(|((worker, &(run, frame)), chosen)| {
            worker.clear();
            worker.add(
                model,
                &weights,
                snapshots.reference(),
                &snapshots.runs()[run],
                frame,
                chosen,
            );
        });
        // The order of the batch, whatever thread was first.
        let mut terms = Terms::default();
        let mut gradient = vec![0.0; self.network.parameters().len() + self.encoder.parameters().len()];
        for worker in &workers[..batch.len()] {
            terms.add(1.0, &worker.terms);
            for (sum, part) in gradient.iter_mut().zip(worker.network.iter().chain(&worker.encoder)) {
                *sum += part;
            }
        }
        let (network, encoder) = (self.network.parameters_mut(), self.encoder.parameters_mut());
        self.descent.step(network, encoder, &gradient, rate);
        terms
    }
}
