//! What the runs of the test cases need: scenes, models, manifolds and training data.

use std::cell::RefCell;
use std::path::Path;

use super::choices::maps;
use super::chosen::Chosen;
use super::error::unless_impossible;
use super::files::names;
use super::sampling::Sampling;
use super::trained::models_for;
use super::{Experiment, ExperimentError, ManifoldName};
use crate::full_order::SceneDocument;
use crate::manifold::{Manifold, Pod};
use crate::model::Model;
use crate::snapshots::{Body, Snapshots};
use crate::words::in_number;

/// Read once, before the runs.
pub(super) struct AtHand<'a, const D: usize> {
    pub experiment: &'a Experiment,
    pub directory: &'a Path,
    /// The scene that reduced runs are runs of.
    pub document: SceneDocument,
    /// The same with more points.
    pub finer: Option<SceneDocument>,
    /// The networks with the names of their variants.
    pub models: Vec<(String, Model<D>)>,
    /// The body that they were trained on.
    pub trained_on: Body<D>,
    /// x̂ of the body at rest, by network.
    pub at_rest: Vec<Vec<f64>>,
    /// Linear manifolds and choices of sample points are made of it; nothing where there are none.
    training: Option<Snapshots<D>>,
    linear: Option<Pod<D>>,
}

/// Manifolds on whose training runs no sample points can be chosen: family, network and reason.
pub(super) type WithoutPoints = Vec<(ManifoldName, usize, String)>;

impl<'a, const D: usize> AtHand<'a, D> {
    /// All of it, and whether it fits together.
    pub fn read(experiment: &'a Experiment, directory: &'a Path) -> Result<Self, ExperimentError> {
        let document = experiment.read_run_scene()?;
        let finer = experiment.super_resolution_file();
        let finer = finer.map(|file| experiment.read_named("run.super_resolution", &file));
        let finer = finer.transpose()?;
        let (models, trained_on) = models_for::<D>(experiment, directory)?;
        let at_rest = models
            .iter()
            .map(|(_, model)| model.encoder().encode(&trained_on.reference));
        let at_rest = at_rest.collect::<Result<_, _>>()?;
        let is_linear = experiment.run.manifold.contains(&ManifoldName::Linear);
        let is_needed = is_linear || experiment.run.chooses_on_training();
        let training: Option<Snapshots<D>> = is_needed.then(|| experiment.read_data(directory)).transpose()?;
        let points = trained_on.reference.len();
        if let Some(snapshots) = training.as_ref().filter(|snapshots| snapshots.points() != points) {
            return Err(ExperimentError::OtherData {
                file: directory.join(names::TRAINING_DATA).display().to_string(),
                found: in_number(snapshots.points(), "point"),
                expected: in_number(points, "point"),
            });
        }
        let refused = |error| experiment.field("run.manifold", format!("\"linear\": {error}"));
        let linear = training.as_ref().filter(|_| is_linear);
        let linear = linear.map(|snapshots| Pod::new(snapshots, experiment.training.coordinates));
        Ok(Self {
            linear: linear.transpose().map_err(refused)?,
            experiment,
            directory,
            document,
            finer,
            models,
            trained_on,
            at_rest,
            training,
        })
    }

    /// The manifold of a family; `network` is the number of a network.
    pub fn manifold(&self, name: ManifoldName, network: usize) -> &dyn Manifold<D> {
        match (name, &self.linear) {
            (ManifoldName::Linear, Some(pod)) => pod,
            _ => self.models[network].1.network(),
        }
    }

    /// Sample points, where they are chosen on training runs. `go_on` is asked after every trial.
    pub fn choose_points(
        &self,
        go_on: &mut dyn FnMut() -> bool,
    ) -> Result<(Chosen<D>, WithoutPoints), ExperimentError> {
        let experiment = self.experiment;
        let (mut chosen, mut without_points) = (Chosen::default(), Vec::new());
        let training = self.training.as_ref();
        let Some(snapshots) = training.filter(|_| experiment.run.chooses_on_training()) else {
            return Ok((chosen, without_points));
        };
        let (document, go_on) = (experiment.read_scene()?, RefCell::new(go_on));
        for (name, network) in maps(experiment, self.models.len()) {
            let sampling = Sampling {
                experiment,
                document: &document,
                model: &self.models[network].1,
                network,
                name,
                manifold: self.manifold(name, network),
                snapshots,
                go_on: &|| go_on.borrow_mut()(),
            };
            if let Err(reason) = unless_impossible(sampling.choose(&mut chosen))? {
                without_points.push((name, network, reason));
            }
        }
        Ok((chosen, without_points))
    }
}
