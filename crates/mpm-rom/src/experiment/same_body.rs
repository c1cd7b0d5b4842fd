//! Whether other scenes have the body that is trained on.

use mpm_scenes::Scene;
use mpm_scenes::shape::Shape;
use mpm_tensor::vector;

use super::{Experiment, ExperimentError};
use crate::full_order::body_of;
use crate::online::shapes_of;

impl Experiment {
    /// Refuses scenes of reduced runs and of the super-resolution that have another body than that of the training: a network says something of any place, and errors there mean nothing.
    ///
    /// # Errors
    /// [`ExperimentError::Field`], and what the scenes' own reader says.
    pub(super) fn check_same_body<const D: usize>(&self) -> Result<(), ExperimentError> {
        let files = [
            ("run.scene", self.run.scene.as_ref().map(|_| self.run_scene_file())),
            ("run.super_resolution", self.super_resolution_file()),
        ];
        let values = &self.cases.test[0];
        let mut trained_on = None;
        for (key, file) in files {
            let Some(file) = file else { continue };
            let trained_on = match &trained_on {
                Some(filled) => filled,
                None => trained_on.insert(Filled::<D>::of(&self.scene_of(&self.read_scene()?, values)?)?),
            };
            let other = Filled::of(&self.scene_of(&self.read_named(key, &file)?, values)?)?;
            if let Some(x) = trained_on.beside(&other).or_else(|| other.beside(trained_on)) {
                let message = format!("another body than that of the training: only one of them has a point at {x:?}");
                return Err(self.field(key, message));
            }
        }
        Ok(())
    }
}

/// What a scene fills, and with what.
struct Filled<const D: usize> {
    positions: Vec<[f64; D]>,
    shapes: Vec<Box<dyn Shape<D>>>,
    /// Half the spacing of the grid: so far off the shapes a filling may be, as at the edges of a mesh.
    close: f64,
}

impl<const D: usize> Filled<D> {
    fn of(scene: &Scene) -> Result<Self, ExperimentError> {
        let body = body_of::<D>(scene, &[])?;
        Ok(Self {
            positions: body.reference.iter().map(|x| vector::add(x, &body.centroid)).collect(),
            shapes: shapes_of(scene)?,
            close: scene.grid.as_ref().map_or(0.0, |grid| 0.5 * grid.spacing),
        })
    }

    /// The first point of another one that is beside the shapes.
    fn beside(&self, other: &Self) -> Option<[f64; D]> {
        let close = self.close.max(other.close);
        let inside = |x: &[f64; D]| self.shapes.iter().any(|shape| shape.distance(x) <= close);
        other.positions.iter().find(|x| !inside(x)).copied()
    }
}
