//! A target seen through a triangular map.

use parvi_targets::Target;

use crate::drive::{Driven, finite};
use crate::triangular_map::{Image, TriangularMap};
use crate::{SampleError, Samples};

/// The density of z where x(z) has density p: log q(z) = log p(x(z)) + log det ∂x/∂z.
pub(crate) struct MappedTarget<'a, const D: usize> {
    pub target: &'a dyn Target<D>,
    pub map: &'a TriangularMap<D>,
}

impl<const D: usize> MappedTarget<'_, D> {
    fn images(&self, zs: &[[f64; D]]) -> (Vec<Image<D>>, Vec<[f64; D]>) {
        let images: Vec<Image<D>> = zs.iter().map(|z| self.map.image(z)).collect();
        let points = images.iter().map(|image| image.x).collect();
        (images, points)
    }
}

impl<const D: usize> Target<D> for MappedTarget<'_, D> {
    fn log_density(&self, z: &[f64; D]) -> f64 {
        let image = self.map.image(z);
        self.target.log_density(&image.x) + self.map.log_determinant(&image)
    }

    fn score(&self, z: &[f64; D]) -> [f64; D] {
        let image = self.map.image(z);
        self.map.pull_back_score(z, &image, &self.target.score(&image.x))
    }

    fn scores(&self, zs: &[[f64; D]], out: &mut [[f64; D]]) {
        let (images, points) = self.images(zs);
        self.target.scores(&points, out);
        for ((z, image), score) in zs.iter().zip(&images).zip(out) {
            *score = self.map.pull_back_score(z, image, score);
        }
    }

    fn log_densities(&self, zs: &[[f64; D]], out: &mut [f64]) {
        let (images, points) = self.images(zs);
        self.target.log_densities(&points, out);
        for (image, log_density) in images.iter().zip(out) {
            *log_density += self.map.log_determinant(image);
        }
    }
}

impl<const D: usize> TriangularMap<D> {
    /// A body that moved in the coordinates z, with its particles in the target's.
    pub fn driven(&self, body: Driven<D>) -> Result<Driven<D>, SampleError> {
        let images = body.samples.positions.iter().map(|z| self.image(z).x).collect();
        let positions = finite(images, body.samples.steps)?;
        let samples = Samples {
            positions,
            ..body.samples
        };
        Ok(Driven { samples, ..body })
    }

    /// An error that says where in the target's coordinates it happened.
    pub fn explained(&self, error: SampleError) -> SampleError {
        match error {
            SampleError::ScoreNotFinite { step, position, score } => {
                let z = <[f64; D]>::try_from(position.as_slice());
                SampleError::ScoreNotFinite {
                    step,
                    position: z.map_or(position, |z| self.image(&z).x.to_vec()),
                    score,
                }
            }
            other => other,
        }
    }
}

#[cfg(test)]
mod tests {
    use mpm_tensor::Matrix;
    use parvi_targets::Banana;

    use super::*;

    #[test]
    fn batches_are_their_points_and_errors_speak_of_the_target() {
        let target = Banana::new(1.0, 0.5).unwrap();
        let covariance = Matrix([[4.0, 0.5], [0.5, 1.0]]);
        let map = TriangularMap::gaussian(&[1.0, 2.0], &covariance, [1, 0]).unwrap();
        let mapped = MappedTarget {
            target: &target,
            map: &map,
        };
        let zs = [[0.3, -1.0], [2.0, 0.1], [0.0, 0.0]];
        let (mut scores, mut log_densities) = ([[0.0; 2]; 3], [0.0; 3]);
        mapped.scores(&zs, &mut scores);
        mapped.log_densities(&zs, &mut log_densities);
        for (k, z) in zs.iter().enumerate() {
            assert_eq!(scores[k], mapped.score(z));
            assert_eq!(log_densities[k], mapped.log_density(z));
        }
        let error = |position: &[f64]| SampleError::ScoreNotFinite {
            step: 3,
            position: position.to_vec(),
            score: vec![f64::NAN; 2],
        };
        let explained = map.explained(error(&[0.0, 0.0])).to_string();
        assert!(explained.contains("[1.0, 2.0]"), "{explained}");
    }
}
