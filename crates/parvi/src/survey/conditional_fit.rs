//! A first triangular map, from how the scores change along each coordinate.

use super::density::Density;
use super::map_fit::mean;
use crate::cholesky::Cholesky;
use crate::triangular_map::{Image, TriangularMap, features};

/// Scores are compared at z_i plus and minus this.
const STEP: f64 = 0.5;

/// Curvatures below this share of their mean are raised to it.
const LEAST_CURVATURE: f64 = 0.01;

/// Relative ridge of the regressions.
const RIDGE: f64 = 1e-10;

/// The last coordinate given the others, then the one before it given those before, and so on: where the score of y_i is
/// −e^{−2 l_i} (y_i − m_i), its values s_± at z_i ± h give the curvature c = (s_− − s_+)/2h and with it l_i + ½ log 1/c and
/// m_i = y_i + e^{l_i} (s_+ + s_−)/2c at every node, and regressions on the features the coefficients. Through a coordinate that is right the ones before it
/// see the score of their marginal. Exact for a density that a map represents, wherever the nodes are.
///
/// `None` where the target is not finite or somewhere not concave on average.
pub(super) fn conditional_fit<const D: usize>(
    density: &mut Density<'_, D>,
    start: &TriangularMap<D>,
    nodes: &[[f64; D]],
) -> Option<TriangularMap<D>> {
    let mut map = start.clone();
    for i in (0..D).rev() {
        let mut scores_at = |step: f64| -> Option<Vec<f64>> {
            let moved: Vec<[f64; D]> = nodes
                .iter()
                .map(|z| {
                    let mut z = *z;
                    z[i] += step;
                    z
                })
                .collect();
            let images: Vec<Image<D>> = moved.iter().map(|z| map.image(z)).collect();
            let points: Vec<[f64; D]> = images.iter().map(|image| image.x).collect();
            let values = density.values(&points)?;
            let pulled = moved.iter().zip(&images).zip(&values);
            // Of log p alone, without z_i's own log scale: e^{l_i} times the score of y_i.
            Some(
                pulled
                    .map(|((z, image), value)| map.pull_back_score(z, image, &value.score)[i])
                    .collect(),
            )
        };
        let (ahead, behind) = (scores_at(STEP)?, scores_at(-STEP)?);
        let curvatures = ahead.iter().zip(&behind).map(|(a, b)| (b - a) / (2.0 * STEP));
        let mean_curvature = mean(curvatures.clone());
        if !(mean_curvature > 0.0 && mean_curvature.is_finite()) {
            return None;
        }
        let (mut scales, mut locations) = (Regression::new(i, false), Regression::new(i, true));
        for (((z, curvature), a), b) in nodes.iter().zip(curvatures).zip(&ahead).zip(&behind) {
            let curvature = curvature.max(LEAST_CURVATURE * mean_curvature);
            let image = map.image(z);
            let (precision, _, before) = map.sensitivity(i, &image);
            let log_scale = -precision.ln() - 0.5 * curvature.ln();
            let location = image.y(i) + 0.5 * (a + b) / (curvature * precision);
            scales.add(before, 1.0, log_scale);
            locations.add(before, curvature * precision * precision, location);
        }
        map = map.with_block(i, &locations.coefficients()?, &scales.coefficients()?);
    }
    Some(map)
}

/// Normal equations of a weighted regression on the features of a coordinate.
struct Regression {
    quadratic: bool,
    matrix: Vec<Vec<f64>>,
    right_hand_side: Vec<f64>,
}

impl Regression {
    fn new(before: usize, quadratic: bool) -> Self {
        let size = features(&vec![0.0; before], quadratic).count();
        Self {
            quadratic,
            matrix: vec![vec![0.0; size]; size],
            right_hand_side: vec![0.0; size],
        }
    }

    fn add(&mut self, before: &[f64], weight: f64, value: f64) {
        let features: Vec<f64> = features(before, self.quadratic).collect();
        for (row, &a) in features.iter().enumerate() {
            self.right_hand_side[row] += weight * a * value;
            for (entry, &b) in self.matrix[row].iter_mut().zip(&features) {
                *entry += weight * a * b;
            }
        }
    }

    fn coefficients(mut self) -> Option<Vec<f64>> {
        for k in 0..self.matrix.len() {
            self.matrix[k][k] *= 1.0 + RIDGE;
        }
        Some(Cholesky::new(self.matrix)?.solve(&self.right_hand_side))
    }
}

#[cfg(test)]
mod tests {
    use mpm_tensor::{Matrix, vector};
    use parvi_targets::{Banana, Frame, StudentT, Target};

    use super::*;
    use crate::survey::gaussian_fit::balanced_nodes;

    fn fitted(target: &dyn Target<2>, centre: [f64; 2], variance: f64) -> Option<TriangularMap<2>> {
        let frame = Frame::identity();
        let nodes = balanced_nodes::<2>(32, 1).unwrap();
        let start = TriangularMap::gaussian(&centre, &(Matrix::IDENTITY * variance), [0, 1]).unwrap();
        conditional_fit(&mut Density::new(target, &frame), &start, &nodes)
    }

    #[test]
    fn a_banana_is_read_off_its_scores_from_beside_it() {
        let map = fitted(&Banana::new(2.0, 0.2).unwrap(), [1.5, -1.0], 0.01).unwrap();
        for z in [[0.0, 0.0], [1.0, -2.0], [-2.5, 0.4]] {
            // x₁ = z₁, x₂ = 2 (x₁² − 1) + 0.2 z₂.
            let wanted = [z[0], 2.0 * (z[0] * z[0] - 1.0) + 0.2 * z[1]];
            assert!(
                vector::distance(&map.image(&z).x, &wanted) < 1e-3,
                "{:?} {wanted:?}",
                map.image(&z).x
            );
        }
    }

    #[test]
    fn a_convex_stretch_gives_no_map() {
        assert!(fitted(&StudentT::new(3.0).unwrap(), [30.0, 30.0], 0.01).is_none());
    }
}
