//! The shape of an "&".

use super::{EdgeTarget, outlines};
use crate::SimplexMesh;
use crate::generate::GenerationError;

/// The outline of an "&" of height 10, against the clock. Ours.
const OUTLINE: [[f64; 2]; 19] = [
    [0.0, 2.0],
    [1.0, 0.4],
    [3.0, 0.0],
    [4.6, 0.6],
    [5.4, 1.4],
    [6.6, 0.0],
    [8.6, 0.0],
    [6.6, 2.6],
    [7.8, 4.6],
    [6.4, 5.2],
    [5.5, 3.9],
    [4.2, 5.6],
    [5.3, 7.2],
    [4.8, 9.2],
    [3.2, 10.0],
    [1.6, 9.2],
    [1.1, 7.4],
    [1.9, 5.8],
    [0.5, 4.2],
];

/// The hole in its upper and the hole in its lower part.
const HOLES: [&[[f64; 2]]; 2] = [
    &[[2.3, 7.3], [3.2, 6.5], [4.1, 7.4], [3.9, 8.6], [3.2, 9.0], [2.5, 8.5]],
    &[[1.5, 2.4], [2.2, 1.4], [3.3, 1.3], [4.2, 2.1], [3.0, 4.4], [1.9, 3.8]],
];

/// A mesh of an "&" of a given height that stands on y = 0, with two holes and re-entrant corners: the domain on which Cao et al. (2024) look at the
/// kernel; its corners are ours. See [`outlines`].
///
/// # Errors
/// [`GenerationError::InvalidParameter`] unless the height is positive; as [`outlines`].
pub fn ampersand(height: f64, target: &EdgeTarget) -> Result<SimplexMesh<2>, GenerationError> {
    GenerationError::check_positive("height", height)?;
    let all = std::iter::once(&OUTLINE[..]).chain(HOLES);
    let scaled: Vec<Vec<[f64; 2]>> = all
        .map(|corners| corners.iter().map(|x| x.map(|c| 0.1 * height * c)).collect())
        .collect();
    outlines(&scaled, target)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ½ Σ x_k y_{k+1} − x_{k+1} y_k.
    fn area(corners: &[[f64; 2]]) -> f64 {
        let pairs = corners.iter().zip(corners.iter().cycle().skip(1));
        0.5 * pairs.map(|(a, b)| a[0] * b[1] - b[0] * a[1]).sum::<f64>()
    }

    /// `ampersand` of the suite has this area.
    #[test]
    fn its_area_is_that_of_the_outline_without_the_holes() {
        let holes = HOLES.iter().map(|hole| area(hole)).sum::<f64>();
        assert!((area(&OUTLINE) - holes - 38.585).abs() < 1e-12);
    }
}
