//! How much mass a cloud puts on each mode of a target.

use parvi_targets::Mode;

use crate::summation::CompensatedSum;
use crate::{Cloud, MetricError};

/// The masses of a cloud's modes beside the true ones; one entry per mode, in the order of the modes.
#[derive(Clone, Debug, PartialEq)]
pub struct ModeMasses {
    /// The share of the cloud's weight nearest to each mode, sum 1.
    pub masses: Vec<f64>,
    /// The mode's true mass p.
    pub true_masses: Vec<f64>,
    /// √(p(1 − p)/n), the standard error of as many independent draws as the cloud's effective sample size n (its number
    /// of points if the weights are equal): the yardstick for the error.
    pub standard_errors: Vec<f64>,
    /// max |mass − p| over the modes.
    pub largest_error: f64,
}

impl ModeMasses {
    /// Assigns every point to the mode with the smallest |x − centre| / width (the first of equals) and adds the weights.
    ///
    /// # Errors
    /// [`MetricError::NoModes`] for an empty list, [`MetricError::InvalidEntry`] for a mode whose width is not positive and
    /// finite, whose mass is outside \[0, 1\] or whose centre is not finite.
    pub fn new<const D: usize>(cloud: &Cloud<'_, D>, modes: &[Mode<D>]) -> Result<Self, MetricError> {
        check(modes)?;
        let mut sums = vec![CompensatedSum::default(); modes.len()];
        for (point, weight) in cloud.iter() {
            sums[nearest(point, modes)].add(weight);
        }
        let masses: Vec<f64> = sums.iter().map(CompensatedSum::value).collect();
        let true_masses: Vec<f64> = modes.iter().map(|mode| mode.mass).collect();
        let squares = cloud.squared_weight_sum();
        let standard_errors = true_masses.iter().map(|p| (p * (1.0 - p) * squares).sqrt()).collect();
        let largest_error = masses
            .iter()
            .zip(&true_masses)
            .fold(0.0, |e: f64, (mass, p)| e.max((mass - p).abs()));
        Ok(Self {
            masses,
            true_masses,
            standard_errors,
            largest_error,
        })
    }
}

fn check<const D: usize>(modes: &[Mode<D>]) -> Result<(), MetricError> {
    if modes.is_empty() {
        return Err(MetricError::NoModes);
    }
    for (index, mode) in modes.iter().enumerate() {
        let invalid = |name, value, requirement| {
            Err(MetricError::InvalidEntry {
                name,
                index,
                value,
                requirement,
            })
        };
        if !(mode.width.is_finite() && mode.width > 0.0) {
            return invalid("the width of mode", mode.width, "positive and finite");
        }
        if !(0.0..=1.0).contains(&mode.mass) {
            return invalid("the mass of mode", mode.mass, "between 0 and 1");
        }
        if let Some(&value) = mode.centre.iter().find(|value| !value.is_finite()) {
            return invalid("the centre of mode", value, "finite");
        }
    }
    Ok(())
}

/// The index of the nearest mode in units of its width.
fn nearest<const D: usize>(point: &[f64; D], modes: &[Mode<D>]) -> usize {
    let mut best = (0, f64::INFINITY);
    for (index, mode) in modes.iter().enumerate() {
        let distance = mpm_tensor::vector::distance(point, &mode.centre) / mode.width;
        if distance < best.1 {
            best = (index, distance);
        }
    }
    best.0
}
