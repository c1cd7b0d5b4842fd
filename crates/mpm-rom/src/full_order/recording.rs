//! What is kept of the runs of a scene.

use mpm_scenes::{Effort, Scene, Snapshot, frames};
use mpm_tensor::{Matrix, vector};
use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;
use rand::seq::index;
use serde::Deserialize;

use super::{FullOrderError, body_of};
use crate::snapshots::{Body, Frame};

/// Time steps of a frame; none where a Δt is not given, or does not divide it.
pub(crate) fn steps_per_frame(scene: &Scene) -> Option<u64> {
    let steps = scene.output.interval / scene.time.step?;
    (steps >= 0.5 && (steps - steps.round()).abs() <= 1e-6 * steps).then(|| steps.round() as u64)
}

/// Frames that are recorded beside those of the scene (ours): a body that swings within a few frames is not known from these alone.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FramesBetween {
    /// Instants that are looked at, per frame of the scene; they divide its steps.
    pub per_frame: u64,
    /// A frame is kept where the points have moved by this since the last one that was kept: the root mean square of their displacements, over that of their distances from the centroid at rest.
    pub distance: f64,
}

impl FramesBetween {
    /// The scene with a frame at every instant that is looked at.
    pub(crate) fn of(&self, scene: &Scene) -> Result<Scene, FullOrderError> {
        let mut finer = scene.clone();
        finer.output.interval /= self.per_frame as f64;
        match scene.time.step {
            Some(step) if steps_per_frame(&finer).is_none() => Err(FullOrderError::FramesBetween {
                per_frame: self.per_frame,
                steps: (scene.output.interval / step).round() as u64,
            }),
            _ => Ok(finer),
        }
    }

    /// The field that makes no sense, with what is wrong.
    pub(crate) fn fault(&self) -> Option<(&'static str, String)> {
        if self.per_frame < 2 {
            return Some(("per_frame", format!("{}: at least 2", self.per_frame)));
        }
        let positive = self.distance > 0.0 && self.distance.is_finite();
        (!positive).then(|| ("distance", format!("{}: must be positive and finite", self.distance)))
    }
}

/// The points and frames of a scene that are recorded, all or a part.
///
/// A network is trained on samples anyway, and errors are means over points: bodies of millions of points need not be kept whole.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording<const D: usize> {
    /// What all runs of the scene share, with the recorded points only. Its centroid is that of all points unless it has been changed with [`about`](Self::about).
    pub body: Body<D>,
    /// Numbers of the recorded points, ascending.
    points: Vec<usize>,
    between: Option<FramesBetween>,
}

impl<const D: usize> Recording<D> {
    /// At most `count` points of a scene, evenly drawn, the same for every scene with as many points; all of them with `None`.
    ///
    /// # Errors
    /// As [`body_of`].
    pub fn of(scene: &Scene, parameters: &[String], count: Option<usize>) -> Result<Self, FullOrderError> {
        let mut body = body_of::<D>(scene, parameters)?;
        let all = body.reference.len();
        let mut points: Vec<usize> = match count {
            Some(count) if count < all => index::sample(&mut ChaCha8Rng::seed_from_u64(0), all, count).into_vec(),
            _ => (0..all).collect(),
        };
        points.sort_unstable();
        body.reference = points.iter().map(|&p| body.reference[p]).collect();
        Ok(Self {
            body,
            points,
            between: None,
        })
    }

    /// The same points, relative to another origin.
    pub fn about(mut self, centroid: &[f64; D]) -> Self {
        let shift = vector::subtract(&self.body.centroid, centroid);
        self.body.reference = self.body.reference.iter().map(|x| vector::add(x, &shift)).collect();
        self.body.centroid = *centroid;
        self
    }

    /// With frames between those of the scene.
    pub fn with_frames_between(self, between: Option<FramesBetween>) -> Self {
        Self { between, ..self }
    }

    /// All frames of a run of the scene, and what its steps took.
    ///
    /// # Errors
    /// [`FullOrderError::Simulation`], [`FullOrderError::FramesBetween`].
    pub fn run(&self, scene: &Scene) -> Result<(Vec<Frame<D>>, Effort), FullOrderError> {
        let mut all = Vec::new();
        let Some(between) = &self.between else {
            let effort = frames(scene, &mut |snapshot| all.push(self.frame(&snapshot)))?;
            return Ok((all, effort));
        };
        let squares: f64 = self.body.reference.iter().map(vector::norm_squared).sum();
        let far = squares * between.distance * between.distance;
        let mut number = 0;
        let effort = frames(&between.of(scene)?, &mut |snapshot| {
            let frame = self.frame(&snapshot);
            let of_scene = u64::is_multiple_of(number, between.per_frame);
            if of_scene || all.last().is_none_or(|last: &Frame<D>| frame.moved_from(last) >= far) {
                all.push(frame);
            }
            number += 1;
        })?;
        Ok((all, effort))
    }

    /// As [`run`](Self::run), and refuses a run whose time steps were not all as long as those of reduced runs, where the scene's Δt divides its frames.
    ///
    /// # Errors
    /// [`FullOrderError::CutSteps`], and as [`run`](Self::run).
    pub fn run_in_even_steps(&self, scene: &Scene) -> Result<(Vec<Frame<D>>, Effort), FullOrderError> {
        let (frames, effort) = self.run(scene)?;
        let (Some(step), Some(per_frame)) = (scene.time.step, steps_per_frame(scene)) else {
            return Ok((frames, effort));
        };
        let expected = scene.time.end / scene.output.interval * per_frame as f64;
        if (effort.steps as f64 - expected).abs() > 1e-6 * expected {
            return Err(FullOrderError::CutSteps {
                file: scene.file.display().to_string(),
                found: effort.steps,
                step,
                expected,
            });
        }
        Ok((frames, effort))
    }

    fn frame(&self, snapshot: &Snapshot) -> Frame<D> {
        let (positions, _) = snapshot.positions.as_chunks::<D>();
        let (velocities, _) = snapshot.velocities.as_chunks::<D>();
        let (rows, _) = snapshot.deformation_gradients.as_chunks::<D>();
        let (gradients, _) = rows.as_chunks::<D>();
        let positions = self
            .recorded(positions)
            .map(|x| vector::subtract(x, &self.body.centroid));
        Frame {
            time: snapshot.time,
            positions: positions.collect(),
            deformation_gradients: self.recorded(gradients).map(|rows| Matrix(*rows)).collect(),
            velocities: self.recorded(velocities).copied().collect(),
        }
    }

    /// The entries of the recorded points; fewer of a shorter list.
    fn recorded<'a, T>(&'a self, list: &'a [T]) -> impl Iterator<Item = &'a T> {
        self.points.iter().filter_map(|&p| list.get(p))
    }
}
