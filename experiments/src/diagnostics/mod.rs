//! What a user asks of particles: moments and quantiles with errors, and how far they are from Stein's identity.

mod moments;

use std::collections::BTreeMap;

use parvi_files::{Outcome, Particles};
use parvi_metrics::{
    Cloud, CloudMoments, InverseMultiquadric, MetricError, effective_sample_size, kernel_stein_discrepancy, quantiles,
};
use parvi_options::TargetSpecification;
use parvi_targets::{CatalogueTarget, Frame, scores_in_calls};
use serde::Serialize;

use moments::{Moment, of_certificate, of_expectations};

use crate::CommandError;
use crate::console::Pair;
use crate::dispatch::on_target;
use crate::plots::results::Value;
use crate::provenance::Provenance;
use crate::sampling::unless_failed;

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
    /// Evaluations of the score at one point.
    score_evaluations: u64,
    /// Evaluations of the log density at one point.
    density_evaluations: u64,
    /// log of the target's normalising constant, where the method estimates it.
    log_evidence: Option<f64>,
    /// Its standard error.
    log_evidence_error: Option<f64>,
    /// Shape of the tail of the importance weights; above 0.7 nothing that rests on them is to be relied on.
    pareto_k: Option<f64>,
    /// The squared energy distance from the target over that of as many independent draws, as far as the pool knows.
    relative_energy_distance: Option<f64>,
    /// The share of draws of the searches' law from which what these have overlooked can be seen.
    unseen: Option<f64>,
    /// Everything that was evaluated, weighed; where the method keeps it.
    pool: Option<PoolSize>,
    /// Galerkin–Stein residual relative to independent draws.
    residual: Option<f64>,
    /// Kernel Stein discrepancy (inverse multiquadric) in the particles' own standardised coordinates; `null` where a score is not finite.
    kernel_stein_discrepancy: Option<f64>,
    /// One entry for each coordinate.
    coordinates: Vec<Coordinate>,
    /// Covariance of the coordinates, row by row: of the pool where there is one, else of the particles; `null` where it is above the range of numbers.
    covariance: Option<Vec<Vec<f64>>>,
    /// What standard output says of the run.
    run: BTreeMap<&'static str, Value>,
    /// What the run was computed with.
    provenance: Provenance,
}

/// The size of a weighted pool.
#[derive(Debug, Serialize)]
struct PoolSize {
    points: usize,
    /// (Σ w)² / Σ w².
    effective_size: f64,
}

impl PoolSize {
    fn of(pool: &Particles) -> Result<Self, MetricError> {
        Ok(Self {
            points: pool.len(),
            effective_size: effective_size(pool)?,
        })
    }
}

/// (Σ w)² / Σ w².
fn effective_size(particles: &Particles) -> Result<f64, MetricError> {
    particles
        .weights()
        .map_or(Ok(particles.len() as f64), effective_sample_size)
}

#[derive(Debug, Serialize)]
struct Coordinate {
    name: String,
    mean: Moment,
    standard_deviation: Moment,
    quantiles: Vec<Quantile>,
}

#[derive(Debug, Serialize)]
struct Quantile {
    level: f64,
    value: f64,
    /// The pool's, where there is one.
    estimate: Option<f64>,
    /// Of `value`: how far the pool's is off it, and the pool's own error; without a pool that of independent particles. The error of a sample is half the way between the
    /// quantiles one standard error of the level apart.
    standard_error: f64,
}

/// A quantile of a sample with its error: that of its level by the weights of the points on either side.
#[derive(Clone, Copy)]
struct Known {
    value: f64,
    error: f64,
}

/// Looks at the particles of a run, whose coordinates are called `names` and of which standard output has `said` this.
///
/// # Errors
/// Particles or scores that are not finite.
pub fn diagnose(
    target: &TargetSpecification,
    outcome: &Outcome,
    names: &[String],
    said: &[Pair],
) -> Result<Diagnostics, CommandError> {
    on_target!(target, target, D => unless_failed::<_, D>(target.as_ref(), of_target::<D>(target.as_ref(), outcome, names, said)))
}

fn of_target<const D: usize>(
    target: &dyn CatalogueTarget<D>,
    outcome: &Outcome,
    names: &[String],
    said: &[Pair],
) -> Result<Diagnostics, CommandError> {
    let particles = &outcome.particles;
    let points = particles.points::<D>().unwrap_or_default();
    let weights = particles.weights();
    let cloud = Cloud::with_optional_weights(&points, weights)?;
    let certificate = outcome.certificate.as_ref();
    let moments = match certificate {
        Some(certificate) if certificate.moments.len() == D => of_certificate(certificate),
        _ => of_expectations(target, &points, weights),
    };
    let pooled = outcome.pool.as_ref();
    let everything = pooled.map(|pool| pool.points::<D>().unwrap_or_default());
    let weighed = everything.as_deref().zip(pooled);
    let weighed = weighed.map(|(points, pool)| Cloud::with_optional_weights(points, pool.weights()));
    let weighed = weighed.transpose().map_err(CommandError::Metric)?;
    let tails = tails(&cloud, weighed.as_ref())?;
    let covariance = CloudMoments::new(weighed.as_ref().unwrap_or(&cloud)).ok();
    let coordinates = moments.into_iter().zip(tails).zip(names);
    Ok(Diagnostics {
        particles: points.len(),
        effective_sample_size: effective_size(particles)?,
        outcome: certificate.map(|certificate| certificate.outcome.name()),
        reason: certificate.and_then(|certificate| certificate.outcome.reason_naming(names)),
        score_evaluations: outcome.score_evaluations,
        density_evaluations: outcome.density_evaluations,
        log_evidence: outcome.log_evidence,
        log_evidence_error: outcome.log_evidence_error,
        pareto_k: outcome.pareto_k,
        relative_energy_distance: outcome.relative_energy_distance,
        unseen: outcome.unseen,
        pool: outcome.pool.as_ref().map(PoolSize::of).transpose()?,
        residual: outcome.residual,
        kernel_stein_discrepancy: discrepancy(target, &points, weights)?,
        coordinates: coordinates
            .map(|(((mean, standard_deviation), quantiles), name)| Coordinate {
                name: name.clone(),
                mean,
                standard_deviation,
                quantiles,
            })
            .collect(),
        covariance: covariance.map(|moments| moments.covariance.0.iter().map(|row| row.to_vec()).collect()),
        run: said
            .iter()
            .filter(|(_, value)| *value != Value::Empty)
            .cloned()
            .collect(),
        provenance: Provenance::now(rayon::current_num_threads()),
    })
}

