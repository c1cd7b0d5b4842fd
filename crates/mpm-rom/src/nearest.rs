//! Which of several places is nearest.

use mpm_tensor::vector;

/// The first of the places that are nearest to x.
pub(crate) fn nearest<const D: usize>(x: &[f64; D], places: &[[f64; D]]) -> usize {
    let (mut first, mut least) = (0, f64::INFINITY);
    for (number, place) in places.iter().enumerate() {
        let distance = vector::distance_squared(x, place);
        if distance < least {
            (first, least) = (number, distance);
        }
    }
    first
}
