//! Mean and standard deviation of every coordinate, with what is known of their errors.

use parvi::{Certificate, EstimatedMoment, Expectation, MomentEstimate, Samples, expectation};
use parvi_targets::CatalogueTarget;
use serde::Serialize;

/// A moment of the particles.
#[derive(Debug, Serialize)]
pub struct Moment {
    /// The particles' own.
    pub value: f64,
    /// The target's by the scores; `null` where they do not tell.
    pub estimate: Option<f64>,
    /// Standard error of `value`.
    pub standard_error: Option<f64>,
    /// Share of its spread that the scores leave unexplained.
    pub unexplained: Option<f64>,
}

impl From<EstimatedMoment> for Moment {
    fn from(known: EstimatedMoment) -> Self {
        Self {
            value: known.value,
            estimate: Some(known.estimate),
            standard_error: Some(known.standard_error),
            unexplained: Some(known.unexplained),
        }
    }
}

/// Mean and standard deviation of every coordinate, as the certificate has them.
pub fn of_certificate(certificate: &Certificate) -> Vec<(Moment, Moment)> {
    let both = |known: &MomentEstimate| (known.mean.into(), known.standard_deviation.into());
    certificate.moments.iter().map(both).collect()
}

/// The same from the scores at the particles of any method.
pub fn of_expectations<const D: usize>(
    target: &dyn CatalogueTarget<D>,
    points: &[[f64; D]],
    weights: Option<&[f64]>,
) -> Vec<(Moment, Moment)> {
    let samples = Samples {
        positions: points.to_vec(),
        weights: weights.map(<[f64]>::to_vec),
        ..Samples::default()
    };
    let share = |p: usize| weights.map_or(1.0 / points.len() as f64, |weights| weights[p]);
    let average =
        |value: &dyn Fn(&[f64; D]) -> f64| -> f64 { points.iter().enumerate().map(|(p, x)| share(p) * value(x)).sum() };
    let both = |axis: usize| {
        let mean = average(&|x| x[axis]);
        let deviation = average(&|x| (x[axis] - mean).powi(2)).sqrt();
        let first = expectation(&target, &samples, |x| x[axis]);
        let second = expectation(&target, &samples, |x| (x[axis] - mean).powi(2));
        let of_mean = Moment {
            value: mean,
            estimate: first.map(|found| found.estimate),
            standard_error: first.map(|found| found.standard_error),
            unexplained: first.as_ref().map(Expectation::unexplained_share),
        };
        let shift = first.map_or(0.0, |found| found.estimate - mean);
        let of_deviation = Moment {
            value: deviation,
            estimate: second.map(|found| (found.estimate - shift * shift).max(0.0).sqrt()),
            standard_error: second.map(|found| found.standard_error / (2.0 * deviation)),
            unexplained: second.map(|found| found.unexplained / (2.0 * deviation * deviation)),
        };
        (of_mean, of_deviation)
    };
    (0..D).map(both).collect()
}