/// The quantiles of every coordinate: of the particles, beside those of the pool.
fn tails<const D: usize>(
    cloud: &Cloud<'_, D>,
    pool: Option<&Cloud<'_, D>>,
) -> Result<Vec<Vec<Quantile>>, CommandError> {
    let own = known(cloud)?;
    let pool = pool.map(known).transpose()?;
    let of_axis = |axis: usize| {
        let of_level = |k: usize| {
            let own = own[k][axis];
            let estimate = pool.as_ref().map(|pool| pool[k][axis]);
            Quantile {
                level: LEVELS[k],
                value: own.value,
                estimate: estimate.map(|known| known.value),
                standard_error: estimate.map_or(own.error, |known| (own.value - known.value).hypot(known.error)),
            }
        };
        (0..LEVELS.len()).map(of_level).collect()
    };
    Ok((0..D).map(of_axis).collect())
}

/// The quantiles of a sample by level and coordinate.
fn known<const D: usize>(cloud: &Cloud<'_, D>) -> Result<Vec<[Known; D]>, MetricError> {
    let middle = quantiles(cloud, &LEVELS)?;
    let places = || (0..LEVELS.len()).flat_map(|k| (0..D).map(move |axis| (k, axis)));
    let errors: Vec<f64> = places()
        .map(|(k, axis)| error_of_level(cloud, axis, LEVELS[k], middle[k][axis]))
        .collect();
    let moved = |sign: f64| {
        let levels = places().zip(&errors);
        let levels: Vec<f64> = levels
            .map(|((k, _), error)| (LEVELS[k] + sign * error).clamp(0.0, 1.0))
            .collect();
        quantiles(cloud, &levels)
    };
    let (lower, upper) = (moved(-1.0)?, moved(1.0)?);
    let of_level = |k: usize| {
        std::array::from_fn(|axis| Known {
            value: middle[k][axis],
            error: 0.5 * (upper[k * D + axis][axis] - lower[k * D + axis][axis]),
        })
    };
    Ok((0..LEVELS.len()).map(of_level).collect())
}

/// The standard error of the share p of points up to the quantile `value` of a coordinate: (p (1 − p) / M)^½, and (Σ w² (1{x ≤ q} − p)²)^½ of weights that sum to one, which are often larger in the
/// tails than elsewhere.
fn error_of_level<const D: usize>(cloud: &Cloud<'_, D>, axis: usize, level: f64, value: f64) -> f64 {
    if cloud.weights().is_none() {
        return (level * (1.0 - level) / cloud.len() as f64).sqrt();
    }
    let term = |(x, weight): (&[f64; D], f64)| (weight * (f64::from(u8::from(x[axis] <= value)) - level)).powi(2);
    cloud.iter().map(term).sum::<f64>().sqrt()
}

/// The kernel Stein discrepancy; `None` for many particles, for such as lie in a plane, and where a score is not finite, as differences across an edge are.
fn discrepancy<const D: usize>(
    target: &dyn CatalogueTarget<D>,
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
    scores_in_calls(target, points, &mut scores);
    for score in &mut scores {
        *score = frame.pull_back_score(score);
    }
    if !scores.iter().flatten().all(|component| component.is_finite()) {
        return Ok(None);
    }
    let cloud = Cloud::with_optional_weights(&standard, weights)?;
    let found = kernel_stein_discrepancy(&cloud, &scores, &InverseMultiquadric::default())?;
    Ok(Some(found.discrepancy()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heavy_points_in_a_tail_make_its_quantiles_uncertain() {
        let points: Vec<[f64; 1]> = (0..100).map(|i| [f64::from(i)]).collect();
        let error = |weights: &[f64]| error_of_level(&Cloud::weighted(&points, weights).unwrap(), 0, 0.1, 9.0);
        let equal = error_of_level(&Cloud::new(&points).unwrap(), 0, 0.1, 9.0);
        assert!((equal - 0.03).abs() < 1e-15 && (error(&[1.0; 100]) - equal).abs() < 1e-15);
        // Five of the ten points below have their share of a tenth.
        let heavy: Vec<f64> = (0..100)
            .map(|i| match i {
                0..5 => 2.0,
                5..10 => 0.0,
                _ => 1.0,
            })
            .collect();
        // (5 (0.02 · 0.9)² + 90 (0.01 · 0.1)²)^½
        assert!((error(&heavy) - 0.001_71_f64.sqrt()).abs() < 1e-15);
    }
}
