//! Mean and covariance of weighted points.

use super::StatisticsError;

/// First and second moments of weighted points.
#[derive(Clone, Debug, PartialEq)]
pub struct SampleMoments {
    /// x̄ = Σ w_p x_p.
    pub mean: Vec<f64>,
    /// Ĉ = Σ w_p (x_p − x̄)(x_p − x̄)ᵀ, row by row.
    pub covariance: Vec<Vec<f64>>,
}

impl SampleMoments {
    /// Of points with their weights (1/M each where they are equal), whose sum is one.
    ///
    /// # Errors
    /// [`StatisticsError::Length`] where points have different dimensions, or not one weight each.
    pub fn of(points: &[Vec<f64>], weights: Option<&[f64]>) -> Result<Self, StatisticsError> {
        let dimension = points.first().map_or(0, Vec::len);
        let is_of = |what, expected, found| match found == expected {
            true => Ok(()),
            false => Err(StatisticsError::Length { what, expected, found }),
        };
        is_of("weights", points.len(), weights.map_or(points.len(), <[f64]>::len))?;
        for point in points {
            is_of("a point", dimension, point.len())?;
        }
        let weight = |index: usize| weights.map_or(1.0 / points.len() as f64, |weights| weights[index]);
        let mut mean = vec![0.0; dimension];
        for (index, row) in points.iter().enumerate() {
            for (sum, value) in mean.iter_mut().zip(row) {
                *sum += weight(index) * value;
            }
        }
        let mut covariance = vec![vec![0.0; dimension]; dimension];
        for (index, row) in points.iter().enumerate() {
            for i in 0..dimension {
                for j in 0..dimension {
                    covariance[i][j] += weight(index) * (row[i] - mean[i]) * (row[j] - mean[j]);
                }
            }
        }
        Ok(Self { mean, covariance })
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
