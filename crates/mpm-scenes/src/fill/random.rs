use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

use super::Filling;
use super::poisson_disk::volume_within;
use crate::SceneFault;
use crate::shape::{Bounds, Shape};

/// Draws for one particle, at most.
const MOST_DRAWS: u32 = 100_000;

/// `count` points that are drawn evenly from the shape, by rejection from the box around it; their volumes are equal and sum to the shape's.
///
/// # Errors
/// [`SceneFault::Value`] for a shape so thin that points are hardly ever inside.
pub fn random<const D: usize>(
    body: &str,
    shape: &dyn Shape<D>,
    count: u32,
    room: &Bounds<D>,
    seed: u64,
) -> Result<Filling<D>, SceneFault> {
    let bounds = shape.bounds().finite_within(room);
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    let mut draw = || -> [f64; D] {
        std::array::from_fn(|a| bounds.lower[a] + generator.random::<f64>() * (bounds.upper[a] - bounds.lower[a]))
    };
    let mut positions = Vec::new();
    for _ in 0..count {
        let found = (0..MOST_DRAWS).map(|_| draw()).find(|x| shape.distance(x) < 0.0);
        positions.push(found.ok_or_else(|| {
            SceneFault::value(
                format!("bodies.{body}.fill"),
                "random",
                "another filling for a shape as thin as this",
            )
        })?);
    }
    let box_volume: f64 = (0..D).map(|a| bounds.upper[a] - bounds.lower[a]).product();
    let volume = volume_within(body, shape, &bounds, 0.01 * box_volume.powf(1.0 / D as f64))?;
    Ok(Filling::of_equal(positions, volume / f64::from(count)))
}
