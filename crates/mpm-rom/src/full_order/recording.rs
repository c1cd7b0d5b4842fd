//! What is kept of the runs of a scene.

use mpm_scenes::{Effort, Scene, Snapshot, frames};
use mpm_tensor::{Matrix, vector};
use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;
use rand::seq::index;

use super::{FullOrderError, body_of};
use crate::snapshots::{Body, Frame};

/// The points of a scene that are recorded, all or a part.
///
/// A network is trained on samples anyway, and errors are means over points: bodies of millions of points need not be kept whole.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording<const D: usize> {
    /// What all runs of the scene share, with the recorded points only. Its centroid is that of all points unless it has been changed with [`about`](Self::about).
    pub body: Body<D>,
    /// Numbers of the recorded points, ascending; `None` for all.
    points: Option<Vec<usize>>,
}

impl<const D: usize> Recording<D> {
    /// At most `count` points of a scene, evenly drawn, the same for every scene with as many points; all of them with `None`.
    ///
    /// # Errors
    /// As [`body_of`].
    pub fn of(scene: &Scene, parameters: &[String], count: Option<usize>) -> Result<Self, FullOrderError> {
        let mut body = body_of::<D>(scene, parameters)?;
        let all = body.reference.len();
        let points = count.filter(|&count| count < all).map(|count| {
            let mut numbers = index::sample(&mut ChaCha8Rng::seed_from_u64(0), all, count).into_vec();
            numbers.sort_unstable();
            numbers
        });
        if points.is_some() {
            body.reference = each(&body.reference, points.as_deref(), |x| *x);
        }
        Ok(Self { body, points })
    }

    /// The same points, relative to another origin.
    pub fn about(mut self, centroid: &[f64; D]) -> Self {
        let shift = vector::subtract(&self.body.centroid, centroid);
        self.body.reference = self.body.reference.iter().map(|x| vector::add(x, &shift)).collect();
        self.body.centroid = *centroid;
        self
    }

    /// All frames of a run of the scene, and what its steps took.
    ///
    /// # Errors
    /// [`FullOrderError::Simulation`].
    pub fn run(&self, scene: &Scene) -> Result<(Vec<Frame<D>>, Effort), FullOrderError> {
        let mut all = Vec::new();
        let effort = frames(scene, &mut |snapshot| all.push(self.frame(&snapshot)))?;
        Ok((all, effort))
    }

    fn frame(&self, snapshot: &Snapshot) -> Frame<D> {
        let (positions, _) = snapshot.positions.as_chunks::<D>();
        let (velocities, _) = snapshot.velocities.as_chunks::<D>();
        let (rows, _) = snapshot.deformation_gradients.as_chunks::<D>();
        let (gradients, _) = rows.as_chunks::<D>();
        let points = self.points.as_deref();
        let centroid = &self.body.centroid;
        Frame {
            positions: each(positions, points, |x| vector::subtract(x, centroid)),
            deformation_gradients: each(gradients, points, |rows| Matrix(*rows)),
            velocities: each(velocities, points, |v| *v),
        }
    }
}

/// The function of all entries, or of those at some places.
fn each<T, U>(list: &[T], points: Option<&[usize]>, function: impl Fn(&T) -> U) -> Vec<U> {
    match points {
        None => list.iter().map(function).collect(),
        Some(points) => points.iter().filter_map(|&p| list.get(p)).map(function).collect(),
    }
}
