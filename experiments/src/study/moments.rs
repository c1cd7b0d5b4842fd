//! Mean and covariance of particles whose dimension is known at run time.

use crate::output::Particles;

/// First and second moments of weighted points.
#[derive(Clone, Debug, PartialEq)]
pub struct SampleMoments {
    /// x̄ = Σ w_p x_p.
    pub mean: Vec<f64>,
    /// Ĉ = Σ w_p (x_p − x̄)(x_p − x̄)ᵀ, row by row.
    pub covariance: Vec<Vec<f64>>,
}

impl SampleMoments {
    /// Of the particles with their weights (1/M each where they are equal).
    pub fn of(particles: &Particles) -> Self {
        let dimension = particles.dimension();
        let mut mean = vec![0.0; dimension];
        for (index, row) in particles.rows().enumerate() {
            let weight = particles.weight(index);
            for (sum, value) in mean.iter_mut().zip(row) {
                *sum += weight * value;
            }
        }
        let mut covariance = vec![vec![0.0; dimension]; dimension];
        for (index, row) in particles.rows().enumerate() {
            let weight = particles.weight(index);
            for i in 0..dimension {
                for j in 0..dimension {
                    covariance[i][j] += weight * (row[i] - mean[i]) * (row[j] - mean[j]);
                }
            }
        }
        Self { mean, covariance }
    }

    /// √Ĉ_ii.
    pub fn standard_deviations(&self) -> Vec<f64> {
        (0..self.mean.len())
            .map(|axis| self.covariance[axis][axis].sqrt())
            .collect()
    }

    /// max_i |x̄_i|.
    pub fn largest_mean(&self) -> f64 {
        self.mean.iter().fold(0.0, |worst, value| worst.max(value.abs()))
    }

    /// max_ij |Ĉ − I|_ij.
    pub fn distance_from_identity(&self) -> f64 {
        let mut worst: f64 = 0.0;
        for (i, row) in self.covariance.iter().enumerate() {
            for (j, entry) in row.iter().enumerate() {
                worst = worst.max((entry - f64::from(u8::from(i == j))).abs());
            }
        }
        worst
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_corners_of_a_square_have_unit_covariance() {
        let corners = [[4.0, 1.0], [4.0, -1.0], [2.0, 1.0], [2.0, -1.0]];
        let moments = SampleMoments::of(&Particles::new(&corners, None));
        assert_eq!(moments.mean, [3.0, 0.0]);
        assert_eq!(moments.distance_from_identity(), 0.0);
        assert_eq!(moments.largest_mean(), 3.0);
    }

    #[test]
    fn weights_count() {
        let moments = SampleMoments::of(&Particles::new(&[[0.0], [4.0]], Some(&[0.75, 0.25])));
        assert_eq!((moments.mean[0], moments.covariance[0][0]), (1.0, 3.0));
    }
}
