//! Points that stand for a target.

use parvi_targets::{
    BoxedTarget, ImportanceSample, Moments, ReferenceMoments, ReferenceOptions, SobolSequence, TargetError,
    UnitCubeTransport, WeightedDraws,
};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

use super::{Coordinates, ReferenceError, YardstickOptions};

/// Points that stand for a target in its own coordinates.
pub struct Representation<const D: usize> {
    pub points: Vec<[f64; D]>,
    /// `None`: all equal.
    pub weights: Option<Vec<f64>>,
    pub moments: Moments<D>,
    pub sample: Option<WeightedDraws<D>>,
    /// How well the sample is known, where there is one.
    pub error: Option<ReferenceError>,
}

/// As [`Coordinates::Own`] says.
pub fn own_representation<const D: usize>(
    target: &BoxedTarget<D>,
    options: &YardstickOptions,
) -> Result<Representation<D>, TargetError> {
    if let (Some(transport), Some(moments)) = (target.unit_cube_transport(), target.moments()) {
        return Ok(Representation {
            points: quasi_random(transport, options.points, options.seed)?,
            weights: None,
            moments,
            sample: None,
            error: None,
        });
    }
    let of_sample = ReferenceOptions {
        seed: options.seed,
        ..ReferenceOptions::default()
    };
    let sample = ImportanceSample::new(target.as_ref(), &of_sample)?;
    let known = sample.moments();
    let sample = sample.into_draws();
    Ok(Representation {
        points: sample.resampled(options.points, options.seed),
        weights: None,
        moments: known.moments,
        sample: Some(sample),
        error: Some(ReferenceError::of(&known)),
    })
}

/// Moments of points of equal weight.
fn of_points<const D: usize>(points: &[[f64; D]]) -> Moments<D> {
    let weights = vec![1.0; points.len()];
    let draws = WeightedDraws {
        points: points.to_vec(),
        weights,
    };
    draws.moments()
}

/// As [`Coordinates::Scaled`] and [`Coordinates::Standardised`] say.
pub fn standardised_representation<const D: usize>(
    target: &BoxedTarget<D>,
    options: &YardstickOptions,
) -> Result<Representation<D>, TargetError> {
    if let Some(transport) = target.unit_cube_transport() {
        let points = quasi_random(transport, options.points, options.seed)?;
        let moments = match (options.coordinates, target.moments()) {
            (Coordinates::Scaled, _) => of_points(&points),
            (_, Some(moments)) => moments,
            (_, None) => Moments {
                mean: *target.frame().centre(),
                covariance: target.frame().covariance(),
            },
        };
        return Ok(Representation {
            points,
            weights: None,
            moments,
            sample: None,
            error: None,
        });
    }
    let of_sample = ReferenceOptions {
        points: options.points,
        seed: options.seed,
        ..ReferenceOptions::default()
    };
    let sample = ImportanceSample::new(target.as_ref(), &of_sample)?;
    let known = match target.moments() {
        Some(moments) => ReferenceMoments {
            moments,
            mean_error: [0.0; D],
            standard_deviation_error: [0.0; D],
            effective_sample_size: sample.draws().effective_sample_size(),
        },
        None => sample.moments(),
    };
    let sample = sample.into_draws();
    Ok(Representation {
        points: sample.points.clone(),
        weights: Some(sample.weights.clone()),
        moments: known.moments,
        sample: Some(sample),
        error: Some(ReferenceError::of(&known)),
    })
}

/// Scrambled Sobol points through the target's map.
fn quasi_random<const D: usize>(
    transport: &dyn UnitCubeTransport<D>,
    count: usize,
    seed: u64,
) -> Result<Vec<[f64; D]>, TargetError> {
    let sequence = SobolSequence::scrambled(transport.cube_dimension(), seed)?;
    let count = u32::try_from(count).unwrap_or(u32::MAX);
    Ok((0..count)
        .map(|index| transport.transport(&sequence.point(index)))
        .collect())
}

/// Independent draws from weighted points, by inversion of their cumulative weights.
pub fn independent<const D: usize>(sample: &WeightedDraws<D>, count: usize, seed: u64) -> Vec<[f64; D]> {
    let mut total = 0.0;
    let cumulative: Vec<f64> = sample
        .weights
        .iter()
        .map(|weight| {
            total += weight;
            total
        })
        .collect();
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    let last = sample.points.len().saturating_sub(1);
    (0..count)
        .filter_map(|_| {
            let goal = generator.random::<f64>() * total;
            sample
                .points
                .get(cumulative.partition_point(|&sum| sum <= goal).min(last))
                .copied()
        })
        .collect()
}
