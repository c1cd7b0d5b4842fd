//! What a user asks of particles: moments and quantiles with errors, and how far they are from Stein's identity.

use parvi::{Certificate, Expectation, MomentEstimate, Samples, expectation};
use parvi_metrics::{Cloud, InverseMultiquadric, effective_sample_size, kernel_stein_discrepancy, quantiles};
use parvi_targets::{BoxedTarget, CatalogueTarget, Frame};
use serde::Serialize;

use crate::CommandError;
use crate::dispatch::{TargetTask, with_target};
use crate::options::TargetSpecification;
use crate::sampling::Outcome;

/// Levels of the quantiles.
const LEVELS: [f64; 7] = [0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99];

/// More particles than these have no kernel Stein discrepancy, whose cost is their square.
const LARGEST_PAIRING: usize = 20_000;

/// The content of a diagnostics file.
#[derive(Debug, Serialize)]
pub struct Diagnostics {
    /// Number of particles.
    particles: usize,
    /// 1 / Σ w².
    effective_sample_size: f64,
    /// How the run ended; `null` where the method has no certificate.
    outcome: Option<&'static str>,
    /// Why it is not `converged`.
    reason: Option<String>,
    /// Galerkin–Stein residual relative to independent draws.
    residual: Option<f64>,
    /// Standard error that the masses of separate pieces bring into a mean, in standard deviations; to these the residual is blind.
    mass_error: Option<f64>,
    /// Kernel Stein discrepancy (inverse multiquadric) in the particles' own standardised coordinates.
    kernel_stein_discrepancy: Option<f64>,
    /// One entry for each coordinate.
    coordinates: Vec<Coordinate>,
}

#[derive(Debug, Serialize)]
struct Coordinate {
    name: String,
    mean: Moment,
    standard_deviation: Moment,
    quantiles: Vec<Quantile>,
}

/// A moment of the particles.
#[derive(Debug, Serialize)]
struct Moment {
    value: f64,
    /// The target's by the scores; `null` where they do not tell.
    estimate: Option<f64>,
    /// Standard error of `value`.
    standard_error: Option<f64>,
    /// Share of its spread that the scores leave unexplained.
    unexplained: Option<f64>,
}

#[derive(Debug, Serialize)]
struct Quantile {
    level: f64,
    value: f64,
    /// As if the particles were independent draws: half the way between the quantiles one standard error of the level apart.
    standard_error: f64,
}

/// Looks at the particles of a run.
///
/// # Errors
/// Particles or scores that are not finite.
pub fn diagnose(target: &TargetSpecification, outcome: &Outcome) -> Result<Diagnostics, CommandError> {
    with_target(target, Diagnose { outcome })
}

struct Diagnose<'a> {
    outcome: &'a Outcome,
}

impl TargetTask for Diagnose<'_> {
    type Output = Diagnostics;

    fn run<const D: usize>(self, target: BoxedTarget<D>) -> Result<Diagnostics, CommandError> {
        let particles = &self.outcome.particles;
        let points = particles.points::<D>().unwrap_or_default();
        let weights = particles.weights();
        let cloud = Cloud::with_optional_weights(&points, weights)?;
        let size = match weights {
            Some(weights) => effective_sample_size(weights)?,
            None => points.len() as f64,
        };
        let certificate = self.outcome.certificate.as_ref();
        let moments = match certificate {
            Some(certificate) if certificate.moments.len() == D => of_certificate(certificate),
            _ => of_expectations(target.as_ref(), &points, weights),
        };
        let tails = tails(&cloud, size)?;
        let coordinates = moments.into_iter().zip(tails).enumerate();
        Ok(Diagnostics {
            particles: points.len(),
            effective_sample_size: size,
            outcome: certificate.map(|certificate| certificate.outcome.name()),
            reason: certificate.and_then(|certificate| certificate.outcome.reason()),
            residual: self.outcome.residual,
            mass_error: certificate.and_then(|certificate| certificate.mass_error),
            kernel_stein_discrepancy: discrepancy(target, &points, weights)?,
            coordinates: coordinates
                .map(|(axis, ((mean, standard_deviation), quantiles))| Coordinate {
                    name: format!("x{}", axis + 1),
                    mean,
                    standard_deviation,
                    quantiles,
                })
                .collect(),
        })
    }
}

/// Mean and standard deviation of every coordinate, as the certificate has them.
fn of_certificate(certificate: &Certificate) -> Vec<(Moment, Moment)> {
    let of = |value, estimate, standard_error, unexplained| Moment {
        value,
        estimate: Some(estimate),
        standard_error: Some(standard_error),
        unexplained: Some(unexplained),
    };
    let both = |m: &MomentEstimate| {
        let mean = of(m.mean, m.mean_estimate, m.mean_standard_error, m.mean_unexplained);
        let deviation = of(
            m.standard_deviation,
            m.standard_deviation_estimate,
            m.standard_deviation_standard_error,
            m.standard_deviation_unexplained,
        );
        (mean, deviation)
    };
    certificate.moments.iter().map(both).collect()
}

/// The same from the scores at the particles of any method.
fn of_expectations<const D: usize>(
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

/// The quantiles of every coordinate.
fn tails<const D: usize>(cloud: &Cloud<'_, D>, size: f64) -> Result<Vec<Vec<Quantile>>, CommandError> {
    let error = |level: f64| (level * (1.0 - level) / size).sqrt();
    let lower = quantiles(cloud, &LEVELS.map(|level| (level - error(level)).max(0.0)))?;
    let middle = quantiles(cloud, &LEVELS)?;
    let upper = quantiles(cloud, &LEVELS.map(|level| (level + error(level)).min(1.0)))?;
    let of_axis = |axis: usize| {
        (0..LEVELS.len())
            .map(|k| Quantile {
                level: LEVELS[k],
                value: middle[k][axis],
                standard_error: 0.5 * (upper[k][axis] - lower[k][axis]),
            })
            .collect()
    };
    Ok((0..D).map(of_axis).collect())
}

/// The kernel Stein discrepancy; `None` for many particles, and for such as lie in a plane.
fn discrepancy<const D: usize>(
    target: BoxedTarget<D>,
    points: &[[f64; D]],
    weights: Option<&[f64]>,
) -> Result<Option<f64>, CommandError> {
    if points.len() > LARGEST_PAIRING {
        return Ok(None);
    }
    let Ok(frame) = Frame::of_points(points, weights) else {
        return Ok(None);
    };
    let standard: Vec<[f64; D]> = points.iter().map(|x| frame.to_reference(x)).collect();
    let mut scores = vec![[0.0; D]; points.len()];
    target.scores(points, &mut scores);
    for score in &mut scores {
        *score = frame.pull_back_score(score);
    }
    let cloud = Cloud::with_optional_weights(&standard, weights)?;
    let found = kernel_stein_discrepancy(&cloud, &scores, &InverseMultiquadric::default())?;
    Ok(Some(found.discrepancy()))
}
