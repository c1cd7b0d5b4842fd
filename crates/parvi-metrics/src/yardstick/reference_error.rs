//! How well a sample that stands for a target is known itself.

use parvi_targets::ReferenceMoments;

/// What the points of a sample are worth, and the largest standard errors of their moments over the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReferenceError {
    /// (Σ w)² / Σ w², the independent draws that the points are worth.
    pub effective_size: f64,
    /// Of a mean, in standard deviations; 0 where the target's mean is known exactly.
    pub mean: f64,
    /// Of a standard deviation, as a part of it; 0 where the target's covariance is known exactly.
    pub deviation: f64,
}

impl ReferenceError {
    /// Of a sample's moments; of an axis without spread nothing is known, which is an infinite error.
    pub fn of<const D: usize>(moments: &ReferenceMoments<D>) -> Self {
        let largest = |errors: &[f64; D]| {
            let part = |axis: usize| errors[axis] / moments.moments.covariance.0[axis][axis].sqrt();
            let known = |error: f64| if error.is_nan() { f64::INFINITY } else { error };
            (0..D).map(part).map(known).fold(0.0, f64::max)
        };
        Self {
            effective_size: moments.effective_sample_size,
            mean: largest(&moments.mean_error),
            deviation: largest(&moments.standard_deviation_error),
        }
    }
}

#[cfg(test)]
mod tests {
    use mpm_tensor::Matrix;
    use parvi_targets::Moments;

    use super::*;

    #[test]
    fn errors_are_in_standard_deviations_and_unknown_without_spread() {
        let mut moments = ReferenceMoments {
            moments: Moments {
                mean: [1.0, 2.0],
                covariance: Matrix([[4.0, 0.0], [0.0, 9.0]]),
            },
            mean_error: [0.1, 0.3],
            standard_deviation_error: [0.4, 0.3],
            effective_sample_size: 17.0,
        };
        let error = ReferenceError::of(&moments);
        assert_eq!(
            (error.effective_size, error.mean, error.deviation),
            (17.0, 0.3 / 3.0, 0.2)
        );
        moments.moments.covariance.0[0][0] = 0.0;
        moments.mean_error[0] = 0.0;
        assert_eq!(ReferenceError::of(&moments).mean, f64::INFINITY);
    }
}
