//! More points than the dynamics know.

use super::{OnlineError, ReducedModel};
use crate::manifold::{Evaluation, Manifold, Wanted};

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
