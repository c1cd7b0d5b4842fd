//! Full-order runs with more points than a model was trained on, and what a coarse run makes of these points.

use super::{Experiment, ExperimentError};
use crate::full_order::{FullOrderError, Recording, SceneDocument, TracedRun};
use crate::online::ReducedBody;
use crate::position_error::PositionError;
use crate::snapshots::{Run, Snapshots};

/// A full-order run of the scene with more points.
pub(super) struct Finer<const D: usize> {
    /// Its only run, about the origin of the training.
    pub snapshots: Snapshots<D>,
    /// The position error of its points as tracers on the full-order run of the coarse scene, in per cent: the baseline.
    pub tracer_error: f64,
}

/// What super-resolution came to in a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SuperResolved {
    /// Points of the scene with more points.
    pub points: usize,
    /// The position error at these points beside their full-order run, in per cent; `None` where no frame was reached but the first.
    pub error: Option<f64>,
    /// That of tracers on the full-order run of the scene that is reduced, in per cent.
    pub tracer_error: f64,
}

impl<const D: usize> Finer<D> {
    /// Runs the test case with this number on the scene of `document` in full, and its points as tracers on a run of `coarse`, which has the frames of `like`.
    pub fn run(
        experiment: &Experiment,
        document: &SceneDocument,
        case: usize,
        coarse: &ReducedBody<D>,
        like: &Snapshots<D>,
    ) -> Result<Self, ExperimentError> {
        let values = &experiment.cases.test[case];
        let scene = experiment.scene_of(document, values)?;
        let recording = Recording::<D>::of(&scene, &experiment.parameters, experiment.recorded_points)?;
        let recording = recording.about(&coarse.centroid);
        let refuse = |message: String| Err(experiment.field("run.super_resolution", message));
        let (found, expected) = (recording.body.interval, like.body().interval);
        if found != expected {
            return refuse(format!(
                "a frame every {found} s, where the scene that is run has one every {expected} s"
            ));
        }
        let refused = |error| ExperimentError::of_test_case(experiment, case, error);
        let (frames, _) = recording.run(&scene).map_err(refused)?;
        let expected = like.frames().count();
        if frames.len() != expected {
            let found = frames.len();
            return refuse(format!(
                "the number of frames is {found}, where the scene that is run has {expected}"
            ));
        }
        let mut error = PositionError::default();
        let mut traced = TracedRun::new(coarse, &recording.body.reference)?;
        for frame in frames.iter().skip(1) {
            traced.advance_frame().map_err(refused)?;
            error.add(&traced.tracers(), &frame.positions);
        }
        let run = Run {
            parameters: values.clone(),
            frames,
        };
        Ok(Self {
            snapshots: Snapshots::new(recording.body, vec![run]).map_err(FullOrderError::from)?,
            tracer_error: error.percent().unwrap_or(0.0),
        })
    }
}
