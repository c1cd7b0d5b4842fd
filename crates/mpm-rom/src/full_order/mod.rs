//! Data for a reduced model: full-order runs of one scene with other parameters each.

mod document;
mod error;
mod recording;
mod tracers;

pub use document::{SceneDocument, Value};
pub use error::FullOrderError;
pub(crate) use recording::steps_per_frame;
pub use recording::{FramesBetween, Recording};
pub use tracers::TracedRun;

use std::ops::ControlFlow;

use mpm_scenes::scene::MaterialTable;
use mpm_scenes::{Population, Scene};
use mpm_tensor::vector;

use crate::snapshots::{Body, Run, Snapshots};

/// A run: the values of its parameters, and the keys of the scene that they change.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// Values of the parameters.
    pub parameters: Vec<f64>,
    /// Dotted keys of the document with their values: `gravity.1`, `kinematic.0.velocity`.
    pub changes: Vec<(String, Value)>,
}

/// What is kept of runs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Kept {
    /// So many points, evenly drawn; all with `None`.
    pub points: Option<usize>,
    /// Frames between those of the scene; none with `None`.
    pub between: Option<FramesBetween>,
}

/// Runs all cases of a scene and collects their frames, that of t = 0 included.
/// `after_run` is told the number of runs done; a break ends them.
///
/// # Errors
/// [`FullOrderError::Stopped`] after a break; [`FullOrderError::Run`] for a run that fails; [`FullOrderError`]: a change that does not fit the document, a scene that cannot be run or that has another body than that of the first case,
/// snapshots that hold what they must not.
pub fn collect<const D: usize>(
    document: &SceneDocument,
    parameters: &[String],
    cases: &[Case],
    kept: &Kept,
    mut after_run: impl FnMut(usize) -> ControlFlow<()>,
) -> Result<Snapshots<D>, FullOrderError> {
    let (mut recording, mut runs) = (None, Vec::with_capacity(cases.len()));
    for (number, case) in cases.iter().enumerate() {
        let scene = document.scene(&case.changes)?;
        let own = Recording::<D>::of(&scene, parameters, kept.points)?.with_frames_between(kept.between);
        let first = recording.get_or_insert_with(|| own.clone());
        if *first != own {
            return Err(FullOrderError::AnotherBody { run: number });
        }
        let run = own.run_in_even_steps(&scene);
        let (frames, _) = run.map_err(|source| FullOrderError::Run {
            run: number,
            values: named(parameters, &case.parameters),
            source: Box::new(source),
        })?;
        let parameters = case.parameters.clone();
        runs.push(Run { parameters, frames });
        if after_run(runs.len()).is_break() && runs.len() < cases.len() {
            return Err(FullOrderError::Stopped { runs: runs.len() });
        }
    }
    let recording = recording.ok_or(FullOrderError::NoRuns)?;
    Ok(Snapshots::new(recording.body, runs)?)
}

/// Parameters with their values.
pub(crate) fn named(parameters: &[String], values: &[f64]) -> String {
    let pairs = parameters.iter().zip(values);
    let pairs: Vec<String> = pairs.map(|(name, value)| format!("{name} = {value:?}")).collect();
    pairs.join(", ")
}

/// What all runs of a scene share: its points, relative to their mean.
///
/// # Errors
/// [`FullOrderError::Dimension`], [`FullOrderError::Scene`], [`FullOrderError::Densities`] for materials of different density.
pub fn body_of<const D: usize>(scene: &Scene, parameters: &[String]) -> Result<Body<D>, FullOrderError> {
    if scene.dimension != D {
        return Err(FullOrderError::Dimension {
            found: scene.dimension,
            expected: D,
        });
    }
    let population = Population::<D>::fill(scene).map_err(|fault| scene.error(fault))?;
    let mut densities: Vec<f64> = scene.materials.values().map(MaterialTable::density).collect();
    densities.dedup();
    let [density] = densities[..] else {
        return Err(FullOrderError::Densities { densities });
    };
    let centroid = centroid(&population.positions);
    let reference = population.positions.iter();
    Ok(Body {
        scene: scene.title.clone(),
        reference: reference.map(|x| vector::subtract(x, &centroid)).collect(),
        centroid,
        interval: scene.output.interval,
        density,
        parameters: parameters.to_vec(),
    })
}

/// The mean of the points.
pub fn centroid<const D: usize>(points: &[[f64; D]]) -> [f64; D] {
    let share = 1.0 / points.len().max(1) as f64;
    let mut mean = [0.0; D];
    for x in points {
        vector::accumulate(&mut mean, share, x);
    }
    mean
}
