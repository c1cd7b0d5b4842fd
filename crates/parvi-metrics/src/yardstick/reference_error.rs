//! How well a sample that stands for a target is known itself.

use parvi_targets::ReferenceMoments;

use super::YardstickError;

/// Of fewer draws neither the spread nor the effective size itself is known.
const LEAST_SIZE: usize = 100;

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

    /// Refuses a sample that is worth fewer independent draws than it is compared with particles, or fewer than 100: what is measured against it would be its own error.
    ///
    /// # Errors
    /// [`YardstickError::ReferenceTooSmall`].
    pub fn suffices_for(&self, particles: usize) -> Result<(), YardstickError> {
        let (effective_size, needed) = (self.effective_size, particles.max(LEAST_SIZE));
        // A size that is NaN suffices for nothing; rounding takes nothing from a sample of equal weights.
        if effective_size * (1.0 + 1e-9) >= needed as f64 {
            return Ok(());
        }
        Err(YardstickError::ReferenceTooSmall { effective_size, needed })
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

    #[test]
    fn a_sample_is_worth_at_least_what_is_compared_with_it() {
        let suffices = |effective_size: f64, particles: usize| {
            let error = ReferenceError {
                effective_size,
                mean: 0.0,
                deviation: 0.0,
            };
            error.suffices_for(particles)
        };
        assert!(suffices(1024.0 - 1e-8, 1024).is_ok() && suffices(100.0, 2).is_ok());
        assert!(suffices(99.0, 2).is_err() && suffices(f64::NAN, 2).is_err());
        let message = suffices(1.0, 300).unwrap_err().to_string();
        assert_eq!(
            message,
            "the importance sample that stands for the target is worth 1.0 independent draws, not 300"
        );
    }
}
