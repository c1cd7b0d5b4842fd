//! A network, trained, and what is said of it.

use std::ops::ControlFlow;
use std::path::Path;
use std::time::{Duration, Instant};

use super::files::{self, names};
use super::variants::directory_of;
use super::{Experiment, ExperimentError};
use crate::full_order::Recording;
use crate::model::Model;
use crate::snapshots::{Body, Snapshots};
use crate::training::{EpochReport, Trainer, Training};
use crate::words::in_number;

/// Watches an experiment and may stop its training.
pub trait Watch {
    /// After a full-order run; a break ends them, and nothing of them is kept.
    fn after_run(&mut self, _done: usize, _runs: usize) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    /// After an epoch; a break ends the training with a checkpoint to go on from.
    fn after_epoch(&mut self, _report: &EpochReport) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    /// After a reduced run that networks are compared by; a break ends them, and the networks that have been trained are kept.
    fn after_trial(&mut self) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

/// Watches nothing.
impl Watch for () {}

/// What a training came to.
#[derive(Clone, Debug, PartialEq)]
pub struct Trained {
    /// The variant's name; empty for the network of `[training]`.
    pub name: String,
    /// N, material points.
    pub points: usize,
    /// Full-order runs.
    pub runs: usize,
    /// Frames of all of them.
    pub frames: usize,
    /// The networks of which this is the best one; none where no others were trained.
    pub starts: Vec<Start>,
    /// Epochs in all.
    pub epochs: u64,
    /// Epochs of an earlier call.
    pub resumed_at: u64,
    /// Reports of all epochs.
    pub history: Vec<EpochReport>,
    /// What encoder and network lose of the training data, in per cent.
    pub reconstruction_error: f64,
    /// The root mean square of ‖∇_X g̃ − F‖ over all points and frames of the training data.
    pub gradient_error: f64,
    /// Time of the full-order runs in this call; zero where their data were there.
    pub data_time: Duration,
    /// Time of the training in this call.
    pub training_time: Duration,
}

/// One of several networks that differ in their seed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// The seed.
    pub seed: u64,
    /// What encoder and network lose of the training data, in per cent.
    pub reconstruction_error: f64,
    /// The root mean square of ‖∇_X g̃ − F‖ over all points and frames of the training data.
    pub gradient_error: f64,
    /// The root of the mean square of the position errors of reduced runs of up to eight training cases, up to 91 frames each, with the first of everything that the experiment runs but Δt, in per cent; infinite where one of them ends before.
    pub position_error: f64,
}

/// Trains one network, or what is left of it, and writes its model.
pub(super) fn train_network<const D: usize>(
    snapshots: &Snapshots<D>,
    training: &Training,
    directory: &Path,
    watch: &mut dyn Watch,
) -> Result<Trained, ExperimentError> {
    let start = Instant::now();
    let checkpoint = directory.join(names::CHECKPOINT);
    let mut trainer = if checkpoint.exists() {
        Trainer::resume(snapshots, training.clone(), &checkpoint)?
    } else {
        Trainer::new(snapshots, training.clone())?
    };
    let resumed_at = trainer.history().len() as u64;
    let trained = trainer.train(Some(&checkpoint), &mut |report| watch.after_epoch(report));
    trained.map_err(|source| ExperimentError::Network {
        directory: directory.display().to_string(),
        source: Box::new(source),
    })?;
    files::write(&directory.join(names::LOSSES), &losses(trainer.history()))?;
    let epochs = trainer.history().len() as u64;
    if epochs < training.epochs {
        return Err(ExperimentError::Stopped);
    }
    let model = trainer.model();
    model.write(&directory.join(names::MODEL))?;
    Ok(Trained {
        name: String::new(),
        points: snapshots.points(),
        runs: snapshots.runs().len(),
        frames: snapshots.frames().count(),
        starts: Vec::new(),
        epochs,
        resumed_at,
        history: trainer.history().to_vec(),
        reconstruction_error: model.reconstruction_error(snapshots)?,
        gradient_error: model.gradient_error(snapshots)?,
        data_time: Duration::ZERO,
        training_time: start.elapsed(),
    })
}

/// One row per epoch.
fn losses(history: &[EpochReport]) -> String {
    let mut text = "epoch,rate,loss,position,gradient,velocity\n".to_owned();
    for report in history {
        let terms = &report.terms;
        let (total, rate) = (terms.total(), report.rate);
        text += &format!(
            "{},{rate:?},{total:?},{:?},{:?},{:?}\n",
            report.epoch, terms.position, terms.gradient, terms.velocity
        );
    }
    text
}

/// The models of all networks, if they fit the scene, by their names; and the body that they were trained on.
pub(super) fn models_for<const D: usize>(
    experiment: &Experiment,
    directory: &Path,
) -> Result<(Vec<(String, Model<D>)>, Body<D>), ExperimentError> {
    let document = experiment.read_scene()?;
    let scene = experiment.scene_of(&document, &experiment.cases.test[0])?;
    let body = Recording::<D>::of(&scene, &experiment.parameters, experiment.recorded_points)?.body;
    let networks = experiment.trainings()?.into_iter();
    let models = networks.map(|(name, _)| {
        let file = files::made_by_training(directory_of(directory, name).join(names::MODEL))?;
        let model = Model::<D>::read(&file)?;
        let (points, trained_on) = (body.reference.len(), model.encoder().shape().points);
        if model.summary().scene != scene.title || trained_on != points {
            return Err(ExperimentError::OtherScene {
                file: file.display().to_string(),
                found: format!("{}, {}", model.summary().scene, in_number(trained_on, "point")),
                expected: format!("{}, {}", scene.title, in_number(points, "point")),
            });
        }
        Ok((name.to_owned(), model))
    });
    Ok((models.collect::<Result<_, _>>()?, body))
}
