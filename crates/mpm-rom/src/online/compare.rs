//! Reduced runs beside full-order ones.

use super::{OnlineError, ReducedModel};
use crate::manifold::{Evaluation, Manifold, Wanted};
use crate::position_error::PositionError;
use crate::snapshots::Frame;

/// The position error of a reduced run that begins at t = 0, over all frames after the first, which it starts from, and all material points.
///
/// # Errors
/// As [`ReducedModel::step`].
pub fn compare<const D: usize, M: Manifold<D>>(
    model: &mut ReducedModel<D, M>,
    frames: &[Frame<D>],
) -> Result<PositionError, OnlineError> {
    let (points, mut there, mut error) = (model.points().clone(), Evaluation::default(), PositionError::default());
    for frame in frames.iter().skip(1) {
        model.advance_frame()?;
        model.evaluate(&points, Wanted::default(), &mut there);
        error.add(&there.positions, &frame.positions);
    }
    Ok(error)
}

/// Positions of other points of the body than those that the model was made with, in every frame of a run of so many frames, that of t = 0 first; `reference` is relative to the
/// model's centroid. The dynamics are those of the model's own points: detail costs one evaluation of the map per frame.
///
/// # Errors
/// As [`ReducedModel::step`].
pub fn super_resolve<const D: usize, M: Manifold<D>>(
    model: &mut ReducedModel<D, M>,
    reference: &[[f64; D]],
    frames: usize,
) -> Result<Vec<Vec<[f64; D]>>, OnlineError> {
    let (points, mut there) = (model.prepare(reference), Evaluation::default());
    let mut all = Vec::with_capacity(frames);
    for frame in 0..frames {
        if frame > 0 {
            model.advance_frame()?;
        }
        model.evaluate(&points, Wanted::default(), &mut there);
        all.push(there.positions.clone());
    }
    Ok(all)
}
