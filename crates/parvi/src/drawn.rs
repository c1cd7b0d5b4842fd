//! Points drawn from a pool.

use parvi_pool::Pool;

/// So many points, of equal shares of the weights.
pub(crate) fn drawn<const D: usize>(pool: &Pool<D>, count: usize, offset: f64) -> Vec<[f64; D]> {
    let mut sum = 0.0;
    let mut points = Vec::with_capacity(count);
    for (x, weight) in pool.positions.iter().zip(&pool.weights) {
        sum += weight;
        while points.len() < count && sum * count as f64 > points.len() as f64 + offset {
            points.push(*x);
        }
    }
    points
}
